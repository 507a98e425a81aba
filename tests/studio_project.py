"""The bundled family of tables as a project, for tests of what the studio shows of it."""

from __future__ import annotations

import shutil
from pathlib import Path

from meshforge.project import Project
from meshforge.samples import TABLES

ORIENT = "+Z: Is(leg) -> Is(panel)"


def demo_project(folder: Path, *, demonstrated: bool = True, orient: str = ORIENT) -> Project:
    """A fresh project of the tables below a folder: labelled, and as two of them show it unless told otherwise."""
    assets = folder / "assets"
    assets.mkdir(parents=True)
    for source in sorted(TABLES.glob("table_*")):
        shutil.copyfile(source, assets / source.name)
    words = ("panel", "leg", "handle", "drawer", "misc")
    project = Project.create(folder / "project", [assets / "*.obj"], name="tables", vocabulary=words, orient=orient)
    shutil.copytree(TABLES / "templates", project.folder / "templates")
    if demonstrated:
        shutil.copytree(TABLES / "demonstrations", project.folder / "demonstrations")
    project.label("file")
    return project
