"""The program that two of the tables teach, and the template it inserts."""

from __future__ import annotations

from manifold3d import Manifold

from script.samples.part import LABELS
from script.samples.solids import block

PROGRAM = f"""\
labels {", ".join(LABELS)}

orient +Z: Is(leg) -> Is(panel)

Is(misc)                        => Delete
Geo(Is(panel), +Z)              => Replace(box)
Is(leg)                         => Each(Merge)
Is(drawer)                      => Each(Replace("tray.obj"))
Attach(Is(handle), Is(drawer))  => Each(Replace(capsule))
"""
DEMONSTRATED = ("table_03", "table_08")
_WALL = 0.06  # of the tray's width, depth and height


def tray() -> dict[str, Manifold]:
    """An open tray in the unit cube, of a floor and four walls."""
    w = _WALL
    return {
        "floor": block((0, 0, 0), (1, 1, w)),
        "wall_west": block((0, 0, w), (w, 1, 1)),
        "wall_east": block((1 - w, 0, w), (1, 1, 1)),
        "wall_south": block((w, 0, w), (1 - w, w, 1)),
        "wall_north": block((w, 1 - w, w), (1 - w, 1, 1)),
    }
