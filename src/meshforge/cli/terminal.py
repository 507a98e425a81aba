"""The terminal: JSON to stdout, remarks to stderr, nothing that would control it, and Ctrl-C."""

import json
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any


class _SafeStream:
    """A text stream to which what would control a terminal is written as `\\x1b`; all else is that of the stream."""

    def __init__(self, stream: Any) -> None:
        self._stream = stream
        self.rich_proxied_file = bare_stream(stream)  # rich writes its own controls there

    def write(self, text: str) -> int:
        self._stream.write(_escape(text))
        return len(text)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


def bare_stream(stream: Any) -> Any:
    """Return the stream below one that escapes, for what is to control the terminal."""
    return getattr(stream, "rich_proxied_file", stream)


def _escape(text: str) -> str:
    if text.isascii() and text.replace("\n", "").isprintable():
        return text
    from meshforge.common import escape_text  # lazy: 0.04 s, not needed for the list of commands

    return escape_text(text)


@contextmanager
def escape_output() -> Iterator[None]:
    """Print within the block what names and files would do to a terminal, not done, on stdout and stderr."""
    before = sys.stdout, sys.stderr
    sys.stdout, sys.stderr = _SafeStream(sys.stdout), _SafeStream(sys.stderr)
    try:
        yield
    finally:
        sys.stdout, sys.stderr = before


def print_json(value: Any, *, compact: bool = False) -> None:
    """Print one JSON document: indented for reading, or on a single line."""
    text = json.dumps(value, ensure_ascii=False, indent=None if compact else 2)
    if _escape(text) != text:  # by escapes of JSON, with which it reads back as the same
        text = "".join(one if _escape(one) == one else json.dumps(one)[1:-1] for one in text)
    print(text, flush=compact)


def print_exact(text: str) -> None:
    """Print text that a program may read: as it is where stdout is no terminal."""
    stream = sys.stdout if sys.stdout.isatty() else bare_stream(sys.stdout)
    stream.write(text)


def remark(text: str) -> None:
    """Print a remark that is not part of the result."""
    print(text, file=sys.stderr)


@contextmanager
def catch_interrupt(notice: str = "") -> Iterator[Callable[[], bool]]:
    """Let the first Ctrl-C within the block only make the given function say that it is time to stop; notice: what is
    then written on stderr."""
    stopped = False

    def note(number: int, frame: FrameType | None) -> None:
        nonlocal stopped
        if stopped:
            signal.default_int_handler(number, frame)
        stopped = True
        os.write(2, notice.encode())  # as `print` may have been interrupted

    if threading.current_thread() is not threading.main_thread():  # where signals cannot be handled
        yield lambda: stopped
        return
    before = signal.signal(signal.SIGINT, note)
    try:
        yield lambda: stopped
    finally:
        signal.signal(signal.SIGINT, before)
