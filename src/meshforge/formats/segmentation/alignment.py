"""Segmented points in the frame of the asset that they are of: as they are, or turned, scaled and moved."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from meshforge.common import AssetError
from meshforge.geometry import Aabb, Floats

AlignMode = Literal["check", "box", "off"]
Up = Literal["y", "z"]
_TO_Z = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])  # points as rows, Y up, to those with Z up
_WAYS: dict[tuple[AlignMode, Up | None], str] = {
    ("check", None): "neither --align nor --points-up",
    ("check", "y"): "--points-up y",
    ("check", "z"): "--points-up z",
    ("box", None): "--align box",
    ("box", "y"): "--points-up y --align box",
    ("box", "z"): "--points-up z --align box",
}
_SLACK = 0.05  # of the diagonal of an asset: how far its box and that of its points may be apart at any side


@dataclass(frozen=True, slots=True)
class PointAlignment:
    """How points come into the frame of an asset. align: as they are if they fit (`check`), scaled evenly and moved so
    that the boxes fit (`box`), or as they are in any case (`off`); up: the axis that points up among the points, None
    where that is the asset's."""

    align: AlignMode = "check"
    up: Up | None = None


def align_points(
    points: Floats, boxes: Sequence[Aabb], placing: PointAlignment, where: str, up: Up | None = None
) -> Floats:
    """Points (n, 3) in the frame of an asset; boxes: of its hulls, and of what it shows; where: the file of the points;
    up: the axis that its format says points up, None where it says none: then it is the other one than theirs.

    Raises AssetError where the box of the points fits none of them, with what would make it fit.
    """
    own = _move(points, boxes, placing, up)
    if placing.align == "off" or _box_distance(own, boxes) <= _SLACK:
        return own
    apart = {way: _box_distance(_move(points, boxes, PointAlignment(*way), up), boxes) for way in _WAYS}
    best = min(_WAYS, key=lambda way: apart[way])
    raise AssetError(
        f"its points do not lie where the asset does: they are in a box {_describe_box(Aabb.of_points(own))}, "
        f"the hulls in a box {_describe_box(boxes[0])}",
        where=where,
        remedy=f"They would fit with {_WAYS[best]}."
        if apart[best] <= _SLACK
        else "Export them in the frame of the asset, in metres.",
    )


def _move(points: Floats, boxes: Sequence[Aabb], placing: PointAlignment, up: Up | None) -> Floats:
    turned = points if placing.up in (None, up) else points @ (_TO_Z if placing.up == "y" else _TO_Z.T)
    own = Aabb.of_points(turned)
    if placing.align != "box" or not own.diagonal > 0:
        return turned
    fitted = [(turned - own.center) * (box.diagonal / own.diagonal) + box.center for box in boxes]
    return min(fitted, key=lambda found: _box_distance(found, boxes))


def _box_distance(points: Floats, boxes: Sequence[Aabb]) -> float:
    """How far the box of points is from the nearest of some, as a share of its diagonal."""
    own = Aabb.of_points(points)
    return min(
        float(max(np.abs(own.min - box.min).max(), np.abs(own.max - box.max).max())) / box.diagonal for box in boxes
    )


def _describe_box(box: Aabb) -> str:
    size, middle = (" ".join(f"{x:.3g}" for x in values) for values in (box.size, box.center))
    return f"of {size} m around {middle}"
