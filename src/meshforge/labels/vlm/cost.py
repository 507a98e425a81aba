"""What asking costs, and the limit on it: no attempt is made that could pass it."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from dataclasses import dataclass, field

from meshforge.common import UsageError
from meshforge.labels.vlm.endpoint import EndError, Endpoint, TokenCount
from meshforge.labels.vlm.question import VlmQuestion

_CHARACTERS = 3.0  # of a text for a token; English has about four, other languages fewer
_PIXELS = 700.0  # of a picture for a token: models that name it take one for 750 (Claude) to 1370 (GPT-4o)
_PICTURE = 100  # tokens of a picture, however small
_MARGIN = 1.1


@dataclass(frozen=True, slots=True)
class Usage:
    """What was asked, and what it cost. answered: questions that got an answer for money; cached: those that had one.

    retries: attempts beyond the first of a question; usage: tokens of all answers, also of those of no use;
    cost: of these [$], None where prices are not known; perhaps: what attempts that were lost on the way may cost [$]
    at most, should the server charge for them, and lost their number.
    """

    answered: int = 0
    cached: int = 0
    retries: int = 0
    usage: TokenCount = field(default_factory=TokenCount)
    cost: float | None = None
    perhaps: float = 0.0
    lost: int = 0

    def __add__(self, other: Usage) -> Usage:
        cost = None if self.cost is None else self.cost + (other.cost or 0.0)
        names = ("answered", "cached", "retries", "usage", "perhaps", "lost")
        rest = {name: getattr(self, name) + getattr(other, name) for name in names}
        return Usage(cost=cost, **rest)


class CostLimiter:
    """Counts and limits; safe to use from several threads. most: what may be spent [$], None for all."""

    def __init__(self, endpoint: Endpoint, most: float | None = None) -> None:
        if most is not None and not endpoint.is_priced:
            remedy = "Write them into [vlm], in dollars a million tokens: input_price = ..., output_price = ..."
            raise UsageError("a limit on the cost needs to know the prices", remedy=remedy)
        self.usage = Usage(cost=0.0 if endpoint.is_priced else None)
        self._endpoint, self._most = endpoint, math.inf if most is None else most
        self._changed = threading.Condition()
        self._reserved = 0.0
        self._ratio = 1.0  # how far the estimate was below what the server counted, at worst

    def upper_bound(self, question: VlmQuestion) -> float:
        """Return what a question may cost at most [$], as far as can be known."""
        most = estimate_tokens(question) * self._ratio * _MARGIN
        return self._endpoint.price(TokenCount(int(most), question.limit))

    def reserve(self, bound: float, stop: Callable[[], bool]) -> None:
        """Keep so much [$] back while an attempt is under way. Raises EndError where it could pass the limit.

        Where only other attempts under way are in its way, it waits for these; stop: whether to wait no longer.
        """
        with self._changed:
            while self._spent + bound <= self._most < self._spent + bound + self._reserved and not stop():
                self._changed.wait(0.1)
            if self._spent + bound > self._most:
                spent = f"${self._spent:.4f} of ${self._most:g} are spent"
                remedy = "Raise --max-cost to go on; what was answered is not paid for again."
                raise EndError(f"the next question could cost up to ${bound:.4f}, and {spent}", remedy=remedy)
            self._reserved += bound

    def release(self, bound: float, *, is_lost: bool) -> None:
        """Give back what was reserved; is_lost: no answer came, and yet the server may charge for one."""
        with self._changed:
            self._reserved -= bound
            self.usage += Usage(perhaps=bound, lost=1) if is_lost else Usage()
            self._changed.notify_all()

    def charge(self, question: VlmQuestion, usage: TokenCount | None) -> tuple[TokenCount, float]:
        """Count an answer, also one of no use. Return its tokens, estimated if need be, and cost [$]."""
        expected = estimate_tokens(question)
        counted = usage or TokenCount(expected, 0, estimated=True)
        price = self._endpoint.price(counted)
        with self._changed:
            self._ratio = max(self._ratio, counted.input / expected)
        self.count(Usage(answered=1, usage=counted, cost=price))
        return counted, price

    def count(self, more: Usage) -> None:
        """Add to what was asked and spent."""
        with self._changed:
            self.usage += more
            self._changed.notify_all()

    @property
    def _spent(self) -> float:
        return (self.usage.cost or 0.0) + self.usage.perhaps


def estimate_tokens(question: VlmQuestion) -> int:
    """Return about how many tokens a question has; models differ widely in how they count pictures."""
    sizes = ((int.from_bytes(png[16:20]), int.from_bytes(png[20:24])) for png in question.pictures)
    pictures = sum(_PICTURE + width * height / _PIXELS for width, height in sizes)
    return int(len(question.text) / _CHARACTERS + pictures) + 1
