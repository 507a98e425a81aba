"""Files that a page uploads: safe names, limited sizes, streamed to disk, and taken only if they can be read."""

import shutil
from collections.abc import AsyncIterator
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from threading import Lock

from meshforge.batch import find_assets_in
from meshforge.common import (
    MeshForgeError,
    MissingFilesError,
    ProjectError,
    UsageError,
    confine_reads,
    join_names,
    pluralize,
    replace_atomically,
)
from meshforge.formats import read
from meshforge.studio.workers import Workers

MB = 2**20
MOST_ONE_FILE, MOST_ALL_FILES, MOST_FILES = 500 * MB, 2000 * MB, 5000
_LONGEST_PATH = 240
REMEDY = "Send each asset together with all files that it names."
"""For assets that cannot be read."""


class TooLargeError(UsageError):
    """An upload is larger than the limit."""


class Uploads:
    """Files that were uploaded and are not in the project yet."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._lock = Lock()
        shutil.rmtree(folder, ignore_errors=True)

    async def put(self, path: str, chunks: AsyncIterator[bytes]) -> None:
        """Store one file. Raises UsageError for its path, TooLargeError for its size."""
        target = self.folder / "assets" / confine_path(path)
        with self._lock:
            present = [file for file in self.folder.rglob("*") if file.is_file() and file != target]
            room = MOST_ALL_FILES - sum(file.stat().st_size for file in present)
        if len(present) >= MOST_FILES:
            raise TooLargeError(f"these are more than {MOST_FILES} files", remedy="Add them in several portions.")
        try:
            await save_stream(target, chunks, min(MOST_ONE_FILE, room), path)
        except TooLargeError as error:
            if room >= MOST_ONE_FILE:
                raise
            most, remedy = f"{MOST_ALL_FILES // MB} MB", "Add them in several portions."
            raise TooLargeError(f"these files are larger than {most} together", where=path, remedy=remedy) from error

    def list_files(self) -> tuple[Path, tuple[str, ...]]:
        """Return the folder of the uploaded files, and their paths in it."""
        home = self.folder / "assets"
        return home, tuple(sorted(file.relative_to(home).as_posix() for file in home.rglob("*") if file.is_file()))

    def keep_readable(self, workers: Workers) -> "_Readable":
        """Return the assets that can be read; files of others are removed. Raises ProjectError where there is none."""
        home, _ = self.list_files()
        sent = find_assets(workers, home)
        for name in sent.unreadable:
            path = home / name
            if path.is_dir():
                shutil.rmtree(path)
            else:
                path.unlink(missing_ok=True)
        return sent

    def clear(self) -> None:
        """Remove what was uploaded."""
        shutil.rmtree(self.folder, ignore_errors=True)


async def save_stream(target: Path, chunks: AsyncIterator[bytes], most: int, name: str) -> None:
    """Write a file as it comes in; name: what messages call it. Raises TooLargeError; then there is no file."""
    size = 0
    try:
        with replace_atomically(target) as draft, draft.open("wb") as stream:
            async for chunk in chunks:
                size += len(chunk)
                if size > most:
                    problem = f"this file is larger than {most // MB} MB"
                    raise TooLargeError(problem, where=name, remedy="Send a smaller one.")
                stream.write(chunk)
    except (FileExistsError, NotADirectoryError, IsADirectoryError):
        raise UsageError("a file and a folder have the same name", where=name) from None


def confine_path(path: str) -> PurePosixPath:
    """Return a relative path without tricks. Raises UsageError for any other."""
    pure = PurePosixPath(path)
    parts = path.split("/")
    unknown = any(part in ("", ".", "..") or part.startswith(".") or not part.isprintable() for part in parts)
    if unknown or pure.is_absolute() or set(path) & set('\\:*?"<>|') or len(path.encode()) > _LONGEST_PATH:
        raise UsageError(f"{path!r} is no path for a file of an asset", remedy="Give plain names, with / between them.")
    return pure


@dataclass(frozen=True, slots=True)
class _Readable:
    """Assets among uploaded files. names: the paths of those that can be read; unreadable: of the others, with why."""

    names: tuple[str, ...]
    unreadable: dict[str, str] = field(default_factory=dict)

    @property
    def problems(self) -> tuple[str, ...]:
        """Why assets cannot be read, a sentence each."""
        return tuple(self.unreadable.values())


def find_assets(workers: Workers, home: Path) -> _Readable:
    """Return the assets among uploaded files. Raises ProjectError: there are none, or none can be read."""
    with confine_reads(home):
        found = find_assets_in(home) if home.is_dir() else []
    if not found:
        raise ProjectError("there is no asset among these files", remedy="Send URDF, MJCF, SDF, glTF or mesh files.")
    looks = {path.relative_to(home).as_posix(): _find_problem(workers, path, home) for path in found}
    sent = _Readable(
        tuple(name for name, problem in looks.items() if problem is None),
        {name: problem for name, problem in looks.items() if problem is not None},
    )
    if not sent.names:
        first, *others = sent.problems
        more = f"; {len(others)} more cannot be read" if others else ""
        raise ProjectError(f"{first}{more}", remedy=f"{REMEDY} Nothing was added.")
    return sent


def _find_problem(workers: Workers, path: Path, home: Path) -> str | None:
    try:
        files, lost = workers.run(_files_of, path, home)
    except MissingFilesError as error:
        files, lost = (), error.missing
    except MeshForgeError as error:
        return error.message.replace(f"{home}/", "").split("\n")[0]
    lost += tuple(file.name for file in files if not file.resolve().is_relative_to(home.resolve()))
    if not lost:
        return None
    what = f"{pluralize(len(lost), 'file')} that {'was' if len(lost) == 1 else 'were'} not dropped"
    return f"{path.relative_to(home).as_posix()} refers to {what}: {join_names(lost, most=3)}: drop the folder"


def _files_of(path: Path, home: Path) -> tuple[tuple[Path, ...], tuple[str, ...]]:
    """The files that an asset refers to, and the references that lead nowhere."""
    with confine_reads(home):  # else a page could ask which files are on the disk
        asset = read(path)
        return asset.files, tuple(dict.fromkeys((*asset.needed, *asset.missing)))
