"""Noticing what others change: a command in a terminal, an editor, a version control system."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from stat import S_ISDIR
from threading import Event, Thread

from meshforge.batch import SETTINGS, STATE, source_files
from meshforge.files import relative_name
from meshforge.project import Project

EVERY = 1.5
"""Seconds between two looks."""
_FOLDERS = ("labels", "demonstrations", "corrections", "prepared", "templates", f"edited/{STATE}/stamps")
_FILES = (SETTINGS, "answers.json", "program.mf", "review.json", f"{STATE}/learned.json")

Look = dict[str, tuple[int, int]]
"""Modification time [ns] and size of each file, by its path from the project's folder."""


def look(project: Project) -> Look:
    """How the files are that a project lives in, and those of its assets; folders of assets, where new ones come."""
    folder = project.folder
    assets = [file for path in project.found.paths for file in _source(path)]
    homes = {path.parent for path in project.found.paths}
    kept = (file for name in _FOLDERS for file in (folder / name).rglob("*") if not file.name.startswith("."))
    files = dict(_looks([*(folder / name for name in _FILES), *kept, *assets], folder))
    return files | dict(_looks(homes, folder, folders=True))


def differing(before: Look, now: Look) -> frozenset[str]:
    """The names of files that are other, new or gone."""
    return frozenset(name for name in before | now if before.get(name) != now.get(name))


def _source(path: Path) -> list[Path]:
    try:
        return source_files(path)
    except OSError:
        return []


def looked(folder: Path, names: Iterable[str]) -> Look:
    """The same for files by their names."""
    return dict(_looks((folder / name for name in names), folder))


def _looks(paths: Iterable[Path], root: Path, folders: bool = False) -> Iterator[tuple[str, tuple[int, int]]]:
    for path in paths:
        try:
            stat = path.stat()
        except OSError:
            continue
        if S_ISDIR(stat.st_mode) == folders:
            yield relative_name(path, root), (stat.st_mtime_ns, stat.st_size)


class Watch:
    """A thread that looks every now and then."""

    def __init__(self, look_again: Callable[[], None]) -> None:
        self._look_again = look_again
        self._closed = Event()
        self._thread = Thread(target=self._run, name="watch", daemon=True)

    def start(self) -> None:
        """Begin."""
        self._thread.start()

    def close(self) -> None:
        """Stop, and wait for the end of a look."""
        self._closed.set()
        if self._thread.is_alive():
            self._thread.join()

    def _run(self) -> None:
        while not self._closed.wait(EVERY):
            self._look_again()
