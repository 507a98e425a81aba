"""Tables on stdout, bars and lines that say what is being done on stderr; drawn by rich where a terminal is."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from time import monotonic
from typing import Any

from meshforge.cli.terminal import escape_output
from meshforge.common import escape_name

_REFRESH_SECONDS = 0.1
_TERMINAL_SETTINGS = frozenset({"FORCE_COLOR", "TTY_COMPATIBLE"})
"""Variables by which rich takes what is no terminal for one."""


def print_table(columns: Sequence[str], rows: Iterable[Sequence[Any]], *, right: Sequence[str] = ()) -> None:
    """A table on stdout; columns named in `right` are aligned to the right. Piped, no line is broken."""
    texts = [["" if cell is None else escape_name(str(cell)) for cell in row] for row in rows]
    is_plain = all(text.isascii() and text.isprintable() for row in texts for text in row)
    if is_plain and not sys.stdout.isatty() and not _TERMINAL_SETTINGS.intersection(os.environ):
        _print_plain_table(columns, texts, right)
        return
    from rich import box  # lazy: 0.1 s, half of the time of short commands; also below
    from rich.console import Console  # lazy: as box
    from rich.table import Table  # lazy: as box
    from rich.text import Text  # lazy: as box

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, show_edge=False)
    for name in columns:
        table.add_column(name, justify="right" if name in right else "left", overflow="fold")
    for row in texts:
        table.add_row(*map(Text, row))
    Console(width=None if sys.stdout.isatty() else 1_000_000, highlight=False).print(table)


def _print_plain_table(columns: Sequence[str], rows: Sequence[Sequence[str]], right: Sequence[str]) -> None:
    """What rich prints where there is no terminal."""
    widths = [max(map(len, column)) for column in zip(columns, *rows, strict=True)]
    rule = "─" * (sum(widths) + 3 * (len(widths) - 1))
    lines = [
        "   ".join(
            cell.rjust(width) if name in right else cell.ljust(width)
            for name, cell, width in zip(columns, row, widths, strict=True)
        )
        for row in (columns, *rows)
    ]
    print("\n".join([lines[0], rule, *lines[1:]]))


@contextmanager
def progress(total: int | None, what: str) -> Iterator[Callable[[], None]]:
    """A bar on stderr for work on several assets, with its rate and the time that is left; silent where piped.

    Gives the function that counts one more. What is printed to stdout meanwhile goes there, also where that is no
    terminal.
    """
    if not sys.stderr.isatty() and not _TERMINAL_SETTINGS.intersection(os.environ):
        yield lambda: None
        return
    from rich import progress as bars  # lazy: as above
    from rich.console import Console  # lazy: as above
    from rich.text import Text  # lazy: as above

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
        task, drawn = bar.add_task(escape_name(what), total=total), 0.0

        def advance() -> None:
            nonlocal drawn
            bar.advance(task)
            if (now := monotonic()) - drawn >= _REFRESH_SECONDS:
                drawn = now
                bar.refresh()

        with escape_output():  # while the bar is there, stdout is rich's, which takes controls for its own
            yield advance


@contextmanager
def show_status(what: str) -> Iterator[None]:
    """Say on stderr what is being done, for as long as it takes. Silent where piped."""
    from rich.console import Console  # lazy: as above

    console = Console(stderr=True)
    if not console.is_terminal:
        yield
        return
    with console.status(escape_name(what)):
        yield
