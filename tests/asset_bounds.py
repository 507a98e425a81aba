"""The box around an asset, to compare assets by."""

from __future__ import annotations

from meshforge.geometry import Aabb
from meshforge.symbolic import Asset


def bounds_of(asset: Asset) -> Aabb:
    """The box around all geoms, of which there is one at least."""
    return Aabb.union(geom.shape.aabb for geom in asset.geoms)
