"""Sizes that hint at another unit than the metre."""

from __future__ import annotations

import numpy as np

from meshforge.asset import Asset

_LARGE = 50.0  # m: beyond nearly all assets in metres; a mug in millimetres is 100 across
_SMALL = 1e-3  # m: below nearly all assets in metres


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
