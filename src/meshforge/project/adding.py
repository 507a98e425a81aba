"""More assets for a project."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.errors import ProjectError
from meshforge.files import plain_path
from meshforge.formats import SUFFIXES, is_asset
from meshforge.project.opening import found_assets
from meshforge.project.settings import change_setting, seen_from

if TYPE_CHECKING:
    from meshforge.project.project import Project


def add(project: Project, paths: Iterable[str | Path]) -> None:
    """Name files among the assets of the settings, as far as these do not mean them already.

    Assets that a pattern would pass over because of the new files, such as mesh files in a folder that gets a URDF,
    are named as well. Raises ProjectError for a file that is no asset, or lies outside of the folder of the ids.
    """
    wanted = [_checked(project, plain_path(Path(path))) for path in paths]
    with project.lock():
        present = set(found_assets(project.folder).paths)
        had = (path for path in project.found if path.exists())
        more = [path for path in dict.fromkeys([*had, *wanted]) if path not in present]
        if more:
            names = (seen_from(project.folder, str(path)) for path in more)
            change_setting(project.folder, "assets", (*project.settings.assets, *names))


def _checked(project: Project, path: Path) -> Path:
    base = project.found.base
    if not path.is_relative_to(base):
        remedy = "Put it there, or make another project for it."
        raise ProjectError(f"it lies outside of {base}, the folder that ids count from", where=str(path), remedy=remedy)
    if not is_asset(path):
        remedy = f"Known suffixes: {', '.join(SUFFIXES)}."
        raise ProjectError("this is no asset that can be read", where=str(path), remedy=remedy)
    return path
