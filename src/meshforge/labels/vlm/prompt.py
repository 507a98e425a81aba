"""The questions about the hulls of a mesh: which hulls in which pictures, and the words."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

from meshforge.common import UsageError
from meshforge.labels.vlm.answer import clearness
from meshforge.labels.vlm.question import Message, Part, VlmQuestion
from meshforge.rendering import LabelingPicture, draw_labeling_pictures, encode_png, up_axis
from meshforge.store import VlmSettings
from meshforge.symbolic import SymbolicMesh

ModeName = Literal["cheap", "balanced", "exact"]

_UNKNOWN = ("unknown", "cannot tell", "?")

_TASK = """\
You name the parts of three-dimensional objects. An object is shown as the convex pieces that its collision mesh is made
of. Pieces that you are asked about have a colour each and a number; a number stands on its piece, or beside it at the
end of a line that leads there. Other pieces are pale. One part of the object may be made of several pieces, which then
have the same label, and pieces are rougher than the part itself.

Find out first what the object is, then for each piece asked about which part of it the piece belongs to: by its place,
its size and shape, and what it touches. Compare the pictures: a number is the same piece in all of them.

The labels are:
{labels}
- {unknown}: none of these, or it cannot be told from the pictures. Say this rather than guess.

{up} is up{about}. Each picture tells from where it is seen.

Answer with JSON only, with one entry for each number asked about, no other number, and labels spelled as above:
{{"hulls": [{{"number": 3, "label": "{example}"}}, ...]}}"""

_AGAIN = """\
That answer leaves something open{why}. Answer again in the same form, for these numbers only: {numbers}."""

_ENTRY_TOKENS = 30  # tokens of an answer for each hull, at most
_EXPECTED_TOKENS = 15  # and about as many as it takes


@dataclass(frozen=True, slots=True)
class PictureMode:
    """hulls: asked about in one question at most; pictures: numbered ones of so many hulls; size [px] of each side.

    questions: over which the pictures are spread, so that each hull is judged several times; plain: of how many of the
    pictures of a question the same without numbers stands beside it.
    """

    hulls: int
    pictures: int
    size: int
    questions: int
    plain: int


MODES: Mapping[ModeName, PictureMode] = {
    "cheap": PictureMode(hulls=40, pictures=4, size=768, questions=1, plain=1),
    "balanced": PictureMode(hulls=12, pictures=4, size=1024, questions=2, plain=2),
    "exact": PictureMode(hulls=5, pictures=6, size=1024, questions=6, plain=1),
}


@dataclass(frozen=True, slots=True)
class PromptConfig:
    """How hulls are asked about: the labels, and what the table [vlm] says. Raises UsageError for what does not fit."""

    vocabulary: tuple[str, ...]
    settings: VlmSettings

    def __post_init__(self) -> None:
        if not self.vocabulary:
            raise UsageError("the vocabulary is empty", remedy="Say first what hulls can be: --vocabulary a,b,c.")
        unrecognised = next((label for label in self.settings.descriptions if label not in self.vocabulary), None)
        if unrecognised is not None:
            raise UsageError(f"the label {unrecognised!r} is described, but is not in the vocabulary")

    @property
    def picture_mode(self) -> PictureMode:
        """The mode, with pictures of the size that was chosen."""
        mode, size = MODES[self.settings.mode], self.settings.size
        return mode if size is None else replace(mode, size=size)

    @property
    def unknown(self) -> str:
        """What a model says of a hull that it does not know."""
        return next(word for word in _UNKNOWN if word not in self.vocabulary)

    def words(self, repeat: int) -> Sequence[str]:
        """Return the labels; each repeat lists them in another order, since the order must not matter."""
        turn = repeat % len(self.vocabulary)
        return (*self.vocabulary[turn:], *self.vocabulary[:turn])


def _task_message(config: PromptConfig, up: str, repeat: int) -> Message:
    words, known, about = config.words(repeat), config.settings.descriptions, config.settings.about
    labels = [f"- {word}: {_to_line(known[word])}" if word in known else f"- {word}" for word in words]
    about = f". The objects are: {_to_line(about)}" if about else ""
    text = _TASK.format(labels="\n".join(labels), unknown=config.unknown, up=up, about=about, example=words[0])
    return Message.system(text)


def _question_message(
    shots: Sequence[LabelingPicture], plain: int, hulls: Mapping[int, str], name: str = ""
) -> Message:
    """Pictures, and the numbers that are asked about.

    plain: of how many of the first pictures the same without numbers is shown; hulls: by number, in order;
    name: that of the asset, empty where the model is given no names.
    """
    parts: list[Part] = [f"This is {name!r}." if name else "This is the object."]
    for k, shot in enumerate(shots):
        parts += [f"Picture: {shot.name}.", encode_png(shot.marked)]
        if k < plain:
            parts += ["The same without numbers.", encode_png(shot.plain)]
    listed = ", ".join(f"{number} ({hull!r})" if name else str(number) for number, hull in hulls.items())
    parts.append(f"Which part does each of these pieces belong to: {listed}?")
    return Message("user", tuple(parts))


def example_messages(mesh: SymbolicMesh, config: PromptConfig) -> tuple[Message, ...]:
    """Return a labelled mesh as a question with its answer; nothing where no hull has a label of the vocabulary."""
    mode = config.picture_mode
    labelled = [hull.name for hull in mesh.hulls if hull.label in config.vocabulary][: mode.hulls]
    if not labelled:
        return ()
    shots = draw_labeling_pictures(mesh, hulls=labelled, most=min(2, mode.pictures), size=mode.size)
    hulls = _number_hulls(mesh, labelled, shots)
    rows = [{"number": number, "label": mesh.hull_of(hull).label or config.unknown} for number, hull in hulls.items()]
    return _question_message(shots, 0, hulls), Message.assistant(json.dumps({"hulls": rows}, ensure_ascii=False))


def _number_hulls(mesh: SymbolicMesh, hulls: Sequence[str], shots: Sequence[LabelingPicture]) -> dict[int, str]:
    return {mesh.index[hull]: hull for hull in hulls if any(hull in shot.numbered for shot in shots)}


def retry_message(numbers: Sequence[int], unrecognised: Sequence[str]) -> Message:
    """Return the words that ask once more for what an answer left open; odd: words in it that are no labels."""
    words = ", ".join(json.dumps(word, ensure_ascii=False) for word in unrecognised)
    why = f" ({words} {'is no label' if len(unrecognised) == 1 else 'are no labels'})" if unrecognised else ""
    return Message.user(_AGAIN.format(why=why, numbers=", ".join(map(str, numbers))))


def _answer_schema(config: PromptConfig, repeat: int) -> dict[str, Any]:
    labels = {"type": "string", "enum": [*config.words(repeat), config.unknown]}
    entry = {"number": {"type": "integer"}, "label": labels}
    row = {"type": "object", "properties": entry, "required": list(entry), "additionalProperties": False}
    return {
        "type": "object",
        "properties": {"hulls": {"type": "array", "items": row}},
        "required": ["hulls"],
        "additionalProperties": False,
    }


def _to_line(text: str) -> str:
    return " ".join(text.split()).rstrip(".")


@dataclass(frozen=True, slots=True)
class HullQuestion:
    """A question about some hulls. hulls: by the number they have in it; weights: how well each is seen, in 0..1."""

    question: VlmQuestion
    hulls: Mapping[int, str]
    weights: Mapping[int, float]

    @property
    def expected(self) -> int:
        """About how many tokens the answer has."""
        return _EXPECTED_TOKENS * (len(self.hulls) + 1)

    def show_examples(self, examples: tuple[Message, ...]) -> HullQuestion:
        """Return the same question with messages that show labelled assets before its own pictures."""
        instructions, *pictures = self.question.messages
        return replace(self, question=replace(self.question, messages=(instructions, *examples, *pictures)))


def build_questions(
    mesh: SymbolicMesh, wanted: Collection[str], config: PromptConfig, name: str = ""
) -> Iterator[HullQuestion]:
    """Yield the questions about a mesh. Groups in which no hull is wanted are passed over.

    The groups do not depend on what is wanted, so that answers can be found again when some hulls have a label by then.
    name: that of the asset, which the model is given where the config says so.
    """
    mode, names = config.picture_mode, list(mesh.index)
    count = -(-len(names) // mode.hulls)
    for k in range(count):
        group = names[k * len(names) // count : (k + 1) * len(names) // count]
        if set(group).isdisjoint(wanted):
            continue
        shots = draw_labeling_pictures(mesh, hulls=group, most=mode.pictures, size=mode.size)
        parts = min(mode.questions, len(shots))
        for part in range(parts):
            yield from _ask_in_repeats(mesh, shots[part::parts], group, config, name if config.settings.names else "")


def _ask_in_repeats(
    mesh: SymbolicMesh, shots: Sequence[LabelingPicture], group: Sequence[str], config: PromptConfig, name: str
) -> Iterator[HullQuestion]:
    hulls, mode = _number_hulls(mesh, group, shots), config.picture_mode
    if not hulls:
        return
    pictures = _question_message(shots, mode.plain, hulls, name)
    pixels = {n: sum(shot.visible_pixels[hull] for shot in shots if hull in shot.numbered) for n, hull in hulls.items()}
    weights = {number: clearness(count, mode.size) for number, count in pixels.items()}
    limit = config.settings.room + _ENTRY_TOKENS * len(hulls)
    for repeat in range(config.settings.repeats):
        messages = _task_message(config, f"+{up_axis(mesh, None)}", repeat), pictures
        question = VlmQuestion(messages, _answer_schema(config, repeat), limit, repeat=repeat)
        yield HullQuestion(question, hulls, weights)
