"""Limits on asking: what it may cost, and how long to wait between attempts."""

from __future__ import annotations

import math
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace

from meshforge.common import UsageError
from meshforge.labels.vlm.endpoint import EndError, Endpoint, TokenCount
from meshforge.labels.vlm.request import VlmQuestion

_CHARACTERS = 3.0  # of a text for a token; English has about four, other languages fewer
_PIXELS = 700.0  # of a picture for a token: models that name it take one for 750 (Claude) to 1370 (GPT-4o)
_PICTURE = 100  # tokens of a picture, however small
_REMEMBERED = 20  # answers by which the estimate is corrected
_MARGIN = 1.1

LONGEST = 60.0
"""The longest wait [s] between attempts that the server does not ask for."""
LONGEST_DEMAND = 300.0
"""The longest wait [s] that a server may want; where it wants more, the run ends."""
_POLL = 0.05  # seconds between looks at whether to stop


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


class CostLimiter:
    """Counts and limits; safe to use from several threads."""

    def __init__(self, endpoint: Endpoint, most: float | None = None) -> None:
        if most is not None and not endpoint.is_priced:
            remedy = "Write them into [vlm], in dollars a million tokens: input_price = ..., output_price = ..."
            raise UsageError("a limit on the cost needs to know the prices", remedy=remedy)
        self._endpoint, self._most = endpoint, most
        self._changed = threading.Condition()
        self._usage = Usage(cost=0.0 if endpoint.is_priced else None)
        self._reserved = 0.0
        self._ratios: deque[float] = deque(maxlen=_REMEMBERED)
        self._first_ratio = 1.0

    @property
    def usage(self) -> Usage:
        """What was spent so far."""
        with self._changed:
            return self._usage

    def upper_bound(self, question: VlmQuestion) -> float:
        """What a question may cost at most [$], as far as can be known."""
        with self._changed:
            ratio = max(self._ratios, default=self._first_ratio)
        expected = estimate_tokens(question)
        return self._endpoint.price(TokenCount(int(expected * max(1.0, ratio) * _MARGIN), question.limit))

    @contextmanager
    def reserve(self, bound: float, stop: Callable[[], bool]) -> Iterator[None]:
        """Keep so much [$] back while a question is under way. Raises EndError where it could pass the limit.

        Where only other questions under way are in its way, it waits for these; stop: whether to wait no longer.
        """
        with self._changed:
            most = math.inf if self._most is None else self._most
            while self._spent + bound <= most < self._spent + bound + self._reserved and not stop():
                self._changed.wait(0.1)
            if self._spent + bound > most:
                raise EndError(
                    f"the next question could cost up to ${bound:.4f}, and ${self._spent:.4f} of ${most:g} are spent",
                    remedy="Raise --max-cost to go on; what was answered is not paid for again.",
                )
            self._reserved += bound
        try:
            yield
        finally:
            with self._changed:
                self._reserved -= bound
                self._changed.notify_all()

    def charge(
        self, question: VlmQuestion, usage: TokenCount | None, *, is_probe: bool = False
    ) -> tuple[TokenCount, float]:
        """Count an answer, also one of no use; its tokens, estimated where the server names none, and its cost [$]."""
        expected = estimate_tokens(question)
        counted = usage or TokenCount(expected, 0, estimated=True)
        price = self._endpoint.price(counted)
        with self._changed:
            before = self._usage
            cost = None if before.cost is None else before.cost + price
            self._usage = replace(before, answered=before.answered + 1, usage=before.usage + counted, cost=cost)
            if usage and is_probe:
                self._first_ratio = usage.input / expected
            elif usage:
                self._ratios.append(usage.input / expected)
            self._changed.notify_all()
        return counted, price

    def count_lost(self, bound: float) -> None:
        """Count an attempt that got no answer and may be charged for."""
        with self._changed:
            self._usage = replace(self._usage, lost=self._usage.lost + 1, perhaps=self._usage.perhaps + bound)

    def count(self, *, cached: int = 0, retries: int = 0) -> None:
        """Count questions that were answered already, and attempts beyond the first."""
        with self._changed:
            before = self._usage
            self._usage = replace(before, cached=before.cached + cached, retries=before.retries + retries)

    @property
    def _spent(self) -> float:
        return (self._usage.cost or 0.0) + self._usage.perhaps


def estimate_tokens(question: VlmQuestion) -> int:
    """About how many tokens a question has; models differ widely in how they count pictures."""
    pictures = sum(_PICTURE + width * height / _PIXELS for width, height in map(_png_size, question.pictures))
    return int(len(question.text) / _CHARACTERS + pictures) + 1


def _png_size(picture: bytes) -> tuple[int, int]:
    return int.from_bytes(picture[16:20], "big"), int.from_bytes(picture[20:24], "big")


class Backoff:
    """When the server may be asked again; safe to use from several threads.

    What it says to one question holds for all, since it counts them together.
    """

    def __init__(self, first: float, stop: Callable[[], bool]) -> None:
        self._first, self._stop = first, stop
        self._lock = threading.Lock()
        self._closed_until = 0.0

    def back_off(self, attempt: int, after: float | None, jitter: float) -> None:
        """Wait after failed attempt number `attempt`, counted from 0; after [s]: what the server wants.

        jitter in 0..1 keeps questions apart that failed at one time. Raises EndError: that is too long, or a stop.
        """
        if after is not None and after > LONGEST_DEMAND:
            remedy = "Go on then; what was answered is not asked again."
            raise EndError(f"the server wants to be left alone for {after / 60:.0f} minutes", remedy=remedy)
        if after:
            with self._lock:
                self._closed_until = max(self._closed_until, time.monotonic() + after)
        self._wait_until(time.monotonic() + min(self._first * 2**attempt, LONGEST) * (0.75 + jitter / 2))

    def wait(self) -> None:
        """Wait as long as the server wants no question. Raises EndError for a stop."""
        while True:
            with self._lock:
                until = self._closed_until
            self._wait_until(until)
            with self._lock:
                if self._closed_until <= until:
                    return

    def _wait_until(self, moment: float) -> None:
        while (left := moment - time.monotonic()) > 0:
            self.raise_if_stopped()
            time.sleep(min(left, _POLL))
        self.raise_if_stopped()

    def raise_if_stopped(self) -> None:
        """Raises EndError where a stop is wanted."""
        if self._stop():
            raise EndError("stopped", remedy="What was answered is kept, and is not asked again.")
