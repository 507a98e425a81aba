"""Dying in the midst of work: a forked process that ends, as if killed, just before its k-th rename.

Costly work dies before its first rename, its second, fourth, eighth and so on, and before each in `script/test --long`.
"""

import os
import signal
import traceback
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.slow_tests import is_long

_SECONDS = 120  # that the work may take; it would hang for ever where a lock was held while forking
needs_fork = pytest.mark.skipif(not hasattr(os, "fork"), reason="this system cannot fork")


def deaths(work: Callable[[], object], *, removals: bool = False, costly: bool = False) -> Iterator[int]:
    """Do the work again and again in a process that dies before its first rename, its second, and so on.

    removals: files and folders that are removed count as well; costly: leave most of them out. Gives the number of
    renames after each death; ends when the work came to its end, which it must not at first.
    """
    rename, calls = 0, ("replace", "unlink", "rmdir") if removals else ("replace",)
    while not _survives(work, rename, calls):
        yield rename
        rename = 2 * rename + 1 if costly and not is_long() else rename + 1
    assert rename, "the work came to its end without a rename"


def _survives(work: Callable[[], object], rename: int, calls: tuple[str, ...]) -> bool:
    child = os.fork()
    if child == 0:
        _work_and_die(work, rename, calls)
    _, status = os.waitpid(child, 0)
    code = os.waitstatus_to_exitcode(status)
    assert code in (0, 9), f"the work failed with exit code {code}"
    return code == 0


def _work_and_die(work: Callable[[], object], renames: int, calls: tuple[str, ...]) -> None:
    signal.alarm(_SECONDS)
    done = 0

    def count(real: Callable[..., object]) -> Callable[..., object]:
        def call(*args: object, **options: object) -> object:
            nonlocal done
            if done == renames:
                os._exit(9)  # nothing is flushed, no `finally` runs, as under SIGKILL
            done += 1
            return real(*args, **options)

        return call

    for name in calls:
        setattr(Path, name, count(getattr(Path, name)))
    try:
        work()
    except BaseException:
        traceback.print_exc()
        os._exit(1)
    os._exit(0)
