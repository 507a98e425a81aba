"""What asking costs, and the limit on it: no question is asked that could pass it."""

import math
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace

from meshforge.common import UsageError
from meshforge.labels.vlm.endpoint import EndError, Endpoint
from meshforge.labels.vlm.question import Reply, VlmQuestion

_CHARACTERS = 3.0  # of a text for a token; English has about four, other languages fewer
_PIXELS = 700.0  # of a picture for a token: models that name it take one for 750 (Claude) to 1370 (GPT-4o)
_PICTURE = 100  # tokens of a picture, however small
_MARGIN = 1.1


@dataclass(slots=True)
class Usage:
    """What was asked, and what it cost. answered: questions that got an answer for money; cached: those that had one.

    retries: attempts beyond the first of a question; input, output: tokens of all answers, also of those of no use;
    estimated: answers of which the server named none; cost: of these [$], None where prices are not known; perhaps:
    what attempts that got no answer may cost [$] at most, should the server charge for them.
    """

    answered: int = 0
    cached: int = 0
    retries: int = 0
    input: int = 0
    output: int = 0
    estimated: int = 0
    cost: float | None = 0.0
    perhaps: float = 0.0


class CostLimiter:
    """Counts and limits; safe to use from several threads. most: what may be spent [$], None for all."""

    def __init__(self, endpoint: Endpoint, most: float | None = None) -> None:
        if most is not None and not endpoint.is_priced:
            remedy = "Write them into [vlm], in dollars a million tokens: input_price = ..., output_price = ..."
            raise UsageError("a limit on the cost needs to know the prices", remedy=remedy)
        self._counts = Usage()
        self._endpoint, self._most = endpoint, math.inf if most is None else most
        self._changed = threading.Condition()
        self._spent = self._reserved = 0.0
        self._ratio = 1.0  # how far the estimate was below what the server counted, at worst

    @property
    def usage(self) -> Usage:
        """What was asked so far."""
        return replace(self._counts, cost=self._counts.cost if self._endpoint.is_priced else None)

    @contextmanager
    def reserve(self, question: VlmQuestion, stop: Callable[[], bool]) -> Iterator[float]:
        """Keep back what a question may cost at most [$] while it is under way, as far as can be known, and give that.

        Where only other questions are in its way, it waits for these; stop: whether to wait no longer. Raises EndError
        where it could pass the limit.
        """
        bound = self._endpoint.price(estimate_tokens(question) * self._ratio * _MARGIN, question.limit)
        with self._changed:
            while self._spent + bound <= self._most < self._spent + bound + self._reserved and not stop():
                self._changed.wait(0.1)
            if self._spent + bound > self._most:
                spent = f"${self._spent:.4f} of ${self._most:g} are spent"
                remedy = "Raise --max-cost to go on; what was answered is not paid for again."
                raise EndError(f"the next question could cost up to ${bound:.4f}, and {spent}", remedy=remedy)
            self._reserved += bound
        try:
            yield bound
        finally:
            with self._changed:
                self._reserved -= bound
                self._changed.notify_all()

    def charge(self, question: VlmQuestion, reply: Reply) -> Reply:
        """Count an answer, also one of no use. Return it with its tokens, estimated if need be, and its cost [$]."""
        expected = estimate_tokens(question)
        if reply.estimated:
            reply = replace(reply, input_tokens=expected)
        cost = self._endpoint.price(reply.input_tokens, reply.output_tokens)
        self._ratio = max(self._ratio, reply.input_tokens / expected)
        tokens = {"input": reply.input_tokens, "output": reply.output_tokens, "estimated": reply.estimated}
        self.count(answered=1, cost=cost, **tokens)
        return replace(reply, cost=cost)

    def count(self, **more: float) -> None:
        """Add to what was asked and spent; more: fields of `Usage`."""
        with self._changed:
            for name, value in more.items():
                setattr(self._counts, name, getattr(self._counts, name) + value)
            self._spent += more.get("cost", 0) + more.get("perhaps", 0)
            self._changed.notify_all()


def estimate_tokens(question: VlmQuestion) -> int:
    """Return about how many tokens a question has; models differ widely in how they count pictures."""
    sizes = ((int.from_bytes(png[16:20]), int.from_bytes(png[20:24])) for png in question.pictures)
    pictures = sum(_PICTURE + width * height / _PIXELS for width, height in sizes)
    return int(len(question.text) / _CHARACTERS + pictures) + 1
