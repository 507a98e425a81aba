"""The entries of a history on disk, and the one under way."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from meshforge.common import file_state, replace_atomically, write_atomically
from meshforge.store.snapshots import FileState


class HistoryEntry(BaseModel):
    """One change that was made. title: in words; edit: what it was, as JSON; by: the page; at: when, as ISO 8601.

    group: entries of one group that follow one another are undone together.
    """

    model_config = ConfigDict(frozen=True)

    title: str
    edit: dict[str, Any]
    before: FileState
    after: FileState
    at: str = ""
    by: str | None = None
    group: str | None = None

    @property
    def names(self) -> tuple[str, ...]:
        """The files that it changed."""
        return tuple(self.before)

    @property
    def digests(self) -> frozenset[str]:
        """The digests of all contents that it mentions."""
        return frozenset(digest for digest in (*self.before.values(), *self.after.values()) if digest)


class PendingEntry(BaseModel):
    """What is under way, so that it can be completed or taken back after a kill. number: of the entry, from 1; entry:
    for `do` and `write` as far as it is known; touches: the paths that the change may write.

    written: for `write` the digests of all that each file may contain meanwhile.
    """

    model_config = ConfigDict(frozen=True)

    what: Literal["do", "write", "undo", "redo"]
    number: int
    entry: HistoryEntry
    touches: tuple[str, ...] = ()
    written: dict[str, tuple[str | None, ...]] = Field(default_factory=dict)


class EntryFiles:
    """The entries of a history as files in a folder; all of them are in memory, too, once they are asked for."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._pending = folder / "pending.json"
        self._position = folder / "position"
        self._entries: list[HistoryEntry] | None = None
        self._state: tuple[object, ...] = ()

    @property
    def entries(self) -> list[HistoryEntry]:
        if self._entries is None:
            self._entries = self._read_all()
            self._state = self._read_state()
        return self._entries

    def refresh(self) -> bool:
        """Read the entries again where another process changed them; whether one did."""
        if self._entries is None or self._read_state() == self._state:
            return False
        self._entries = None
        return True

    def _read_state(self) -> tuple[object, ...]:
        """What differs as soon as others add, replace or remove entries."""
        return tuple(map(file_state, (self._path_of(len(self.entries)), self._path_of(len(self.entries) + 1))))

    @property
    def position(self) -> int:
        """How many entries are done; the others can be redone."""
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

    def put(self, number: int, entry: HistoryEntry) -> None:
        """Put an entry in the place of all from that number on. These are removed first, from the last one back."""
        entries = self.entries
        for gone in range(len(entries), number, -1):
            self._path_of(gone).unlink()
        write_atomically(self._path_of(number), entry.model_dump_json())
        entries[number - 1 :] = [entry]
        self._state = self._read_state()

    def read_pending(self) -> PendingEntry | None:
        """What is under way, None for nothing."""
        try:
            return PendingEntry.model_validate_json(self._pending.read_bytes())
        except (FileNotFoundError, ValueError):
            return None

    def begin(self, pending: PendingEntry) -> None:
        """Note what is under way; against a kill, not a power cut, so nothing waits for the disk."""
        with replace_atomically(self._pending) as draft:
            draft.write_text(pending.model_dump_json(), encoding="utf-8")

    def end(self) -> None:
        """Nothing is under way any more."""
        self._pending.unlink(missing_ok=True)

    def _path_of(self, number: int) -> Path:
        return self._folder / "entries" / f"{number:06}.json"

    def _read_all(self) -> list[HistoryEntry]:
        found: list[HistoryEntry] = []
        while True:
            try:
                found.append(HistoryEntry.model_validate_json(self._path_of(len(found) + 1).read_bytes()))
            except (FileNotFoundError, ValueError):
                return found


def count_group(entries: Sequence[HistoryEntry], first: int, step: int) -> int:
    """How many entries belong to one group, from a place on in a direction (step: 1 or -1)."""
    group, count = entries[first].group, 1
    while group and 0 <= first + count * step < len(entries) and entries[first + count * step].group == group:
        count += 1
    return count
