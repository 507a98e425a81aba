"""Whether segmented points are in the frame of an asset, and how they are brought there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from meshforge.errors import GeometryError
from meshforge.geometry import Aabb, Floats

Align = Literal["check", "box", "off"]
Up = Literal["y", "z"]
_TO_Z = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])  # points as rows, Y up, to those with Z up
_CHECKED: tuple[Align, ...] = ("check", "box")
_AXES: tuple[Up | None, ...] = (None, "y", "z")
_SLACK = 0.05  # of the diagonal of an asset: how far its box and that of its points may be apart at any side


@dataclass(frozen=True, slots=True)
class Placing:
    """How points come into the frame of an asset. align: as they are if they fit (`check`), scaled evenly and moved so
    that the boxes fit (`box`), or as they are in any case (`off`); up: the axis that points up among the points, None
    where that is the asset's."""

    align: Align = "check"
    up: Up | None = None


def placed(points: Floats, boxes: Sequence[Aabb], placing: Placing, up: Up | None = None) -> Floats:
    """Points (n, 3) in the frame of an asset; boxes: of its hulls, and of what it shows; up: the axis that its format
    says points up, None where it says none: then it is the other one than that of the points.

    Raises GeometryError where the box of the points fits none of them, with what would make it fit.
    """
    own = _moved(points, boxes, placing, up)
    if placing.align == "off" or _apart(own, boxes) <= _SLACK:
        return own
    ways = (Placing(align, axis) for align in _CHECKED for axis in _AXES)
    apart = {way: _apart(_moved(points, boxes, way, up), boxes) for way in ways}
    best = min(apart, key=lambda way: apart[way])
    fits = apart[best] <= _SLACK
    raise GeometryError(
        f"its points do not lie where the asset does: they are in a box {_told(_box(own))}, "
        f"the hulls in a box {_told(boxes[0])}",
        remedy=f"They would fit with {_option(best)}." if fits else "Export them in the frame of the asset, in metres.",
    )


def _moved(points: Floats, boxes: Sequence[Aabb], placing: Placing, up: Up | None) -> Floats:
    turn = np.eye(3) if placing.up in (None, up) else _TO_Z if placing.up == "y" else _TO_Z.T
    turned = points @ turn
    if placing.align != "box":
        return turned
    fitted = [_onto(turned, box) for box in boxes]
    return min(fitted, key=lambda own: _apart(own, boxes))


def _onto(points: Floats, box: Aabb) -> Floats:
    """Points scaled evenly and moved so that their box has the diagonal and the middle of another."""
    own = _box(points)
    scale = box.diagonal / own.diagonal if own.diagonal > 0 else 1.0
    moved: Floats = (points - own.center) * scale + box.center
    return moved


def _apart(points: Floats, boxes: Sequence[Aabb]) -> float:
    """How far the box of points is from the nearest of some, as a share of its diagonal."""
    own = _box(points)
    return min(
        float(max(np.abs(own.min - box.min).max(), np.abs(own.max - box.max).max())) / box.diagonal for box in boxes
    )


def _box(points: Floats) -> Aabb:
    return Aabb.of_points(points)


def _told(box: Aabb) -> str:
    size, middle = (" ".join(f"{x:.3g}" for x in values) for values in (box.size, box.center))
    return f"of {size} m around {middle}"


def _option(placing: Placing) -> str:
    given = [f"--points-up {placing.up}"] if placing.up else []
    given += [f"--align {placing.align}"] if placing.align == "box" else []
    return " ".join(given) or "neither --align nor --points-up"
