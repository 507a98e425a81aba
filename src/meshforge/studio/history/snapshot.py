"""What files hold, as digests; and putting them back as they were."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from meshforge.batch import file_digest
from meshforge.files import relative_name
from meshforge.studio.history.blobs import Blobs
from meshforge.studio.history.entry import State


@dataclass(frozen=True, slots=True)
class Snapshots:
    """Takes and restores the state of files; paths count from `folder`, and stay what they are outside of it."""

    folder: Path
    blobs: Blobs

    def take(self, touches: Iterable[Path]) -> State:
        """The state of files, and of all files in folders; their contents are kept."""
        return {relative_name(file, self.folder): self.blobs.store(file) for file in sorted(_files(touches))}

    def read_state(self, names: Iterable[str]) -> State:
        """The state of files by their names, nothing kept."""
        return {name: _digest(self.folder / name) for name in names}

    def restore(self, wanted: Mapping[str, str | None], now: Mapping[str, str | None]) -> None:
        """Let files hold what they held; those that were not there go, and folders that are empty then."""
        for name, digest in wanted.items():
            if now[name] == digest:
                continue
            if digest is None:
                _remove(self.folder / name, self.folder)
            else:
                self.blobs.restore(digest, self.folder / name)


def changes(before: State, after: State) -> tuple[State, State]:
    """Two states, of the files only that differ."""
    names = [name for name in sorted({*before, *after}) if before.get(name) != after.get(name)]
    return {name: before.get(name) for name in names}, {name: after.get(name) for name in names}


def _files(touches: Iterable[Path]) -> Iterator[Path]:
    """The files that there are, without those of writers that were killed."""
    seen = {file for path in touches for file in ([path] if path.is_file() else path.rglob("*"))}
    return (file for file in seen if file.is_file() and not file.name.endswith(".tmp"))


def _digest(path: Path) -> str | None:
    try:
        return file_digest(path)
    except (FileNotFoundError, NotADirectoryError):
        return None


def _remove(path: Path, root: Path) -> None:
    path.unlink(missing_ok=True)
    for folder in path.parents:
        if folder == root or not folder.is_dir() or any(folder.iterdir()):
            return
        folder.rmdir()
