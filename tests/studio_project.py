"""The bundled family of tables as a project, for tests of what the studio shows of it."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from pathlib import Path

from meshforge.project import Project
from meshforge.samples import TABLES

ORIENT = "+Z: Is(leg) -> Is(panel)"
ALL, FEW = tuple(range(1, 15)), (1, 2, 3, 8)
"""Numbers of the tables: 3 and 8 are those that show the rules."""


def demo_project(
    folder: Path, *, demonstrated: bool = True, orient: str = ORIENT, tables: Sequence[int] = ALL
) -> Project:
    """A fresh project of tables below a folder: labelled, and as two of them show it unless told otherwise."""
    assets = folder / "assets"
    assets.mkdir(parents=True)
    for source in (path for number in tables for path in TABLES.glob(f"table_{number:02}.*")):
        shutil.copyfile(source, assets / source.name)
    words = ("panel", "leg", "handle", "drawer", "misc")
    project = Project.create(folder / "project", [assets / "*.obj"], name="tables", vocabulary=words, orient=orient)
    shutil.copytree(TABLES / "templates", project.folder / "templates")
    if demonstrated:
        shutil.copytree(TABLES / "demonstrations", project.folder / "demonstrations")
    project.label("file")
    return project
