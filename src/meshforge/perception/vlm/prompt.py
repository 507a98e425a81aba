"""The words of a question about hulls."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from meshforge.perception.vlm.manner import Manner
from meshforge.perception.vlm.question import Message, Part

if TYPE_CHECKING:
    from meshforge.views import Shot

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


def instructions(manner: Manner, up: str, repeat: int = 0) -> Message:
    """What the task is; up: the axis that points up."""
    words = manner.words(repeat)
    labels = [
        f"- {word}: {_line(manner.descriptions[word])}" if word in manner.descriptions else f"- {word}"
        for word in words
    ]
    about = f". The objects are: {_line(manner.about)}" if manner.about else ""
    text = _TASK.format(labels="\n".join(labels), unknown=manner.unknown, up=up, about=about, example=words[0])
    return Message.system(text)


def request(shots: Sequence[Shot], plain: int, numbers: Mapping[str, int], name: str = "") -> Message:
    """Pictures, and the numbers that are asked about.

    plain: of how many of the first pictures the same without numbers is shown; numbers: by hull, with the names of the
    hulls told where `name`, that of the asset, is given.
    """
    from meshforge.views import png

    parts: list[Part] = [f"This is {name!r}." if name else "This is the object."]
    for k, shot in enumerate(shots):
        parts += [f"Picture: {shot.name}.", png(shot.marked)]
        if k < plain:
            parts += ["The same without numbers.", png(shot.plain)]
    told = ", ".join(
        f"{n} ({hull!r})" if name else str(n) for hull, n in sorted(numbers.items(), key=lambda row: row[1])
    )
    parts.append(f"Which part does each of these pieces belong to: {told}?")
    return Message("user", tuple(parts))


def example(labels: Mapping[int, str]) -> Message:
    """The right answer about an asset that is shown as an example."""
    rows = ", ".join(f'{{"number": {number}, "label": {_quoted(label)}}}' for number, label in sorted(labels.items()))
    return Message.assistant(f'{{"hulls": [{rows}]}}')


def again(numbers: Sequence[int], odd: Sequence[str]) -> Message:
    """The words that ask once more for what an answer left open; odd: words in it that are no labels."""
    why = f" ({', '.join(map(_quoted, odd))} {'is no label' if len(odd) == 1 else 'are no labels'})" if odd else ""
    return Message.user(_AGAIN.format(why=why, numbers=", ".join(map(str, numbers))))


def form(manner: Manner, repeat: int = 0) -> dict[str, Any]:
    """The JSON schema of an answer."""
    labels = {"type": "string", "enum": [*manner.words(repeat), manner.unknown]}
    entry = {"number": {"type": "integer"}, "label": labels}
    row = {"type": "object", "properties": entry, "required": list(entry), "additionalProperties": False}
    return {
        "type": "object",
        "properties": {"hulls": {"type": "array", "items": row}},
        "required": ["hulls"],
        "additionalProperties": False,
    }


def _line(text: str) -> str:
    return " ".join(text.split()).rstrip(".")


def _quoted(text: str) -> str:
    import json

    return json.dumps(text, ensure_ascii=False)
