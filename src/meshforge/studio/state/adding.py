"""Taking uploaded files into the project: templates, and assets with all their parts."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.errors import ProjectError
from meshforge.studio.assets import new_assets
from meshforge.studio.edits.own import AddAssets, AddTemplate
from meshforge.studio.wire.requests import Uploaded
from meshforge.words import listed

if TYPE_CHECKING:
    from meshforge.studio.state.desk import Desk

ADDED = "added"
"""The folder, below that of the project's assets, that new ones come to."""


def take_template(desk: Desk, name: str, file: Path, page: str | None) -> Uploaded:
    """Keep an uploaded file as a template. Raises ProjectError: no name for one, or no convex hulls in it."""
    try:
        desk.edit(AddTemplate(name=name, file=str(file)), page)
    finally:
        file.unlink(missing_ok=True)
    return Uploaded(names=(name,))


def take_assets(desk: Desk, page: str | None) -> Uploaded:
    """Put the files that were sent in place, as assets of the project. Raises ProjectError, and throws them away,
    where one cannot be read, or would take the place of another file."""
    try:
        staged, files = desk.uploads.list_files()
        added = new_assets(desk.readers, staged)
        home = desk.project.found.base / ADDED
        _check_free(home, files)
        desk.edit(AddAssets(staged=str(staged), files=files, added=added, home=str(home)), page)
    finally:
        desk.uploads.clear()
    return Uploaded(names=tuple(f"{ADDED}/{name}" for name in added))


def _check_free(home: Path, files: tuple[str, ...]) -> None:
    if not home.resolve().is_relative_to(home.parent.resolve()):
        raise ProjectError("this folder is a link to somewhere else", where=str(home), remedy="Remove the link.")
    taken = [name for name in files if (home / name).exists()]
    if taken:
        raise ProjectError(f"there is a file of that name already: {listed(taken)}", remedy="Give it another name.")
