"""A project of microwaves of boxes: a disc lies flat in each, and two flat bars lie 14.1 mm before the door."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from meshforge import save
from meshforge.geometry import Box, Pose, Shape, convex_hull
from meshforge.language import Action
from meshforge.project import Project
from meshforge.symbolic import Hull, Label, SymbolicMesh
from meshforge.synthesis import Step

NAMES = [f"microwave{k}.obj" for k in range(5)]
GAP = 0.0141
_TURN = np.arange(24) * (2 * np.pi / 24)


def microwave(size: float = 1.0) -> SymbolicMesh:
    """One; size: 1 for 0.5 m of width."""
    slabs = {
        "floor": ((0, 0, 0), (0.5, 0.4, 0.02)),
        "ceiling": ((0, 0, 0.28), (0.5, 0.4, 0.3)),
        "back": ((0, 0.38, 0.02), (0.5, 0.4, 0.28)),
        "left": ((0, 0.02, 0.02), (0.02, 0.38, 0.28)),
        "right": ((0.48, 0.02, 0.02), (0.5, 0.38, 0.28)),
        "door": ((0, 0, 0.02), (0.5, 0.02, 0.28)),
        "bar_a": ((0.43, -GAP - 0.01, 0.05), (0.47, -GAP, 0.13)),
        "bar_b": ((0.43, -GAP - 0.01, 0.15), (0.47, -GAP, 0.25)),
    }
    shapes: dict[str, Shape] = {name: _box(low, high) for name, (low, high) in slabs.items()}
    rims = [
        np.column_stack([0.25 + 0.16 * np.cos(_TURN), 0.2 + 0.16 * np.sin(_TURN), 0 * _TURN + z]) for z in (0.03, 0.035)
    ]
    shapes["disc"] = convex_hull(np.concatenate(rims))
    labels = {"disc": "plate", "bar_a": "handle", "bar_b": "handle"}
    hulls = (
        Hull(name, "body", shape.transform(np.eye(3) * size, np.zeros(3)), Label(labels.get(name, "case"), 1.0, "user"))
        for name, shape in shapes.items()
    )
    return SymbolicMesh(tuple(hulls))


def _box(low: tuple[float, ...], high: tuple[float, ...]) -> Box:
    a, b = np.array(low, dtype=float), np.array(high, dtype=float)
    return Box(Pose.of_translation((a + b) / 2), (b - a) / 2)


def show_microwaves(folder: Path, shown: Mapping[str, Action]) -> Project:
    """The project, its labels known and its program learned; shown: on two of them, the action on each label."""
    (folder / "assets").mkdir()
    meshes = {name: microwave(1 + k / 10) for k, name in enumerate(NAMES)}
    for name, mesh in meshes.items():
        save(mesh, folder / "assets" / name)
    project = Project.create(folder / "project", [folder / "assets"], vocabulary=("case", "plate", "handle"))
    for name, mesh in meshes.items():
        project.set_labels(name, {hull.name: hull.label for hull in mesh.hulls})
    for name in NAMES[:2]:
        groups = {label: {hull.name for hull in meshes[name].hulls if hull.label == label} for label in shown}
        steps = [Step(k, groups[label], action) for k, (label, action) in enumerate(shown.items(), 1)]
        project.demonstrate(name, steps)
    project.synthesize()
    return project
