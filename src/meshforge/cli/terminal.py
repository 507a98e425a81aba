"""The terminal: JSON to stdout, remarks to stderr, and Ctrl-C."""

from __future__ import annotations

import json
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any


def print_json(value: Any, *, compact: bool = False) -> None:
    """One JSON document: indented for reading, or on a single line."""
    print(json.dumps(value, ensure_ascii=False, indent=None if compact else 2), flush=compact)


def remark(text: str) -> None:
    """A remark that is not part of the result."""
    print(text, file=sys.stderr)


@contextmanager
def catch_interrupt() -> Iterator[Callable[[], bool]]:
    """Within the block the first Ctrl-C only makes the given function say that it is time to stop."""
    stopped = False

    def note(number: int, frame: FrameType | None) -> None:
        nonlocal stopped
        if stopped:
            signal.default_int_handler(number, frame)
        stopped = True

    if threading.current_thread() is not threading.main_thread():  # where signals cannot be handled
        yield lambda: stopped
        return
    before = signal.signal(signal.SIGINT, note)
    try:
        yield lambda: stopped
    finally:
        signal.signal(signal.SIGINT, before)
