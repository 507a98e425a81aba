from __future__ import annotations

from collections.abc import Callable

import pytest

from meshforge.labels.vlm.endpoint import EndError
from meshforge.labels.vlm.limits import LONGEST, Backoff


class Clock:
    """Time that passes only when somebody sleeps."""

    def __init__(self) -> None:
        self.now = 100.0

    def monotonic(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.now += seconds


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    made = Clock()
    monkeypatch.setattr("meshforge.labels.vlm.limits.time", made)
    return made


def waited(clock: Clock, work: Callable[[], None]) -> float:
    before = clock.now
    work()
    return clock.now - before


def test_each_wait_is_twice_the_last_up_to_the_longest(clock: Clock) -> None:
    patience = Backoff(1.0, lambda: False)
    waits = [waited(clock, lambda k=k: patience.back_off(k, None, 0.5)) for k in range(9)]  # type: ignore[misc]
    assert waits == pytest.approx([1, 2, 4, 8, 16, 32, LONGEST, LONGEST, LONGEST])


def test_questions_that_fail_together_come_back_apart(clock: Clock) -> None:
    patience = Backoff(1.0, lambda: False)
    waits = [waited(clock, lambda s=s: patience.back_off(2, None, s)) for s in (0.0, 1.0)]  # type: ignore[misc]
    assert waits == pytest.approx([3.0, 5.0])


def test_what_the_server_wants_waited_holds_for_all_questions(clock: Clock) -> None:
    patience = Backoff(0.1, lambda: False)
    start = clock.now
    patience.back_off(0, 20.0, 0.5)
    assert clock.now == pytest.approx(
        start + 0.1
    )  # its own back-off; what the server wants is waited for before asking
    patience.wait()
    assert clock.now == pytest.approx(start + 20)
    patience.wait()
    assert clock.now == pytest.approx(start + 20)


def test_a_wait_that_is_too_long_ends_the_asking(clock: Clock) -> None:
    with pytest.raises(EndError, match="left alone for 60 minutes"):
        Backoff(0.1, lambda: False).back_off(0, 3600.0, 0.5)


def test_a_stop_cuts_a_wait_short(clock: Clock) -> None:
    patience = Backoff(50.0, lambda: clock.now > 101)
    with pytest.raises(EndError, match="stopped"):
        patience.back_off(0, None, 0.5)
    assert clock.now < 101.2
