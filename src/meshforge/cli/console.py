"""Tables and notes on stdout, and lines on stderr that say how far the work in hand is."""

from __future__ import annotations

import os
import re
import shutil
import signal
import sys
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, nullcontext, redirect_stdout, suppress
from pathlib import Path
from time import monotonic
from typing import Any

import typer

from meshforge.cli.terminal import bare_stream
from meshforge.common import escape_name, join_names, pluralize

QUIET_SECONDS = float(os.environ.get("MESHFORGE_PROGRESS_AFTER", "2"))
"""Work that takes no longer says nothing of how far it is, where stderr is no terminal."""
_REFRESH_SECONDS = 0.1
_SELDOM = 30.0  # seconds between two lines at most, where stderr is no terminal
_COUNT = re.compile(r"(\d+) of (\d+)")
_CLEAR = "\r\x1b[K"
_TERMINAL_SETTINGS = frozenset({"FORCE_COLOR", "TTY_COMPATIBLE"})
"""Variables by which rich takes what is no terminal for one."""


def print_table(columns: Sequence[str], rows: Iterable[Sequence[Any]], *, right: Sequence[str] = ()) -> None:
    """Print a table on stdout; columns named in `right` are aligned to the right. Piped, no line is broken."""
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


class Progress:
    """What is said on stderr of work in hand: how much of it is done, seconds, and about how many are left.

    Called, it counts one more. At a terminal it is one line, which goes when the work ends; else a line after 2
    seconds, and then ever more seldom. total: of what is counted, None where nothing is; pieces: how many are done of
    how many that are known, where the count is not all.
    """

    def __init__(self, total: int | None, what: str, pieces: Callable[[], tuple[int, int]] | None) -> None:
        self._total, self._what, self._pieces = total, what, pieces
        self._done, self._words, self._share = 0, "", 0.0
        self._started = self._drawn = monotonic()
        self._is_terminal = sys.stderr.isatty() or bool(_TERMINAL_SETTINGS.intersection(os.environ))
        self._is_shown, self._over = False, threading.Event()

    def __call__(self) -> None:
        """Count one more."""
        self._done += 1
        self.show(self._words)

    def show(self, words: str) -> None:
        """Show what the work is at; of `part 3 of 12` two parts are done."""
        self._words, found = words, _COUNT.search(words)
        self._share = (int(found[1]) - 1) / int(found[2]) if found else self._share
        if self._is_terminal and monotonic() - self._drawn >= _REFRESH_SECONDS:
            self._draw()

    def describe(self) -> str:
        """Return `decomposing: 3 of 12, 8 of 40 pieces, 21 s, about 84 s left`."""
        seconds, share, texts = monotonic() - self._started, self._share, list[str]()
        if self._total:
            share, texts = self._done / self._total, [f"{self._done} of {self._total}"]
        done, known = self._pieces() if self._pieces else (0, 0)
        if known:
            share = max(share, done / known) if self._total == 1 else share
            texts.append(f"{done} of {pluralize(known, 'piece')}")
        left = [f"about {seconds / share - seconds:.0f} s left"] if 0 < share < 1 else []
        return f"{self._what}: {', '.join([*texts, *filter(None, [self._words]), f'{seconds:.0f} s', *left])}"

    def clear(self, line: str = "") -> None:
        """Take the line away where stderr is a terminal, and print another one."""
        was_shown, self._is_shown = self._is_shown, bool(line) and self._is_terminal
        if not line and not was_shown:
            return
        line = escape_name(line)
        own = f"{_CLEAR}{line[: shutil.get_terminal_size().columns - 1]}" if self._is_terminal else f"{line}\n"
        with suppress(OSError, ValueError):  # whoever read it may have gone
            print(own, end="", file=bare_stream(sys.stderr), flush=True)

    def _draw(self) -> None:
        self._drawn = monotonic()
        self.clear(self.describe())

    def _draw_often(self) -> None:
        """Draw when a line is due, till it is over."""
        wait = QUIET_SECONDS
        while not self._over.wait(max(0.0, self._drawn + wait - monotonic())):
            self._draw()
            wait = 1.0 if self._is_terminal else min(self._drawn - self._started, _SELDOM)

    @contextmanager
    def keep_drawing(self) -> Iterator[Progress]:
        """Let lines come within the block while nothing is counted, too: by a thread, which an alarm starts once the
        work takes long, since workers could not start by a fork beside it."""
        thread = threading.Thread(target=self._draw_often, daemon=True)
        alarm: int | None = getattr(signal, "SIGALRM", None)  # which Windows has not
        is_main = threading.current_thread() is threading.main_thread()
        if alarm is None or not is_main or signal.getsignal(alarm) is not signal.SIG_DFL:
            alarm = None
            thread.start()
        else:
            signal.signal(alarm, lambda *_: thread.start())
            signal.setitimer(signal.ITIMER_REAL, QUIET_SECONDS / 2)
        try:
            yield self
        finally:
            if alarm is not None:
                signal.setitimer(signal.ITIMER_REAL, 0)
                signal.signal(alarm, signal.SIG_DFL)
            self._over.set()
            if thread.is_alive():
                thread.join()
            self.clear()


class _StdoutAboveLine:
    """stdout at a terminal where a line of progress stands: it goes before anything is printed."""

    def __init__(self, progress: Progress) -> None:
        self._progress, self._stdout = progress, sys.stdout

    def write(self, text: str) -> int:
        self._progress.clear()
        return self._stdout.write(text)

    @property
    def rich_proxied_file(self) -> Any:
        self._progress.clear()
        return bare_stream(self._stdout)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stdout, name)


@contextmanager
def progress(total: int | None, what: str, pieces: Callable[[], tuple[int, int]] | None = None) -> Iterator[Progress]:
    """Say on stderr how far work is, for as long as it takes; see `Progress`, which counts."""
    shown = Progress(total, what, pieces)
    stdout: Any = _StdoutAboveLine(shown)
    with redirect_stdout(stdout) if sys.stdout.isatty() else nullcontext(), shown.keep_drawing():
        yield shown


NOTHING_WRITTEN = " (nothing was written)"


def describe_failure(asset: str, why: str) -> str:
    """Return that an asset failed, and why."""
    return f"failed     {escape_name(asset)}\n    " + why.replace("\n", "\n    ")


_QUOTED = re.compile("'([^']*)'")


class NoteLog:
    """The notes of a run, each printed once: under the first asset, with a number that stands behind the names of
    others, which are named at the end. numbered: False for a run over one asset or two."""

    def __init__(self, numbered: bool) -> None:
        self._numbered = numbered
        self._rows = dict[str, list[str]]()  # the number of each kind, and the assets

    def describe(self, asset: str, head: str, notes: Iterable[str], start: str = "    note: ") -> str:
        """Return what is printed on an asset: a line, with the numbers of notes printed already, and new ones."""
        new = list[str]()
        for note in fold_notes(notes):
            row = self._rows.setdefault(_kind_of(note, asset), [f"[{len(self._rows) + 1}]"])
            if self._numbered and row[1:2] not in ([], [asset]):
                head += f" {row[0]}"
            else:
                new.append(f"{start}{note}" + (f" {row[0]}" if self._numbered else ""))
            row += [asset] if row[-1] != asset else []
        return "\n".join([head, *new])

    def print_repeated(self) -> None:
        """Print which assets have the same notes, the first ones by name."""
        numbers = dict[tuple[str, ...], str]()
        for number, *assets in self._rows.values():
            numbers[tuple(assets)] = f"{numbers.get(tuple(assets), '')}{number} "
        for some, own in numbers.items():
            if len(some) > 1:
                typer.echo(f"    {own}on {len(some):,} assets: {join_names(some)}")


def fold_notes(notes: Iterable[str]) -> Iterator[str]:
    """Yield the notes on one asset; of those that differ in quoted names the first, with all the names."""
    kinds = dict[str, list[str]]()
    for note in dict.fromkeys(notes):
        kinds.setdefault(_QUOTED.sub("''", note), []).append(note)
    for first, *others in kinds.values():
        names = join_names([", ".join(_QUOTED.findall(note)) for note in others])
        yield f"{first} (also {names})" if others else first


def _kind_of(note: str, asset: str) -> str:
    """A note without names, also that of the asset, and counts, by which it is the same as another."""
    note = re.sub(rf"(?<![^\W_]){re.escape(Path(asset).stem)}(?![^\W_])", "", note)
    note = re.sub(r" \(also .*\)$", "", note)
    if counted := re.match(r"(?:  note: )?[\d,]+ (\w{3})\w*(?: elements?)?(.*)", note, re.DOTALL):
        names = "" if counted[1] == "oth" else r" \([^)]*\)"  # of other elements these are kinds, not names
        note = counted[1] + re.sub(r"\b(is|are)\b", "are", re.sub(names, "", counted[2], count=1), count=1)
    return _QUOTED.sub("''", note)
