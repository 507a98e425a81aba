"""The bundled family of tables as a project in a folder of its own, for the demos."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from meshforge.project import Project

OURS = ".meshforge-demo"
"""The mark of a folder that an earlier demo made, and that the next one may therefore replace."""
KEPT = ".meshforge-demo-studio"
"""The mark of a folder that a demo in the studio made; what a person did there stays."""
WORDS, ORIENT = ("panel", "leg", "handle", "drawer", "misc"), "+Z: Is(leg) -> Is(panel)"


def demonstrated_tables(out: Path) -> Project:
    """A fresh project of the tables below `out`, labelled and demonstrated. Raises UsageError as `_make_room`."""
    from meshforge.samples import TABLES

    _make_room(out, OURS)
    project = _tables(out)
    shutil.copytree(TABLES / "demonstrations", project.folder / "demonstrations")
    return project


def kept_tables(out: Path) -> Project:
    """The project that an earlier demo in the studio made below `out`, or a fresh one, labelled.

    Raises UsageError where the folder holds something else.
    """
    from meshforge.project import Project

    whole = out / KEPT
    if whole.exists() and whole.read_text(encoding="utf-8"):
        return Project.open(out / "project")
    _make_room(out, KEPT)
    project = _tables(out)
    whole.write_text("whole\n", encoding="utf-8")  # from now on it is a person's
    return project


def _make_room(out: Path, mark: str) -> None:
    """An empty folder with a mark. Raises UsageError where it holds what no demo of that kind made."""
    from meshforge.errors import UsageError

    if out.exists() and any(out.iterdir()) and not (out / mark).exists():
        raise UsageError("this folder holds something else", where=str(out), remedy="Choose another: demo --out DIR")
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    (out / mark).touch()


def _tables(out: Path) -> Project:
    from meshforge.project import Project
    from meshforge.samples import TABLES

    (out / "assets").mkdir()
    for source in sorted(TABLES.glob("table_*")):
        shutil.copyfile(source, out / "assets" / source.name)
    pattern = out / "assets" / "*.obj"
    project = Project.create(out / "project", [pattern], name="tables", vocabulary=WORDS, orient=ORIENT)
    shutil.copytree(TABLES / "templates", project.folder / "templates")
    project.label_from_files()
    return project
