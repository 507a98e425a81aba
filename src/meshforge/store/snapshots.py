"""Contents of files as they were, by digest: taken before a change, and written back to undo it."""

from __future__ import annotations

import os
import shutil
from collections.abc import Container, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from meshforge.common import ProjectError, do_at_once, file_digest, relative_name, replace_atomically, write_atomically

FileState = dict[str, str | None]
"""The digest of each file by its path from the project's folder, None for a file that is not there."""


@dataclass(frozen=True, slots=True)
class Snapshots:
    """Takes and restores the state of files; paths count from `folder`, and stay what they are outside of it."""

    folder: Path
    blobs: BlobStore

    def take(self, paths: Iterable[Path]) -> FileState:
        """The state of files, and of all files in folders; their contents are stored."""
        files = sorted(_list_files(paths))
        digests = do_at_once(self.blobs.store, files)
        return {relative_name(file, self.folder): digest for file, digest in zip(files, digests, strict=True)}

    def read_state(self, names: Iterable[str]) -> FileState:
        """The state of files by their names; nothing is stored."""
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
    """Two states, reduced to the files that differ."""
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
        """The content that a file had. Raises ProjectError where it is lost or damaged."""
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
        """The path of a content."""
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
