"""Small meshes of boxes, for tests of learning."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from meshforge.geometry import Aabb, Box, Pose
from meshforge.symbolic import Hull, Label, SymbolicMesh

Piece = tuple[str, str | None, Sequence[float], Sequence[float]]
"""Name, label, lower corner [m], size [m]."""


def boxes(*pieces: Piece, body: str = "body") -> SymbolicMesh:
    """A mesh of axis-aligned boxes; boxes that share a face, an edge or a corner are in contact."""
    return SymbolicMesh(tuple(_hull(piece, body) for piece in pieces))


def turned(mesh: SymbolicMesh, axes: str) -> SymbolicMesh:
    """A mesh of boxes with its axes renamed in a cycle, as if it came in another frame: "YZX" puts x on Y."""
    to = ["XYZ".index(axis) for axis in axes]
    moved = []
    for hull in mesh.hulls:
        low, high = [0.0] * 3, [0.0] * 3
        for axis in range(3):
            low[to[axis]], high[to[axis]] = float(hull.aabb.min[axis]), float(hull.aabb.max[axis])
        moved.append(Hull(hull.name, hull.body, Box.of_bounds(Aabb(low, high)), hull.annotation))
    return SymbolicMesh(tuple(moved))


def _hull(piece: Piece, body: str) -> Hull:
    name, label, low, size = piece
    high = [corner + side for corner, side in zip(low, size, strict=True)]
    return Hull(name, body, Box.of_bounds(Aabb(low, high)), Label(label) if label else None)


def table(legs: int = 4, drawers: int = 1, knob: float | None = 0.1, litter: int = 1) -> SymbolicMesh:
    """A table: a top of two boards above a shelf (all panel), legs of two pieces, drawers with handles, litter.

    Of each drawer there are a bottom, a front and two sides; the handle sits on the front. A knob, labelled as
    handle too, touches no drawer: its height [m], None for no knob.
    """
    pieces: list[Piece] = [
        ("top_0", "panel", (0.0, 0.0, 0.72), (0.6, 0.8, 0.04)),
        ("top_1", "panel", (0.6, 0.0, 0.72), (0.6, 0.8, 0.04)),
        ("shelf", "panel", (0.05, 0.0, 0.1), (1.1, 0.8, 0.02)),
    ]
    corners = [(0.0, 0.0), (1.15, 0.0), (0.0, 0.75), (1.15, 0.75), (0.6, 0.45)]
    for k, (x, y) in enumerate(corners[:legs]):
        pieces.append((f"leg{k}_low", "leg", (x, y, 0.0), (0.05, 0.05, 0.4)))
        pieces.append((f"leg{k}_high", "leg", (x, y, 0.4), (0.05, 0.05, 0.32)))
    for k in range(drawers):
        x = 0.1 + 0.35 * k
        pieces += [
            (f"drawer{k}_bottom", "drawer", (x, 0.02, 0.48), (0.3, 0.4, 0.07)),
            (f"drawer{k}_front", "drawer", (x, 0.0, 0.55), (0.3, 0.02, 0.13)),
            (f"drawer{k}_left", "drawer", (x, 0.02, 0.55), (0.01, 0.4, 0.05)),
            (f"drawer{k}_right", "drawer", (x + 0.29, 0.02, 0.55), (0.01, 0.4, 0.05)),
            (f"handle{k}", "handle", (x + 0.1, -0.03, 0.57), (0.1, 0.03, 0.02)),
        ]
    if knob is not None:
        pieces.append(("knob", "handle", (1.2, 0.4, knob), (0.02, 0.02, 0.02)))
    for k in range(litter):
        pieces.append((f"residue_{k}", "misc", (0.3 + 0.2 * k, 0.6, 0.2), (0.01, 0.01, 0.01)))
    return boxes(*pieces)


def rack(off: float = 0.0, tops: int = 1, extra: Sequence[Piece] = ()) -> SymbolicMesh:
    """Boards one above the other, the topmost in pieces; a foot below them, off their middle. Nothing touches."""
    pieces: list[Piece] = [("leg", "leg", (0.9 + off, 0.9, 0.0), (0.2, 0.2, 0.2))]
    pieces += [(f"board_{k}", "panel", (0.0, 0.0, 0.8 + 0.7 * k), (2.0, 2.0, 0.1)) for k in range(2)]
    pieces += [(f"top_{k}", "panel", (2.1 * k / tops, 0.0, 2.2), (2.1 / tops - 0.1, 2.0, 0.1)) for k in range(tops)]
    return boxes(*pieces, *extra)


def posed(mesh: SymbolicMesh, x: Sequence[float], y: Sequence[float]) -> SymbolicMesh:
    """The mesh turned so that its X and Y axes come to lie along two unit vectors."""
    pose = Pose(np.column_stack([x, y, np.cross(x, y)]), np.zeros(3))
    return mesh.with_hulls(hull.move(pose) for hull in mesh.hulls)
