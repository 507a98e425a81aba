"""Triangles of several things in one ray-casting scene; every triangle knows whose it is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from meshforge.geometry import Floats, Ints
from meshforge.views.camera import Camera, Singles
from meshforge.views.roundness import Skin

_BIAS = 5e-6  # shift towards the eye, an item, so that of two faces in one plane one wins everywhere
_SWELL = 2e-6  # the same for rays from all sides: things grow by so much of their size
_BIAS_STEPS = 64


@dataclass(frozen=True, eq=False, slots=True)
class Scene:
    """Triangles (m) with their item, planar facet and normals, in a frame of unit size; embree: the ray caster.

    corners: (m, 3, 3); item, facet: (m,); normals: (m, 3), outward; bent: normals at the corners (m, 3, 3), or NaN
    where a triangle is flat.
    """

    corners: Floats
    item: Ints
    facet: Ints
    normals: Floats
    bent: Floats
    embree: Any

    @property
    def is_round(self) -> Any:
        """Which triangles (m,) belong to a round surface."""
        return np.isfinite(self.bent[:, 0, 0])

    def smooth_normals(self, triangles: Ints, points: Floats) -> Floats:
        """The smooth normals at points (n, 3) of round triangles (n,)."""
        a, b, c = (self.corners[triangles, k] for k in range(3))
        normal = np.cross(b - a, c - a)
        area = np.einsum("ij,ij->i", normal, normal)
        second = np.einsum("ij,ij->i", np.cross(points - a, c - a), normal) / area
        third = np.einsum("ij,ij->i", np.cross(b - a, points - a), normal) / area
        shares = np.stack([1 - second - third, second, third], axis=1)
        mixed = np.einsum("ik,ikj->ij", shares, self.bent[triangles])
        smooth: Floats = mixed / np.linalg.norm(mixed, axis=1, keepdims=True)
        return smooth

    def is_blocked(self, origins: Singles, directions: Singles, reach: float) -> Any:
        """Which rays (n,) meet something within `reach`."""
        reaches = np.full(len(origins), reach, np.float32)
        return self.embree.run(origins, directions, dists=reaches, query="OCCLUDED") >= 0

    def depth(self, triangles: Ints, origins: Floats, directions: Floats) -> Floats:
        """How far along its ray each hit of a known triangle (n,) lies."""
        normals = self.normals[triangles]
        ahead = np.einsum("ij,ij->i", self.corners[triangles, 0] - origins, normals)
        facing = np.einsum("ij,ij->i", np.broadcast_to(directions, normals.shape), normals)
        depth: Floats = ahead / np.where(np.abs(facing) > 1e-12, facing, 1e-12)
        return depth


def assembled(skins: Sequence[Skin], center: Floats, unit: float) -> Scene:
    """The triangles of some skins, moved so that `center` becomes the origin and `unit` [m] becomes one.

    No rays can meet them before `seen_from`.
    """
    parts = [_part(s, center, unit) for s in skins]
    item = np.repeat(np.arange(len(parts)), [len(p[0]) for p in parts])
    corners = np.concatenate([p[0] for p in parts]) if parts else np.zeros((0, 3, 3))
    bent = np.concatenate([p[1] for p in parts]) if parts else np.zeros((0, 3, 3))
    solid, normals = _normals(corners)
    corners, bent, item, normals = corners[solid], bent[solid], item[solid], normals[solid]
    return Scene(corners, item, _facets(item, normals, bent), normals, bent, None)


def seen_from(scene: Scene, towards: Floats | None) -> Scene:
    """The scene, ready for rays from one side; towards: (3,), of unit length.

    None makes it ready for all sides: things in one place then differ a little in size, not in depth.
    """
    from embreex.mesh_construction import TriangleMesh
    from embreex.rtcore_scene import EmbreeScene

    order = (scene.item % _BIAS_STEPS)[:, None, None]
    away = _SWELL * (scene.corners - _middles(scene)[:, None]) if towards is None else _BIAS * towards
    corners = scene.corners + order * away
    embree = EmbreeScene()
    if len(corners):
        TriangleMesh(embree, corners.astype(np.float32))
    return replace(scene, corners=corners, embree=embree)


def _middles(scene: Scene) -> Floats:
    """The middle (m, 3) of the thing that each triangle belongs to."""
    count = np.maximum(np.bincount(scene.item), 1)
    sums = [np.bincount(scene.item, part) for part in scene.corners.mean(axis=1).T]
    middles: Floats = (np.stack(sums, axis=1) / count[:, None])[scene.item]
    return middles


def _part(skin: Skin, center: Floats, unit: float) -> tuple[Floats, Floats]:
    corners = ((skin.vertices - center) / unit)[skin.faces]
    bent = np.full(corners.shape, np.nan) if skin.normals is None else skin.normals[skin.faces]
    return corners, bent


def _normals(corners: Floats) -> tuple[Any, Floats]:
    """Which triangles have an area, and unit normals of all."""
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(cross, axis=1)
    solid = length > 1e-14
    return solid, cross / np.where(solid, length, 1.0)[:, None]


def _facets(item: Ints, normals: Floats, bent: Floats) -> Ints:
    """One number for all triangles of an item with one normal: the same face of a convex piece, or one round thing."""
    steps = np.rint(normals * 500).astype(np.int64) + 512
    key = ((item * 1024 + steps[:, 0]) * 1024 + steps[:, 1]) * 1024 + steps[:, 2]
    flat = ~np.isfinite(bent[:, 0, 0])
    return np.unique(np.where(flat, key, -1 - item), return_inverse=True)[1].astype(np.int32)


def rays(camera: Camera, columns: Floats, rows: Floats, start: float) -> tuple[Singles, Singles]:
    """Origins (n, 3) and directions (n, 3), or (1, 3) where all agree, of the rays through pixels.

    columns (w,) and rows (h,) give the n = h * w pixels of a window, row by row; start: how far towards the eye
    parallel rays begin.
    """
    right, up = camera.plane_coordinates(columns, rows)
    spread = (right[:, None] * camera.axes[0]).astype(np.float32)[None]
    lift = (up[:, None] * camera.axes[1]).astype(np.float32)[:, None]
    if camera.eye is None:
        start = (camera.axes[2] * start).astype(np.float32)
        return (lift + start + spread).reshape(-1, 3), (-camera.axes[2:]).astype(np.float32)
    ahead = (-camera.axes[2]).astype(np.float32)
    origin = np.broadcast_to(camera.eye.astype(np.float32), (len(right) * len(up), 3))
    return origin, (lift + ahead + spread).reshape(-1, 3)
