"""The questions about hulls of one mesh, or of several of a kind: which hulls in which pictures, and the words."""

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from meshforge.common import UsageError
from meshforge.labels.vlm.question import Message, Part, VlmQuestion, make_object_schema
from meshforge.rendering import draw_labeling_pictures, encode_png, make_contact_sheet, up_axis
from meshforge.store import VlmSettings
from meshforge.symbolic import SymbolicMesh

HullKey = tuple[str, str]
"""The name of a mesh, and that of one of its hulls."""

MOST_COLORS = 12
"""Hulls that have a colour in one picture at most: more colours are not told apart."""
_MOST_HULLS = 10 * MOST_COLORS  # in one question, so that servers take its pictures
_VIEWS = 2  # pictures of each group of hulls, beside those of hulls that these do not show
_UNKNOWN = ("unknown", "cannot tell", "?")

_TASK = """\
You name the parts of three-dimensional objects. An object is shown as the convex pieces that its collision mesh is made
of; beside the first picture is the object as it looks. Pieces that you are asked about have a colour each and a number;
a number stands on its piece, or beside it at the end of a line that leads there. Other pieces are pale. One part may be
made of several pieces, which then have the same label, and pieces are rougher than the part itself.

Each piece has a line of text: its size, the place of its middle, and the pieces that it touches. Sizes and places are
in percent of the whole object, along X, Y and Z. {up} is up{about}.

Find out first what the object is and which parts it has, then which part each piece belongs to: by its place, its size
and shape, and what it touches. Compare the pictures: a number is the same piece in all of them.

The labels are:
{labels}
- {unknown}: none of these, or it cannot be told from the pictures. Say this rather than guess.

Answer with JSON only, with the label of each number asked about, no other number, and labels spelled as above:
{{"object": "what it is", "parts": ["its parts", ...], "hulls": {{"3": "{example}", ...}}}}"""

_BEFORE_TOKENS, _ENTRY_TOKENS = 150, 15  # tokens of an answer: before the labels, and for each hull, at most


@dataclass(frozen=True, slots=True)
class PromptConfig:
    """How hulls are asked about: the labels, what the table [vlm] says, and labelled meshes that are shown before.

    Raises UsageError for what does not fit.
    """

    vocabulary: tuple[str, ...]
    settings: VlmSettings
    examples: tuple[Message, ...] = ()

    def __post_init__(self) -> None:
        unrecognised = next((label for label in self.settings.descriptions if label not in self.vocabulary), None)
        if unrecognised is not None:
            raise UsageError(f"the label {unrecognised!r} is described, but is not in the vocabulary")

    @property
    def unknown(self) -> str:
        """What a model says of a hull that it does not know."""
        return next(word for word in _UNKNOWN if word not in self.vocabulary)


@dataclass(frozen=True, eq=False, slots=True)
class MeshHulls:
    """A mesh, and those of its hulls that a question is about. name: of the asset."""

    name: str
    mesh: SymbolicMesh
    hulls: Sequence[str]


@dataclass(frozen=True, slots=True)
class HullQuestion:
    """A question about some hulls. hulls: by the number they have in it."""

    question: VlmQuestion
    hulls: Mapping[int, HullKey]


def build_questions(meshes: Sequence[MeshHulls], config: PromptConfig) -> tuple[HullQuestion, ...]:
    """Return the question about hulls of some meshes; of one with very many hulls several."""
    first, *more = meshes
    if not more and len(first.hulls) > _MOST_HULLS:
        groups = (replace(first, hulls=hulls) for hulls in _split(first.hulls, _MOST_HULLS))
        return tuple(one for group in groups for one in build_questions([group], config))
    pictures, hulls = _show_meshes(meshes, config)
    messages = _task_message(config, f"+{up_axis(first.mesh)}"), *config.examples, pictures
    limit = config.settings.room + _BEFORE_TOKENS + _ENTRY_TOKENS * len(hulls)
    return (HullQuestion(VlmQuestion(messages, _answer_schema(config, hulls), limit), hulls),)


def example_messages(name: str, mesh: SymbolicMesh, config: PromptConfig) -> tuple[Message, ...]:
    """Return a labelled mesh as a question with its answer: a few hulls of each label; nothing where none has one."""
    labels = [hull.label for hull in mesh.hulls]
    order = sorted(range(len(labels)), key=lambda k: (labels[:k].count(labels[k]), k))
    few = sorted([k for k in order if labels[k] in config.vocabulary][:MOST_COLORS])
    if not few:
        return ()
    pictures, hulls = _show_meshes([MeshHulls(name, mesh, [mesh.hulls[k].name for k in few])], config)
    rows = {str(number): labels[k] for number, k in zip(hulls, few, strict=True)}
    parts = [label for label in config.vocabulary if label in labels]
    answer = {"object": config.settings.about or "one of these objects", "parts": parts, "hulls": rows}
    return pictures, Message("assistant", (json.dumps(answer, ensure_ascii=False),))


def _show_meshes(meshes: Sequence[MeshHulls], config: PromptConfig) -> tuple[Message, dict[int, HullKey]]:
    """The pictures and lines of text of some hulls; and the hulls by number."""
    parts, hulls = list[Part](), dict[int, HullKey]()
    for place, asked in enumerate(meshes):
        index, begin = asked.mesh.index, len(hulls)
        numbers = {hull: begin + k if len(meshes) > 1 else index[hull] for k, hull in enumerate(asked.hulls)}
        hulls |= {number: (asked.name, hull) for hull, number in numbers.items()}
        what = f"object {place + 1}" if len(meshes) > 1 else "the object"
        parts.append(f"This is {what}{f', {asked.name!r}' if config.settings.names else ''}.")
        groups, size = _split(asked.hulls, MOST_COLORS), config.settings.size
        rows = ({hull: numbers[hull] for hull in group} for group in groups)
        shots = [s for own in rows for s in draw_labeling_pictures(asked.mesh, hulls=own, most=_VIEWS, size=size)]
        for k, shot in enumerate(shots):
            beside = "; beside it the object as it looks" if k == 0 else ""
            image = shot.marked if k else make_contact_sheet([shot.marked, shot.plain], columns=2)
            parts += [f"Picture: {shot.name}{beside}.", encode_png(image)]
        parts.append("\n".join(_describe_hulls(asked.mesh, numbers, names=config.settings.names)))
    parts.append(f"Which part does each of these pieces belong to: {', '.join(map(str, hulls))}?")
    return Message("user", tuple(parts)), hulls


def _describe_hulls(mesh: SymbolicMesh, numbers: Mapping[str, int], *, names: bool) -> Iterator[str]:
    """A line a hull: its size, place and contacts."""
    low, high = mesh.corners
    foot = low.min(axis=0)
    unit = np.maximum(high.max(axis=0) - foot, 1e-9) / 100
    for hull, number in numbers.items():
        k = mesh.index[hull]
        size, middle = np.rint([(high[k] - low[k]) / unit, ((high[k] + low[k]) / 2 - foot) / unit]).astype(int).tolist()
        touching = [mesh.hulls[other].name for other in sorted(mesh.neighbours(k))]
        known = [str(numbers[other]) for other in touching if other in numbers]
        others = len(touching) - len(known)
        known += [f"{others} {'other' if known else 'without number'}"] if others else []
        contacts = f"touches {', '.join(known)}" if known else "touches nothing"
        name = f" ({hull!r})" if names else ""
        yield f"{number}{name}: size {' x '.join(map(str, size))}, at {', '.join(map(str, middle))}; {contacts}"


def _split(hulls: Sequence[str], most: int) -> list[Sequence[str]]:
    """Hulls in as few groups as possible, of about the same size."""
    count = -(-len(hulls) // most)
    return [hulls[k * len(hulls) // count : (k + 1) * len(hulls) // count] for k in range(count)]


def _task_message(config: PromptConfig, up: str) -> Message:
    words, known, about = config.vocabulary, config.settings.descriptions, config.settings.about
    labels = [f"- {word}: {_to_line(known[word])}" if word in known else f"- {word}" for word in words]
    about = f". The objects are: {_to_line(about)}" if about else ""
    text = _TASK.format(labels="\n".join(labels), unknown=config.unknown, up=up, about=about, example=words[0])
    return Message("system", (text,))


def _answer_schema(config: PromptConfig, numbers: Iterable[int]) -> dict[str, Any]:
    """What the object is and its parts come first, so that the labels follow from them; no number can be left out."""
    label = {"type": "string", "enum": [*config.vocabulary, config.unknown]}
    hulls = make_object_schema(**{str(number): {"$ref": "#/$defs/label"} for number in numbers})
    parts = {"type": "array", "items": {"type": "string"}}
    return make_object_schema(object={"type": "string"}, parts=parts, hulls=hulls) | {"$defs": {"label": label}}


def _to_line(text: str) -> str:
    return " ".join(text.split()).rstrip(".")
