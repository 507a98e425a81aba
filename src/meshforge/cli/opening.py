"""Opening the asset that a command is about: a file, or an asset as a project sees it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from meshforge.symbolic import SymbolicMesh


def opened(asset: Path, labels: Path | None, project: Path | None) -> SymbolicMesh:
    """The mesh of a file with its labels; with a project, that of an asset given by its file or by its id there.

    Raises UsageError for labels beside a project, which has its own.
    """
    from meshforge.errors import UsageError
    from meshforge.files import plain_path
    from meshforge.formats import load

    if project is None:
        return load(asset, labels=labels)
    from meshforge.project import Project

    if labels:
        raise UsageError("a project has its own labels", remedy="Leave --labels out, or --project.")
    home = Project.open(project)
    by_path = {plain_path(path): key for key, path in home.found.ids.items()}
    return home.mesh(by_path.get(plain_path(asset), asset.as_posix()))
