"""What checks found of assets, written line by line as it comes, so that a run that was stopped goes on where it
was."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

from meshforge.batch.jobs import AssetJob
from meshforge.batch.lock import hold_lock
from meshforge.batch.provenance import file_digest, source_files, text_digest
from meshforge.common import MeshForgeError

_START = b'{"asset": '


@dataclass(frozen=True, slots=True)
class CheckInputs:
    """What decides what is found of an asset, and what was written for it.

    files: the digest of each file by its path; asked: the digest of what was to be found out, and by which software.
    """

    files: dict[str, str]
    request: str

    @staticmethod
    def of(files: Iterable[Path], asked: str) -> CheckInputs:
        """What there is by now."""
        return CheckInputs({str(path): file_digest(path) for path in files}, text_digest(asked))

    def is_current(self, job: AssetJob, asked: str) -> bool:
        """Whether all is as it was, without reading the asset."""
        own = [*source_files(job.path), *([job.labels] if job.labels else [])]
        if self.request != text_digest(asked) or not all(str(path) in self.files for path in own):
            return False
        return all(Path(path).is_file() and file_digest(Path(path)) == known for path, known in self.files.items())


class CheckJournal:
    """A file of JSON lines, one for each asset that was looked at; the last one of an asset counts."""

    def __init__(self, path: Path, stream: BinaryIO) -> None:
        """Read what there is; a line that a killed run could not end is cut off. Raises MeshForgeError: no journal."""
        self._stream = stream
        self._places: dict[str, int] = {}
        self.inputs: dict[str, CheckInputs] = {}
        end = 0
        for number, line in enumerate(self._stream, 1):
            if not line.endswith(b"\n") and line[: len(_START)] == _START[: len(line)]:
                break  # a run was killed while it wrote this
            try:
                row = json.loads(line)
                self.inputs[row["asset"]] = CheckInputs(row["files"], row["asked"])
            except (ValueError, TypeError, KeyError, RecursionError) as error:
                remedy = "Give the file of an earlier run, or a new one."
                at = f"{path}:{number}"
                raise MeshForgeError("this is no journal of a check", where=at, remedy=remedy) from error
            self._places[row["asset"]], end = end, end + len(line)
        self._stream.truncate(end)

    def read_row(self, asset: str) -> dict[str, Any]:
        """What is kept of an asset."""
        self._stream.seek(self._places[asset])
        found: dict[str, Any] = json.loads(self._stream.readline())
        return found

    def add(self, asset: str, seen: CheckInputs, row: dict[str, Any]) -> None:
        """Keep what was found."""
        line = json.dumps({"asset": asset, "files": seen.files, "asked": seen.request, **row}) + "\n"
        self._places[asset] = self._stream.seek(0, os.SEEK_END)
        self._stream.write(line.encode())
        self._stream.flush()


@contextmanager
def open_journal(path: Path) -> Iterator[CheckJournal]:
    """The journal in a file, made if absent, for the time of a `with` block; one run at a time."""
    with hold_lock(path, str(path), wait=0), path.open("r+b") as stream:
        yield CheckJournal(path, stream)
