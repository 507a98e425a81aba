import os
import sys
import time
from collections.abc import Iterator, Sequence
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from threading import current_thread, main_thread

import pytest

from meshforge.batch import ExecutionOptions, WorkerFailure, hold_lock, run_isolated, workers
from meshforge.common import MeshForgeError, processes


@pytest.fixture(params=["server", "fork"], autouse=True)
def start_method(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Workers of a server process, as beside threads, and forks of this process, replaced from the server."""
    if request.param == "fork" and sys.platform != "linux":
        pytest.skip("forks are for Linux")
    can_fork = request.param == "fork"
    monkeypatch.setattr(processes, "_has_one_thread", lambda: can_fork and current_thread() is main_thread())


def square(number: int) -> int:
    return number * number


def square_or_crash(number: int) -> int:
    if number == 2:
        os.abort()
    return number * number


def square_or_hang(number: int) -> int:
    if number == 1:
        time.sleep(60)
    return number * number


def raise_at_two(number: int) -> int:
    if number == 2:
        raise KeyError("two")
    return number


def die_if_odd(number: int) -> int:
    if number % 2:
        os._exit(3)
    return number


def sleep_from_one_on(number: int) -> int:
    time.sleep(60 * min(number, 1))
    return number


def test_results_come_in_the_order_of_the_items() -> None:
    assert list(run_isolated(square, range(40), ExecutionOptions(2, None))) == [n * n for n in range(40)]


def test_no_workers_means_this_process() -> None:
    seen: list[int] = []
    done: list[None] = []

    def note(number: int) -> int:
        seen.append(number)
        return number

    assert list(run_isolated(note, [1, 2, 3], ExecutionOptions(0, progress=lambda: done.append(None)))) == [1, 2, 3]
    assert seen == [1, 2, 3] and len(done) == 3


def test_a_crash_in_native_code_loses_one_item_only() -> None:
    results = list(run_isolated(square_or_crash, range(5), ExecutionOptions(2, None)))
    assert results[2] == WorkerFailure("its worker process died (SIGABRT)")
    assert results[:2] + results[3:] == [0, 1, 9, 16]


def test_a_hang_is_stopped_and_loses_one_item_only() -> None:
    results = list(run_isolated(square_or_hang, range(4), ExecutionOptions(2, 0.5)))
    assert results[1] == WorkerFailure("it took longer than 0.5 seconds and was stopped", 0.5)
    assert results[:1] + results[2:] == [0, 4, 9]


def test_a_caller_gets_what_the_function_raised_with_where_that_was() -> None:
    results = run_isolated(raise_at_two, range(5), ExecutionOptions(2, None))
    assert [next(results), next(results)] == [0, 1]
    with pytest.raises(KeyError, match="two") as raised:
        next(results)
    assert "raise_at_two" in str(raised.value.__cause__)


def test_every_item_that_kills_its_worker_is_named_and_no_other_one() -> None:
    results = list(run_isolated(die_if_odd, range(12), ExecutionOptions(2, None)))
    assert [k for k, result in enumerate(results) if isinstance(result, WorkerFailure)] == list(range(1, 12, 2))
    assert results[1] == WorkerFailure("its worker process died (exit code 3)")


def test_where_a_pool_is_given_up_another_one_goes_on(monkeypatch: pytest.MonkeyPatch) -> None:
    """As pebble does where a worker dies before it said what it works on."""
    begun: list[tuple[int, ...]] = []

    def run_one(_function: object, items: Sequence[int], *_: object) -> Iterator[int]:
        begun.append(tuple(items))
        yield from map(square, items[:2])
        raise BrokenProcessPool("All workers expired")

    monkeypatch.setattr(workers, "_run_pool", run_one)
    results = run_isolated(square, [1, 2, 3, 4], ExecutionOptions(2))
    assert [next(results) for _ in range(4)] == [1, 4, 9, 16]
    with pytest.raises(MeshForgeError, match="worker processes do not start: All workers expired"):
        next(results)
    assert begun == [(1, 2, 3, 4), (3, 4), (), ()]


def test_a_lock_is_not_held_by_the_workers_of_who_holds_it(tmp_path: Path) -> None:
    results = run_isolated(sleep_from_one_on, range(5), ExecutionOptions(1, None))
    with hold_lock(tmp_path / "lock", "this", wait=0):
        assert next(results) == 0
    with hold_lock(tmp_path / "lock", "this", wait=0):
        results.close()
