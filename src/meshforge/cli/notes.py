"""Notes on assets for people: those that differ in names and counts alone are printed once, with the names."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from pathlib import Path

import typer

from meshforge.common import join_names

_QUOTED = re.compile("'([^']*)'")


class NoteLog:
    """The notes of a run, each printed once: under the first asset, with a number that stands behind the names of
    others, which are named at the end. numbered: False for a run over one asset or two."""

    def __init__(self, numbered: bool) -> None:
        self._numbered = numbered
        self._rows = dict[str, list[str]]()  # the number of each kind, and the assets

    def describe(self, asset: str, head: str, notes: Iterable[str], start: str = "    note: ") -> str:
        """What is printed on an asset: a line, with the numbers of notes that were printed already, and new ones."""
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
    """The notes on one asset; of those that differ in quoted names alone the first, with the names of the others."""
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
