"""Small meshes that the tests of the language talk about."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from meshforge.geometry import Box, Pose, Shape, convex_hull
from meshforge.language import Action, Replay, Template
from meshforge.symbolic import Hull, Label, SymbolicMesh


def box(low: Sequence[float], high: Sequence[float]) -> Box:
    """The axis-aligned box between two corners [m]."""
    a, b = np.array(low, dtype=float), np.array(high, dtype=float)
    return Box(Pose.of_translation((a + b) / 2), (b - a) / 2)


def hull(name: str, shape: Shape, label: str | None = None, body: str = "body", parent: str | None = None) -> Hull:
    return Hull(name, body, shape, Label(label, 0.8, "vlm") if label else None, parent)


def mesh(*hulls: Hull) -> SymbolicMesh:
    return SymbolicMesh(hulls)


def table() -> SymbolicMesh:
    """A top of 2 x 1 m at 1 m height on four legs of two pieces each, and a splinter under it."""
    hulls = [hull("top", box([0, 0, 1], [2, 1, 1.1]), "panel")]
    for k, (x, y) in enumerate([(0, 0), (1.9, 0), (0, 0.9), (1.9, 0.9)]):
        hulls.append(hull(f"leg{k}_low", box([x, y, 0], [x + 0.1, y + 0.1, 0.4]), "leg"))
        hulls.append(hull(f"leg{k}_high", box([x, y, 0.4], [x + 0.1, y + 0.1, 1]), "leg"))
    return mesh(*hulls, hull("splinter", box([1, 0.5, 0.5], [1.01, 0.51, 0.51]), "misc"))


def wedge(name: str = "wedge.obj") -> Template:
    """A template of one prism: 4 m along X, 2 m along Y, 1 m along Z, its ridge at y = 2."""
    points = [[x, y, z] for x in (0, 4) for y, z in ((0, 0), (2, 0), (2, 1))]
    return Template((convex_hull(np.array(points, dtype=float)),), name)


class Applied(NamedTuple):
    """What one action makes of a mesh."""

    mesh: SymbolicMesh
    made: tuple[str, ...]
    note: str | None
    sources: tuple[tuple[str, ...], ...]
    used: frozenset[str]


def apply_action(
    scene: SymbolicMesh,
    mask: int,
    action: Action,
    templates: Mapping[str, Template] | None = None,
    label: str | None = None,
    used: frozenset[str] = frozenset(),
) -> Applied:
    """What an action makes of the hulls of a bit set; used: names that no made hull may take."""
    done = Replay(scene, Pose.identity(), scene, scene, used=used).apply(mask, action, label, templates or {})
    line = done.trace[-1]
    return Applied(done.mesh, line.made, line.note, line.sources, done.used)
