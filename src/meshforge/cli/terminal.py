"""The terminal: results to stdout, progress and remarks to stderr, and Ctrl-C."""

from __future__ import annotations

import json
import signal
import sys
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from types import FrameType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.table import Table


def print_json(value: Any, *, compact: bool = False) -> None:
    """One JSON document: indented for reading, or on a single line."""
    print(json.dumps(value, ensure_ascii=False, indent=None if compact else 2), flush=compact)


def remark(text: str) -> None:
    """A remark that is not part of the result."""
    print(text, file=sys.stderr)


def print_table(columns: Sequence[str], rows: Iterable[Sequence[Any]], *, right: Sequence[str] = ()) -> None:
    """A table on stdout; columns named in `right` are aligned to the right. Piped, no line is broken."""
    from rich.console import Console

    console = Console(width=None if sys.stdout.isatty() else 1_000_000, highlight=False)
    console.print(_build_table(columns, rows, right))


def _build_table(columns: Sequence[str], rows: Iterable[Sequence[Any]], right: Sequence[str]) -> Table:
    from rich import box
    from rich.table import Table
    from rich.text import Text

    made = Table(box=box.SIMPLE_HEAD, pad_edge=False, show_edge=False)
    for name in columns:
        made.add_column(name, justify="right" if name in right else "left", overflow="fold")
    for row in rows:
        made.add_row(*(Text("" if cell is None else str(cell)) for cell in row))
    return made


@contextmanager
def progress(total: int | None, what: str) -> Iterator[Callable[[], None]]:
    """A bar on stderr for work on several assets, with its rate and the time that is left; silent where piped.

    Gives the function that counts one more. What is printed to stdout meanwhile goes there, also where that is no
    terminal.
    """
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, Task, TextColumn, TimeRemainingColumn
    from rich.text import Text

    class Rate(TextColumn):
        def render(self, task: Task) -> Text:
            return Text(f"{task.speed:.1f}/s" if task.speed else "")

    console = Console(stderr=True)
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), Rate(""), TimeRemainingColumn())
    with Progress(
        *columns,
        console=console,
        transient=True,
        redirect_stdout=sys.stdout.isatty(),
        speed_estimate_period=120,
        disable=not console.is_terminal,
    ) as bar:
        task = bar.add_task(what, total=total)
        yield lambda: bar.advance(task)


@contextmanager
def show_status(what: str) -> Iterator[None]:
    """Say on stderr what is being done, for as long as it takes. Silent where piped."""
    from rich.console import Console

    console = Console(stderr=True)
    if not console.is_terminal:
        yield
        return
    with console.status(what):
        yield


@contextmanager
def catch_interrupt() -> Iterator[Callable[[], bool]]:
    """Within the block the first Ctrl-C only sets what the given function tells: whether to stop."""
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
