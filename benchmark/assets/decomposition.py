"""From an asset to its collision meshes.

Separate: CoACD on every connected solid of the union of its parts, three times, ever finer. Merged: one call of CoACD
on the whole union, and one on the union whose joints were welded shut, so that hulls span parts.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from manifold3d import Manifold

from benchmark.assets.asset import Asset
from benchmark.assets.generation import Order
from meshforge.geometry import Floats, Polytope, Pose, convex_hull
from meshforge.geometry.decomposition.engines import CoacdSettings
from meshforge.geometry.decomposition.run import decompose
from meshforge.symbolic import Hull
from script.samples.part import Part
from script.samples.pieces import DIGITS, triangles
from script.samples.solids import union

_CONVEX = 0.999  # of the volume of its convex hull: such a solid is one hull at any setting
_LEAST = 1e-6  # volume of a hull that counts, of the asset's box


def coacd(threshold: float) -> CoacdSettings:
    """CoACD at a concavity threshold, searching less than by default, for time; watertight, so not remeshed."""
    return CoacdSettings(
        threshold=threshold,
        preprocess_mode="off",
        resolution=500,
        mcts_iterations=20,
        mcts_nodes=10,
        mcts_max_depth=2,
    )


SEPARATE = ("coarse", "medium", "fine")
"""Settings by which each connected solid is decomposed by itself: hardly a hull spans parts."""
MERGED = ("union", "welded")
"""Settings by which an asset is decomposed as a whole."""
SETTINGS = (*SEPARATE, *MERGED)
"""All settings by name."""
SETS = {"separate": SEPARATE, "union": ("union",), "welded": ("welded",)}
"""Settings that stand together, by name; figures of one set are kept apart from those of another."""
_SEPARATE_THRESHOLDS = {"coarse": 0.3, "medium": 0.12, "fine": 0.05}
# Of 0.05, 0.08, 0.12, 0.16, 0.2, 0.25 and 0.3 the finest one at which a quarter (union) or two fifths (welded) of the
# hulls of the calibration assets span parts, else the coarsest: so each category has hulls that span parts, and yet as
# many hulls as may be. CoACD's threshold is relative to an asset's longest side, and a knife at 0.3 is one hull.
_MERGED_THRESHOLDS = {
    "cup": {"union": 0.2, "welded": 0.3},
    "kettle": {"union": 0.16, "welded": 0.2},
    "knife": {"union": 0.05, "welded": 0.08},
    "chair": {"union": 0.08, "welded": 0.16},
    "dispenser": {"union": 0.08, "welded": 0.3},
    "door": {"union": 0.05, "welded": 0.05},
    "lamp": {"union": 0.25, "welded": 0.25},
    "table": {"union": 0.25, "welded": 0.3},
}
WELD = 0.001
"""Joints narrower than this are welded shut [m]: the widest ones of the generators' joints are hairlines of 0.0008."""
_RESIDUE = "misc"
_ATTEMPTS = 100  # at an asset whose separate decompositions differ


def threshold_of(setting: str, category: str) -> float:
    """CoACD's concavity threshold at a setting."""
    return _SEPARATE_THRESHOLDS.get(setting) or _MERGED_THRESHOLDS[category][setting]


@dataclass(frozen=True)
class Decomposition:
    """One collision mesh in the frame of the file; shares: for each hull, of its volume in parts, by label."""

    hulls: tuple[Polytope, ...]
    shares: tuple[dict[str, float], ...]

    def without(self, label: str) -> list[Polytope]:
        """The hulls that do not share most with parts of a label."""
        rows = zip(self.hulls, self.shares, strict=True)
        return [hull for hull, share in rows if max(share, key=lambda name: share[name]) != label]


def draw_decomposed(order: Order, cache: Path | None = None) -> tuple[Asset, dict[str, Decomposition]]:
    """The first draw of an asset whose separate decompositions are three different ones, and these by setting.

    What is drawn again must differ without its residue, too.
    """
    for attempt in range(_ATTEMPTS):
        asset, found = order.draw(attempt), dict[str, Decomposition]()
        for setting in SEPARATE:
            found[setting] = decompose_asset(asset, setting, cache)
            if not are_different(made.hulls if not attempt else made.without(_RESIDUE) for made in found.values()):
                break
        else:
            return asset, found
    raise RuntimeError(f"{order.name}: no draw of {_ATTEMPTS} has three different decompositions")


def are_different(meshes: Iterable[Iterable[Polytope | Hull]]) -> bool:
    """Whether no two meshes have the same hulls, in whatever order hulls and vertices come."""
    seen = [b"".join(sorted(_outline(hull) for hull in hulls)) for hulls in meshes]
    return len(set(seen)) == len(seen)


def _outline(hull: Polytope | Hull) -> bytes:
    grid = np.round(hull.vertices * 10**DIGITS).astype(np.int64)
    return bytes(grid[np.lexsort(grid.T)].tobytes())


def decompose_asset(asset: Asset, setting: str, cache: Path | None = None) -> Decomposition:
    """The collision mesh of an asset at one setting; cache: where CoACD's results are kept (default: nowhere)."""
    hulls = [hull for solid in solids_of(asset, setting) for hull in _hulls(solid, asset, setting, cache)]
    order = sorted(range(len(hulls)), key=lambda k: tuple(hulls[k].centroid.round(4)))  # tells nothing of parts
    placed = [_round(hulls[k], asset) for k in order]
    return Decomposition(tuple(placed), tuple(shares(hull, asset.parts, asset.pose) for hull in placed))


def solids_of(asset: Asset, setting: str) -> list[Manifold]:
    """What CoACD is called on, one by one, upright: each connected solid of the union of all parts, or the whole."""
    whole = union([part.solid for part in asset.parts])
    if setting in SEPARATE:
        return list(whole.decompose())
    return [whole if setting == "union" else whole.minkowski_sum(Manifold.cube((WELD,) * 3, True))]


def _hulls(solid: Manifold, asset: Asset, setting: str, cache: Path | None) -> list[Polytope]:
    """The hulls of a solid, upright; what was scanned is decomposed as it lies in its file."""
    points, faces = triangles(solid)
    hull = convex_hull(points)
    if solid.volume() >= _CONVEX * hull.volume:
        return [hull]
    settings = coacd(threshold_of(setting, asset.category))
    if not asset.scanned:
        return decompose(points, faces, settings, cache=cache)
    lying = np.round(points @ asset.pose.rotation.T + asset.pose.translation, 7)
    back = asset.pose.inverse()
    return [_move(piece, back) for piece in decompose(lying, faces, settings, cache=cache)]


def _move(hull: Polytope, pose: Pose) -> Polytope:
    return Polytope(hull.vertices @ pose.rotation.T + pose.translation, hull.faces)


def _round(hull: Polytope, asset: Asset) -> Polytope:
    """The hull in the frame of the file, its coordinates in hundredths of a millimetre."""
    return convex_hull(np.round(_move(hull, asset.pose).vertices, DIGITS), name=asset.name)


def shares(hull: Polytope, parts: Sequence[Part], pose: Pose) -> dict[str, float]:
    """What share of the volume that a hull has in parts is in parts of each label, the largest first.

    A hull that is in no part at all (it fills a hollow) is given to the part whose surface is nearest.
    """
    solid, inside = _upright_solid(hull, pose), volumes_in_parts(hull, parts, pose)
    total = sum(inside.values())
    if total <= _LEAST * float(solid.volume()):
        nearest = min(parts, key=lambda part: float(solid.min_gap(part.solid, 10.0)))
        return {nearest.label: 1.0}
    found = {label: round(volume / total, 4) for label, volume in inside.items() if volume > 0}
    return dict(sorted(found.items(), key=lambda row: -row[1]))


def volumes_in_parts(hull: Polytope, parts: Sequence[Part], pose: Pose) -> dict[str, float]:
    """The volume that a hull has in parts of each label [m^3], in the order of the parts."""
    solid = _upright_solid(hull, pose)
    inside: dict[str, float] = {}
    for part in parts:
        volume = max(float((solid ^ part.solid).volume()), 0.0) if _near(solid, part.solid) else 0.0
        inside[part.label] = inside.get(part.label, 0.0) + volume
    return inside


def _upright_solid(hull: Polytope, pose: Pose) -> Manifold:
    back = pose.inverse()
    return Manifold.hull_points(hull.vertices @ back.rotation.T + back.translation)


def _near(one: Manifold, other: Manifold) -> bool:
    a, b = one.bounding_box(), other.bounding_box()
    return all(a[k] <= b[k + 3] and b[k] <= a[k + 3] for k in range(3))


def bounds(parts: Sequence[Part]) -> tuple[Floats, Floats]:
    """The lowest and the highest corner of all parts [m]."""
    rows = np.array([part.solid.bounding_box() for part in parts])
    return rows[:, :3].min(axis=0), rows[:, 3:].max(axis=0)
