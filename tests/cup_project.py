"""A project of two cups, of which one shows nothing, and a program that makes one hull of each."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from meshforge.batch import IN_PROCESS
from meshforge.geometry import Box
from meshforge.language import Program
from meshforge.project import Project
from tests.cups import BOTTOM, WALLS

CUP, BARE = "cup.urdf", "bare.urdf"
FILLING = "labels cup\n\nIs(cup) => Merge\n"
FILLED = "cup/b0~1"
"""The hull that fills a cup in the output."""


def cup_urdf(shown: bool, hulls: Sequence[Box] = (BOTTOM, *WALLS)) -> str:
    """A cup that collides by some boxes; shown: whether it has a visual, too, of its five."""

    def element(kind: str, name: str, box: Box) -> str:
        x, y, z = box.pose.translation
        a, b, c = 2 * box.half
        place, size = f'<origin xyz="{x} {y} {z}"/>', f'<geometry><box size="{a} {b} {c}"/></geometry>'
        return f'<{kind} name="{name}">{place}{size}</{kind}>'

    kinds = {"visual": (BOTTOM, *WALLS) if shown else (), "collision": hulls}
    elements = "".join(element(kind, f"b{k}", box) for kind, boxes in kinds.items() for k, box in enumerate(boxes))
    return f'<robot name="cup"><link name="cup">{elements}</link></robot>'


def cup_project(folder: Path) -> Project:
    """The project below a folder; its outputs are written: cups that are filled by one hull."""
    assets = folder / "assets"
    assets.mkdir(parents=True)
    for name, shown in ((CUP, True), (BARE, False)):
        (assets / name).write_text(cup_urdf(shown))
    project = Project.create(folder / "project", [assets / "*.urdf"], name="cups", vocabulary=("cup",))
    for asset in project.assets():
        project.set_labels(asset, {hull.name: "cup" for hull in project.mesh(asset).hulls})
    project.accept(Program.parse(FILLING))
    list(project.apply(execution=IN_PROCESS))
    return project
