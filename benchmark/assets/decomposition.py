"""From an asset to its collision meshes: CoACD on every connected solid of its union, three times, ever finer."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from manifold3d import Manifold

from benchmark.assets.asset import Asset
from meshforge.geometry import Floats, Polytope, Pose, convex_hull
from meshforge.geometry.decomposition.engines import CoacdSettings
from meshforge.geometry.decomposition.run import decompose
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


SETTINGS = {"coarse": coacd(0.3), "medium": coacd(0.12), "fine": coacd(0.05)}
"""The three settings by name."""


@dataclass(frozen=True)
class Decomposition:
    """One collision mesh in the frame of the file; shares: for each hull, of its volume in parts, by label."""

    hulls: tuple[Polytope, ...]
    shares: tuple[dict[str, float], ...]


def decompose_asset(asset: Asset, setting: str, cache: Path | None = None) -> Decomposition:
    """The collision mesh of an asset at one setting; cache: where CoACD's results are kept (default: nowhere)."""
    hulls = [hull for solid in _solids(asset) for hull in _hulls(solid, asset, SETTINGS[setting], cache)]
    order = sorted(range(len(hulls)), key=lambda k: tuple(hulls[k].centroid.round(4)))  # tells nothing of parts
    placed = [_round(hulls[k], asset) for k in order]
    return Decomposition(tuple(placed), tuple(shares(hull, asset.parts, asset.pose) for hull in placed))


def _solids(asset: Asset) -> list[Manifold]:
    """The connected solids of the union of all parts, upright."""
    return list(union([part.solid for part in asset.parts]).decompose())


def _hulls(solid: Manifold, asset: Asset, settings: CoacdSettings, cache: Path | None) -> list[Polytope]:
    """The hulls of one solid, upright; what was scanned is decomposed as it lies in its file."""
    points, faces = triangles(solid)
    hull = convex_hull(points)
    if solid.volume() >= _CONVEX * hull.volume:
        return [hull]
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
    back = pose.inverse()
    solid = Manifold.hull_points(hull.vertices @ back.rotation.T + back.translation)
    inside: dict[str, float] = {}
    for part in parts:
        volume = max(float((solid ^ part.solid).volume()), 0.0) if _near(solid, part.solid) else 0.0
        inside[part.label] = inside.get(part.label, 0.0) + volume
    total = sum(inside.values())
    if total <= _LEAST * float(solid.volume()):
        nearest = min(parts, key=lambda part: float(solid.min_gap(part.solid, 10.0)))
        return {nearest.label: 1.0}
    found = {label: round(volume / total, 4) for label, volume in inside.items() if volume > 0}
    return dict(sorted(found.items(), key=lambda row: -row[1]))


def _near(one: Manifold, other: Manifold) -> bool:
    a, b = one.bounding_box(), other.bounding_box()
    return all(a[k] <= b[k + 3] and b[k] <= a[k + 3] for k in range(3))


def bounds(parts: Sequence[Part]) -> tuple[Floats, Floats]:
    """The lowest and the highest corner of all parts [m]."""
    rows = np.array([part.solid.bounding_box() for part in parts])
    return rows[:, :3].min(axis=0), rows[:, 3:].max(axis=0)
