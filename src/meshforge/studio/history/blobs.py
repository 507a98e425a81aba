"""Contents of files by their digest: each kept once, whole or not at all."""

from __future__ import annotations

import os
import shutil
from collections.abc import Container
from dataclasses import dataclass
from pathlib import Path

from meshforge.batch import file_digest
from meshforge.errors import ProjectError
from meshforge.files import replacing


@dataclass(frozen=True, slots=True)
class Blobs:
    """A folder of contents."""

    folder: Path

    def store(self, file: Path) -> str:
        """Keep what a file holds, and give its digest."""
        digest = file_digest(file)
        place = self.path_of(digest)
        if not place.exists():
            _copy(file, place)
        return digest

    def restore(self, digest: str, file: Path) -> None:
        """Let a file hold again what it held. Raises ProjectError where that is lost or damaged."""
        place = self.path_of(digest)
        if not place.is_file() or file_digest(place) != digest:
            raise ProjectError(
                "what this file held before is no longer kept",
                where=str(file),
                remedy="The history of the studio was damaged from outside; the file is left as it is.",
            )
        _copy(place, file)

    def prune(self, wanted: Container[str]) -> None:
        """Remove the contents that nothing mentions any more."""
        for place in self.folder.glob("*/*"):
            if place.parent.name + place.name not in wanted:
                place.unlink()

    def path_of(self, digest: str) -> Path:
        """Where a content is kept."""
        return self.folder / digest[:2] / digest[2:]


def _copy(source: Path, target: Path) -> None:
    """Copy a file atomically; one that is replaced hands on its mode, a new one takes that of its source."""
    like = target if target.exists() else source
    with replacing(target) as draft:
        with source.open("rb") as read, draft.open("wb") as write:
            shutil.copyfileobj(read, write)
            write.flush()
            os.fsync(write.fileno())
        draft.chmod(like.stat().st_mode & 0o777)
