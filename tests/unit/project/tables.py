"""A project of three small tables, as far on its way as a test needs it."""

from pathlib import Path

from meshforge.batch import IN_PROCESS
from meshforge.language import Delete, Each, Merge
from meshforge.project import Project
from meshforge.synthesis import Step
from tests.unit.batch.families import write_tables

LEGS = {"left_low", "left_high", "right_low", "right_high"}
STEPS = (Step(1, {"crumb"}, Delete()), Step(2, LEGS, Each(Merge())))
FIRST, SECOND, THIRD = (f"table{k}/model.obj" for k in range(3))


def fresh(folder: Path) -> Project:
    write_tables(folder / "assets", 3)
    return Project.create(folder / "tables", [folder / "assets"])


def labelled(folder: Path) -> Project:
    project = fresh(folder)
    project.label("file")
    return project


def demonstrated(folder: Path) -> Project:
    project = labelled(folder)
    for asset in (FIRST, SECOND):
        project.demonstrate(asset, STEPS)
    return project


def learned(folder: Path) -> Project:
    project = demonstrated(folder)
    project.synthesize()
    return project


def applied(folder: Path) -> Project:
    project = learned(folder)
    list(project.apply(execution=IN_PROCESS))
    return project
