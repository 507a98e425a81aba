"""Sizes that hint at another unit than the metre."""

from __future__ import annotations

import numpy as np

from meshforge.asset import Asset
from meshforge.errors import AssetError
from meshforge.formats.meshfile import FARTHEST

_LARGE = 50.0  # m: beyond nearly all assets in metres; a mug in millimetres is 100 across
_SMALL = 1e-3  # m: below nearly all assets in metres


def refuse_beyond(asset: Asset) -> None:
    """Raise AssetError where a piece is not in a place of finite numbers, or so far out that numbers lose it."""
    corners = {geom.name: (geom.shape.aabb.min, geom.shape.aabb.max) for geom in asset.geoms}
    surfaces = {piece.name: piece.surface.vertices for piece in asset.opaque if piece.surface}
    for name, points in (corners | surfaces).items():
        if not (np.abs(points) <= FARTHEST).all():  # true of NaN as well
            problem = f"{name} reaches beyond all numbers that are read, {FARTHEST:g} m"
            raise AssetError(problem, where=str(asset.path), remedy="Mend its place, its size or its scale.")


def unit_note(asset: Asset) -> str | None:
    """What to tell about the size of an asset, None where that is usual."""
    points = [corner for geom in asset.geoms for box in [geom.shape.aabb] for corner in (box.min, box.max)]
    surfaces = [o.surface.vertices[np.unique(o.surface.faces)] for o in asset.opaque if o.surface]
    corners = np.concatenate([*(p[None] for p in points), *surfaces]) if points or surfaces else np.zeros((0, 3))
    if len(corners) == 0:
        return None
    size = float(np.linalg.norm(np.ptp(corners, axis=0)))
    if _SMALL <= size <= _LARGE or size == 0:
        return None
    advice = "export it in metres, or scale it where a URDF or MJCF refers to it"
    if size > _LARGE:
        return f"it is {size:,.4g} m across: if its unit is the millimetre, {advice}"
    return f"it is {size:.2g} m across: if its unit is not the metre, {advice}"
