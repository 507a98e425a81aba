"""Asking again and again: an answer is tried on the demonstrations, and what is wrong with it is told to the model."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from typing import Any

from meshforge.labels.vlm.client import Client
from meshforge.labels.vlm.question import Message, Part, Reply, VlmQuestion

ROUNDS = 5
"""Answers that a model may give: the first, and four that mend it."""
_QUOTED = 8000  # characters of an answer that are put before the model again
_FENCED = re.compile(r"^[ \t]*```[^\n]*\n(.*?)^[ \t]*```[ \t]*$", re.DOTALL | re.MULTILINE)
_BEGUN = re.compile(r"^[ \t]*```[^\n]*\n(.*)\Z", re.DOTALL | re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Trial:
    """An answer on the demonstrations. text: the program or script, None where there is none that can be read.

    wrong: how much of it is wrong there, 0 where it does as was shown; said: what the model is told about that.
    """

    text: str | None
    wrong: int
    said: tuple[Part, ...] = ()


@dataclass(slots=True)
class Answer:
    """What came of asking. text: the answer that did best, None where none could be read; fits: whether it does on the
    demonstrations what was shown.

    rounds: answers that were given; wrong: of each; input, output: tokens; cost: when they were asked [$].
    """

    text: str | None = None
    fits: bool = False
    rounds: int = 0
    wrong: list[int | None] = field(default_factory=list)
    input: int = 0
    output: int = 0
    cost: float = 0.0

    def to_json(self) -> dict[str, Any]:
        return asdict(self)


def refine(client: Client, opening: tuple[Message, ...], try_answer: Callable[[str], Trial], room: int) -> Answer:
    """Ask until an answer does as was shown, or for so many rounds. Raises AskingError.

    room: tokens for an answer.
    """
    written, messages, least = Answer(), opening, 0
    while not written.fits and written.rounds < ROUNDS:
        reply = client.ask(VlmQuestion(messages, limit=room))
        _count(written, reply)
        one = try_answer(reply.text)
        written.wrong.append(None if one.text is None else one.wrong)
        if one.text is not None and (written.text is None or one.wrong <= least):
            written.text, least = one.text, one.wrong
        written.fits = one.text is not None and not one.wrong
        cut = ("Your answer was cut off: answer more briefly.\n",) if reply.finish == "length" else ()
        back = Message("assistant", (reply.text[:_QUOTED].strip() or "-",))
        messages = (*messages, back, Message("user", (*cut, *one.said)))
    return written


def find_code(text: str) -> str:
    """The last block of code in an answer, be it closed or not; where there is none, all of it."""
    blocks = _FENCED.findall(text) or _BEGUN.findall(text)
    return str(blocks[-1] if blocks else text).strip()


def _count(written: Answer, reply: Reply) -> None:
    written.rounds += 1
    written.input, written.output = written.input + reply.input_tokens, written.output + reply.output_tokens
    written.cost += reply.cost
