"""One thing that was done: what each file held before and after; and the note of one that is under way."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict

from meshforge.files import replacing, write_atomically

State = dict[str, str | None]
"""The digest of each file by its path from the project's folder, None for a file that is not there."""


class Entry(BaseModel):
    """One thing that was done. title: in words; edit: as the page sent it; by: the page; at: when, as ISO 8601.

    group: entries of one group that follow one another are undone together.
    """

    model_config = ConfigDict(frozen=True)

    title: str
    edit: dict[str, Any]
    before: State
    after: State
    at: str = ""
    by: str | None = None
    group: str | None = None

    @property
    def names(self) -> tuple[str, ...]:
        """The files that it changed."""
        return tuple(self.before)

    @property
    def digests(self) -> frozenset[str]:
        """All contents that it mentions."""
        return frozenset(digest for digest in (*self.before.values(), *self.after.values()) if digest)


class Pending(BaseModel):
    """What is under way, so that it can be brought to its end after a kill. number: of the entry, from 1; entry: as it
    is, or for `do` as far as it is known; touches: the paths that are looked at."""

    model_config = ConfigDict(frozen=True)

    what: Literal["do", "undo", "redo"]
    number: int
    entry: Entry
    touches: tuple[str, ...] = ()


class EntryFiles:
    """The entries of a history as files, in a folder; all in memory, too."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._pending = folder / "pending.json"
        self._position = folder / "position"
        self.entries = _read_all(folder / "entries")

    @property
    def position(self) -> int:
        """How many entries are done; the others are to be redone."""
        try:
            return min(int(self._position.read_text()), len(self.entries))
        except (FileNotFoundError, ValueError):
            return len(self.entries)

    def set_position(self, position: int) -> None:
        """Set how many entries are done; without the file, all are."""
        if position < len(self.entries):
            write_atomically(self._position, str(position))
        else:
            self._position.unlink(missing_ok=True)

    def put(self, number: int, entry: Entry) -> None:
        """Set an entry in the place of all from that number on, which go first, the last one foremost."""
        for gone in range(len(self.entries), number, -1):
            self._path_of(gone).unlink()
        write_atomically(self._path_of(number), entry.model_dump_json())
        self.entries[number - 1 :] = [entry]

    def read_pending(self) -> Pending | None:
        """What was under way when it was last looked at."""
        try:
            return Pending.model_validate_json(self._pending.read_bytes())
        except (FileNotFoundError, ValueError):
            return None

    def begin(self, pending: Pending) -> None:
        """Note what is under way; against a kill, not a power cut, so nothing waits for the disk."""
        with replacing(self._pending) as draft:
            draft.write_text(pending.model_dump_json(), encoding="utf-8")

    def end(self) -> None:
        """Nothing is under way any more."""
        self._pending.unlink(missing_ok=True)

    def _path_of(self, number: int) -> Path:
        return _path(self._folder / "entries", number)


def _path(folder: Path, number: int) -> Path:
    return folder / f"{number:06}.json"


def _read_all(folder: Path) -> list[Entry]:
    """The entries up to the first one that is not there or cannot be read."""
    found: list[Entry] = []
    while True:
        try:
            found.append(Entry.model_validate_json(_path(folder, len(found) + 1).read_bytes()))
        except (FileNotFoundError, ValueError):
            return found


def together(entries: Sequence[Entry], first: int, step: int) -> int:
    """How many entries from a place on, in a direction, belong together."""
    group, count = entries[first].group, 1
    while group and 0 <= first + count * step < len(entries) and entries[first + count * step].group == group:
        count += 1
    return count
