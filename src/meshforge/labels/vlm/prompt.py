"""The questions about the hulls of a mesh: which hulls in which pictures, and the words."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from typing import Any, Literal

from meshforge.common import UsageError
from meshforge.labels.vlm.answer import clearness
from meshforge.labels.vlm.request import Message, Part, VlmQuestion
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

{up} is up{about}. Each picture tells from where it is seen, and shows where up is.

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
    """vocabulary: the labels; descriptions: a line on some of them, by label; about: a line on what the meshes are.

    names: whether the model is given the names of assets and hulls; repeats: how often each question is asked; room:
    tokens for an answer besides those it needs, of which a model that thinks first needs more; size: of pictures [px],
    None for that of the mode. Raises UsageError for values that do not fit.
    """

    vocabulary: tuple[str, ...]
    mode: ModeName = "balanced"
    descriptions: Mapping[str, str] = field(default_factory=dict)
    about: str = ""
    names: bool = False
    repeats: int = 1
    room: int = 1000
    size: int | None = None

    def __post_init__(self) -> None:
        if not self.vocabulary:
            raise UsageError("the vocabulary is empty", remedy="Say first what hulls can be: --vocabulary a,b,c.")
        unrecognised = next((label for label in self.descriptions if label not in self.vocabulary), None)
        if unrecognised is not None:
            raise UsageError(f"the label {unrecognised!r} is described, but is not in the vocabulary")

    @property
    def picture_mode(self) -> PictureMode:
        """The mode, with pictures of the size that was chosen."""
        mode = MODES[self.mode]
        return mode if self.size is None else replace(mode, size=self.size)

    @property
    def unknown(self) -> str:
        """What a model says of a hull that it does not know."""
        return next(word for word in _UNKNOWN if word not in self.vocabulary)

    def words(self, repeat: int = 0) -> Sequence[str]:
        """The labels; each repeat lists them in another order, since the order must not matter."""
        turn = repeat % len(self.vocabulary)
        return (*self.vocabulary[turn:], *self.vocabulary[:turn])


def prompt_config_of(settings: VlmSettings, vocabulary: Sequence[str]) -> PromptConfig:
    """What the table [vlm] says on asking. Raises UsageError: no vocabulary, or a description of what is no label."""
    _, *own = fields(PromptConfig)
    return PromptConfig(tuple(vocabulary), **{field.name: getattr(settings, field.name) for field in own})


def task_message(config: PromptConfig, up: str, repeat: int = 0) -> Message:
    """What the task is; up: the axis that points up, as `+Z`."""
    words = config.words(repeat)
    labels = [
        f"- {word}: {_to_line(config.descriptions[word])}" if word in config.descriptions else f"- {word}"
        for word in words
    ]
    about = f". The objects are: {_to_line(config.about)}" if config.about else ""
    text = _TASK.format(labels="\n".join(labels), unknown=config.unknown, up=up, about=about, example=words[0])
    return Message.system(text)


def question_message(
    shots: Sequence[LabelingPicture], plain: int, numbers: Mapping[str, int], name: str = ""
) -> Message:
    """Pictures, and the numbers that are asked about.

    plain: of how many of the first pictures the same without numbers is shown; numbers: by hull;
    name: that of the asset, empty where the model is given no names.
    """
    parts: list[Part] = [f"This is {name!r}." if name else "This is the object."]
    for k, shot in enumerate(shots):
        parts += [f"Picture: {shot.name}.", encode_png(shot.marked)]
        if k < plain:
            parts += ["The same without numbers.", encode_png(shot.plain)]
    options = ", ".join(
        f"{n} ({hull!r})" if name else str(n) for hull, n in sorted(numbers.items(), key=lambda row: row[1])
    )
    parts.append(f"Which part does each of these pieces belong to: {options}?")
    return Message("user", tuple(parts))


def example_answer(labels: Mapping[int, str]) -> Message:
    """The right answer about an asset that is shown as an example."""
    rows = ", ".join(f'{{"number": {number}, "label": {_quote(label)}}}' for number, label in sorted(labels.items()))
    return Message.assistant(f'{{"hulls": [{rows}]}}')


def retry_message(numbers: Sequence[int], unrecognised: Sequence[str]) -> Message:
    """The words that ask once more for what an answer left open; odd: words in it that are no labels."""
    why = (
        f" ({', '.join(map(_quote, unrecognised))} {'is no label' if len(unrecognised) == 1 else 'are no labels'})"
        if unrecognised
        else ""
    )
    return Message.user(_AGAIN.format(why=why, numbers=", ".join(map(str, numbers))))


def answer_schema(config: PromptConfig, repeat: int = 0) -> dict[str, Any]:
    """The JSON schema of an answer."""
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


def _quote(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)


@dataclass(frozen=True, slots=True)
class HullQuestion:
    """A question about some hulls. hulls: by the number they have in it; weights: how well each is seen, in 0..1."""

    question: VlmQuestion
    hulls: Mapping[int, str]
    weights: Mapping[str, float]
    repeat: int

    @property
    def expected(self) -> int:
        """About how many tokens the answer has."""
        return _EXPECTED_TOKENS * (len(self.hulls) + 1)

    def show_examples(self, examples: tuple[Message, ...]) -> HullQuestion:
        """The same question with messages that show labelled assets before its own pictures."""
        instructions, *pictures = self.question.messages
        return replace(self, question=replace(self.question, messages=(instructions, *examples, *pictures)))


def build_questions(
    mesh: SymbolicMesh, wanted: Collection[str], config: PromptConfig, name: str = ""
) -> Iterator[HullQuestion]:
    """The questions about a mesh. Groups in which no hull is wanted are passed over.

    The groups do not depend on what is wanted, so that answers can be found again when some hulls have a label by then.
    name: that of the asset, which the model is given where the config says so.
    """
    mode = config.picture_mode
    for group in _group_names([hull.name for hull in mesh.hulls], mode.hulls):
        if set(group).isdisjoint(wanted):
            continue
        pictures = draw_labeling_pictures(mesh, hulls=group, most=mode.pictures, size=mode.size)
        parts = min(mode.questions, len(pictures))
        for part in range(parts):
            yield from _ask_in_repeats(mesh, pictures[part::parts], group, config, name if config.names else "")


def _ask_in_repeats(
    mesh: SymbolicMesh, shots: tuple[LabelingPicture, ...], group: Collection[str], config: PromptConfig, name: str
) -> Iterator[HullQuestion]:
    shown = frozenset[str]().union(*(shot.numbered for shot in shots))
    numbers = {hull: mesh.index[hull] for hull in group if hull in shown}
    if not numbers:
        return
    pictures = question_message(shots, config.picture_mode.plain, numbers, name)
    pixels = {hull: sum(shot.visible_pixels[hull] for shot in shots if hull in shot.numbered) for hull in numbers}
    weights = {hull: clearness(count, config.picture_mode.size) for hull, count in pixels.items()}
    limit = config.room + _ENTRY_TOKENS * len(numbers)
    for repeat in range(config.repeats):
        messages = task_message(config, f"+{up_axis(mesh, None)}", repeat), pictures
        question = VlmQuestion(messages, answer_schema(config, repeat), limit, repeat=repeat)
        yield HullQuestion(question, {number: hull for hull, number in numbers.items()}, weights, repeat)


def _group_names(names: list[str], most: int) -> Iterator[list[str]]:
    """Names in their order, in as few groups as can be, of about one size."""
    count = -(-len(names) // most)
    for k in range(count):
        yield names[k * len(names) // count : (k + 1) * len(names) // count]
