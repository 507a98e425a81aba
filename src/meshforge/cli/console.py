"""What rich draws: tables on stdout, bars and lines that say what is being done on stderr.

Apart from the terminal's other functions, so that commands which draw nothing do not load rich.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from time import monotonic
from typing import Any

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

_REFRESH_SECONDS = 0.1


def print_table(columns: Sequence[str], rows: Iterable[Sequence[Any]], *, right: Sequence[str] = ()) -> None:
    """A table on stdout; columns named in `right` are aligned to the right. Piped, no line is broken."""
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, show_edge=False)
    for name in columns:
        table.add_column(name, justify="right" if name in right else "left", overflow="fold")
    for row in rows:
        table.add_row(*(Text("" if cell is None else str(cell)) for cell in row))
    console = Console(width=None if sys.stdout.isatty() else 1_000_000, highlight=False)
    console.print(table)


@contextmanager
def progress(total: int | None, what: str) -> Iterator[Callable[[], None]]:
    """A bar on stderr for work on several assets, with its rate and the time that is left; silent where piped.

    Gives the function that counts one more. What is printed to stdout meanwhile goes there, also where that is no
    terminal.
    """
    from rich import progress as bars  # lazy: 10 modules that a table does not need

    class RateColumn(bars.TextColumn):
        def render(self, task: bars.Task) -> Text:
            return Text(f"{task.speed:.1f}/s" if task.speed else "")

    console = Console(stderr=True)
    with bars.Progress(
        bars.TextColumn("{task.description}"),
        bars.BarColumn(),
        bars.MofNCompleteColumn(),
        RateColumn(""),
        bars.TimeRemainingColumn(),
        console=console,
        transient=True,
        redirect_stdout=sys.stdout.isatty(),
        speed_estimate_period=120,
        disable=not console.is_terminal,
        auto_refresh=False,  # by a thread, beside which workers could not start by a fork
    ) as bar:
        task, drawn = bar.add_task(what, total=total), 0.0

        def advance() -> None:
            nonlocal drawn
            bar.advance(task)
            if (now := monotonic()) - drawn >= _REFRESH_SECONDS:
                drawn = now
                bar.refresh()

        yield advance


@contextmanager
def show_status(what: str) -> Iterator[None]:
    """Say on stderr what is being done, for as long as it takes. Silent where piped."""
    console = Console(stderr=True)
    if not console.is_terminal:
        yield
        return
    with console.status(what):
        yield
