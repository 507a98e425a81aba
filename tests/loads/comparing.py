"""Whether the shapes that a reader tells are those that MeshForge has."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.optimize import linear_sum_assignment
from scipy.spatial.distance import cdist

from meshforge.symbolic import Asset
from tests.loads.readers import DIRECTIONS, Reader, Seen

TOLERANCE = 2e-5
"""Share of the largest coordinate: several readers and formats keep 24 bits of a number."""
_ROUND = ("capsule", "cylinder", "ellipsoid", "sphere")


def shapes_of(asset: Asset, *, opaque: bool = True) -> list[Seen]:
    """The hulls of an asset as MeshForge has them, and its opaque shapes but for endless planes."""
    hulls = [
        Seen(geom.shape.kind, tuple(float(geom.shape.support(way) @ way) for way in DIRECTIONS)) for geom in asset.geoms
    ]
    surfaces = [piece.surface for piece in asset.non_convex if opaque and piece.surface is not None]
    return hulls + [Seen("opaque", tuple((s.vertices @ DIRECTIONS.T).max(axis=0).tolist())) for s in surfaces]


def differences(wanted: Sequence[Seen], found: Sequence[Seen], reader: Reader, suffix: str) -> list[str]:
    """What differs in a file of a suffix, as sentences.

    Shapes are matched so that they differ least, whatever their order.
    """
    besides = suffix in reader.besides
    if reader.grain(suffix) == "file":
        wanted, found = _together(wanted), _together(found)
    if len(wanted) > len(found) or (len(wanted) < len(found) and not besides):
        return [f"{len(found)} shapes instead of {len(wanted)}"]
    if not wanted:
        return []
    ours = np.array([seen.reach for seen in wanted])
    theirs = np.array([seen.reach for seen in found])
    slack = TOLERANCE * float(np.abs(ours).max())
    told = []
    matched = linear_sum_assignment(cdist(ours, theirs, "chebyshev"))
    for k, j in zip(*(side.tolist() for side in matched), strict=True):
        apart, width = theirs[j] - ours[k], _width(ours[k])
        more = slack + reader.share * width
        less = more + reader.inward + (reader.rounds * width if wanted[k].kind in _ROUND else 0.0)
        if apart.max() > more or apart.min() < -less:
            worst = int(np.abs(apart).argmax())
            way = ", ".join(f"{x:.2g}" for x in DIRECTIONS[worst])
            told.append(f"a {wanted[k].kind} reaches {apart[worst]:+.3g} m too far along ({way})")
    return told


def _together(shapes: Sequence[Seen]) -> list[Seen]:
    """One shape around all."""
    return [Seen("file", tuple(np.max([seen.reach for seen in shapes], axis=0).tolist()))] if shapes else []


def _width(reach: np.ndarray) -> float:
    """The largest width of a shape: a direction and its opposite stand as far from the ends of the list."""
    return float((reach + reach[::-1]).max())
