from __future__ import annotations

import gc
import os
import subprocess
import sys
import time
import weakref
from pathlib import Path

import pytest

from meshforge.batch import ExecutionOptions, WorkerFailure, run_isolated
from meshforge.batch.workers import worker_context


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


def test_a_caller_may_stop_early() -> None:
    results = run_isolated(square, range(1000), ExecutionOptions(1, None))
    assert next(results) == 0
    results.close()


def test_nothing_to_do_starts_no_process() -> None:
    assert list(run_isolated(square, [], ExecutionOptions(4, None))) == []


@pytest.mark.slow
def test_a_script_without_a_main_guard_is_told_what_to_do(tmp_path: Path) -> None:
    script = tmp_path / "script.py"
    call = "print(list(run_isolated(abs, [1, -2], ExecutionOptions(1))))"
    script.write_text(f"from meshforge.batch import ExecutionOptions, run_isolated\n{call}\n")
    done = subprocess.run([sys.executable, str(script)], capture_output=True, text=True, timeout=60)
    assert done.returncode == 1 and "if __name__ == '__main__'" in done.stderr


@pytest.mark.slow
def test_the_locks_of_a_pool_stay_for_workers_that_are_just_starting_until_the_pool_goes() -> None:
    context = worker_context()
    lock = weakref.ref(context.RLock())
    gc.collect()
    assert lock() is not None
    del context
    gc.collect()
    assert lock() is None
