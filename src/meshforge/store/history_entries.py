"""What a history keeps on disk: its entries, the one under way, and contents of files as they were, by digest, taken
before a change and written back to undo it."""

import os
import shutil
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from meshforge.common import (
    ProjectError,
    do_at_once,
    file_digest,
    file_state,
    relative_name,
    replace_atomically,
    write_atomically,
)

FileState = dict[str, str | None]
"""The digest of each file by its path from the project's folder, None for a file that is not there."""


@dataclass(frozen=True, slots=True)
class Snapshots:
    """Takes and restores the state of files; paths count from `folder`, and stay what they are outside of it."""

    folder: Path
    blobs: "BlobStore"

    def take(self, paths: Iterable[Path]) -> FileState:
        """Return the state of files, and of all files in folders; their contents are stored."""
        files = sorted(_list_files(paths))
        digests = do_at_once(self.blobs.store, files)
        return {relative_name(file, self.folder): digest for file, digest in zip(files, digests, strict=True)}

    def read_state(self, names: Iterable[str]) -> FileState:
        """Return the state of files by their names; nothing is stored."""
        return {name: _digest_or_none(self.folder / name) for name in names}

    def restore(self, wanted: Mapping[str, str | None], now: Mapping[str, str | None]) -> None:
        """Write back what was in files; those that were not there are removed, and folders that are empty then."""
        other = {name: digest for name, digest in wanted.items() if now[name] != digest}
        written = [(digest, self.folder / name) for name, digest in other.items() if digest is not None]
        do_at_once(lambda row: self.blobs.restore(*row), written)
        for name, digest in other.items():
            if digest is None:
                self.write(self.folder / name, None)

    def write(self, path: Path, content: bytes | None) -> None:
        """Write a file; None removes it, and folders that are empty then."""
        if content is not None:
            write_atomically(path, content)
            return
        path.unlink(missing_ok=True)
        for folder in path.parents:
            if folder == self.folder or not folder.is_dir() or any(folder.iterdir()):
                return
            folder.rmdir()


def diff_states(before: FileState, after: FileState) -> tuple[FileState, FileState]:
    """Return two states, reduced to the files that differ."""
    names = [name for name in sorted({*before, *after}) if before.get(name) != after.get(name)]
    return {name: before.get(name) for name in names}, {name: after.get(name) for name in names}


def _list_files(paths: Iterable[Path]) -> Iterator[Path]:
    """The files among these paths and in these folders, without drafts of writers that were killed."""
    seen = {file for path in paths for file in ([path] if path.is_file() else path.rglob("*"))}
    return (file for file in seen if file.is_file() and not file.name.endswith(".tmp"))


def _digest_or_none(path: Path) -> str | None:
    try:
        return file_digest(path)
    except (FileNotFoundError, NotADirectoryError):
        return None


@dataclass(frozen=True, slots=True)
class BlobStore:
    """A folder with the contents of files, by digest."""

    folder: Path

    def store(self, file: Path) -> str:
        """Store what is in a file, and return its digest."""
        digest = file_digest(file)
        place = self.path_of(digest)
        if not place.exists():
            _copy(file, place)
        return digest

    def read(self, digest: str, file: Path) -> bytes:
        """Return the content that a file had. Raises ProjectError where it is lost or damaged."""
        return self._find(digest, file).read_bytes()

    def restore(self, digest: str, file: Path) -> None:
        """Write a content back to a file. Raises ProjectError where it is lost or damaged."""
        _copy(self._find(digest, file), file)

    def _find(self, digest: str, file: Path) -> Path:
        place = self.path_of(digest)
        if not place.is_file() or file_digest(place) != digest:
            raise ProjectError(
                "what this file held before is no longer kept",
                where=str(file),
                remedy="The history of the studio was damaged from outside; the file is left as it is.",
            )
        return place

    def prune(self, wanted: Container[str]) -> None:
        """Remove the contents that no entry mentions any more."""
        for place in self.folder.glob("*/*"):
            if place.parent.name + place.name not in wanted:
                place.unlink()

    def path_of(self, digest: str) -> Path:
        """Return the path of a content."""
        return self.folder / digest[:2] / digest[2:]


def _copy(source: Path, target: Path) -> None:
    """Copy a file atomically; a file that is replaced keeps its mode, a new one takes that of its source."""
    like = target if target.exists() else source
    with replace_atomically(target) as draft:
        with source.open("rb") as read, draft.open("wb") as write:
            shutil.copyfileobj(read, write)
            write.flush()
            os.fsync(write.fileno())
        draft.chmod(like.stat().st_mode & 0o777)


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
        """Return what is under way, None for nothing."""
        try:
            return PendingEntry.model_validate_json(self._pending.read_bytes())
        except (FileNotFoundError, ValueError):
            return None

    def begin(self, pending: PendingEntry) -> None:
        """Note what is under way; against a kill, not a power cut, so nothing waits for the disk."""
        with replace_atomically(self._pending) as draft:
            draft.write_text(pending.model_dump_json(), encoding="utf-8")

    def end(self) -> None:
        """Record that nothing is under way any more."""
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
    """Return how many entries belong to one group, from a place on in a direction (step: 1 or -1)."""
    group, count = entries[first].group, 1
    while group and 0 <= first + count * step < len(entries) and entries[first + count * step].group == group:
        count += 1
    return count
