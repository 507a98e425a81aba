"""Paths that a person types or picks on the start page, and the folders of this machine."""

from __future__ import annotations

import os
from pathlib import Path

from meshforge.batch import SETTINGS
from meshforge.common import UsageError, is_file, plain_path
from meshforge.formats import all_suffixes
from meshforge.studio.wire.start import FolderEntry, FolderView

MOST_ENTRIES = 500
"""Folders that are listed of one."""
_ABSOLUTE = "Type the whole path, as /home/me/assets or ~/assets."


def parse_path(text: str, what: str = "the folder") -> Path:
    """The absolute path that a person typed; `~` is the home folder. Raises UsageError: empty, relative, or no path."""
    text = text.strip()
    if not text:
        raise UsageError(f"{what} has no name", remedy=_ABSOLUTE)
    if not text.isprintable():
        raise UsageError(f"{what} has a character in its name that no name can have", remedy=_ABSOLUTE)
    try:
        path = Path(text).expanduser()
    except RuntimeError:
        raise UsageError("there is no such user", where=text, remedy=_ABSOLUTE) from None
    if not path.is_absolute():
        raise UsageError(f"{what} is not a whole path", where=text, remedy=_ABSOLUTE)
    return plain_path(path)


def check_folder(path: Path) -> None:
    """Raises UsageError where there is no folder that can be read."""
    try:
        if not path.exists():
            raise UsageError("there is no such folder", where=str(path), remedy="Check the spelling, or browse for it.")
        if not path.is_dir():
            raise UsageError("this is a file", where=str(path), remedy=f"Name its folder: {path.parent}")
        with os.scandir(path):
            pass
    except OSError as error:
        remedy = "Choose a folder that you may read."
        raise UsageError(f"this folder cannot be read: {error.strerror}", where=str(path), remedy=remedy) from None


def list_folder(path: Path) -> FolderView:
    """The folders in a folder, by name; hidden ones are left out. Raises UsageError where it cannot be read."""
    check_folder(path)
    folders, files, suffixes = list[str](), 0, set(all_suffixes())
    try:
        with os.scandir(path) as entries:
            for entry in entries:
                if entry.name.startswith("."):
                    continue
                if _is_folder(entry):
                    folders.append(entry.name)
                elif Path(entry.name).suffix.lower() in suffixes:
                    files += 1
    except OSError as error:
        raise UsageError(f"this folder cannot be read: {error.strerror}", where=str(path)) from None
    folders.sort(key=str.casefold)
    shown = folders[:MOST_ENTRIES]
    return FolderView(
        folder=str(path),
        parent=None if path.parent == path else str(path.parent),
        project=is_project(path),
        entries=tuple(FolderEntry(name=name, project=is_project(path / name)) for name in shown),
        more=len(folders) - len(shown),
        files=files,
    )


def is_project(folder: Path) -> bool:
    """Whether a folder is a project."""
    return is_file(folder / SETTINGS)


def _is_folder(entry: os.DirEntry[str]) -> bool:
    try:
        return entry.is_dir()
    except OSError:
        return False


def default_places() -> tuple[Path, ...]:
    """Where a person begins to look for assets: the folder that the studio was started in, and the home folder."""
    return tuple(dict.fromkeys((Path.cwd(), Path.home())))


def suggest_project(name: str) -> Path:
    """A folder that is not there yet, for a new project of that name: where the studio was started, or else in the home
    folder where that cannot be written."""
    here, home = Path.cwd(), Path.home()
    parent = here if here != Path(here.anchor) and os.access(here, os.W_OK) else home / "meshforge"
    name = name.strip().strip(".") or "project"
    names = [name, f"{name}-project", *(f"{name}-project-{number}" for number in range(2, 1000))]
    return next((parent / one for one in names if not (parent / one).exists()), parent / name)
