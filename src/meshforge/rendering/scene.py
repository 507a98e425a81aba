"""Shapes as triangles to look at, round primitives with smooth normals, and many of them in one ray-casting scene."""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, assert_never

import numpy as np

from meshforge.common import MeshForgeError
from meshforge.geometry import Capsule, Cylinder, Ellipsoid, Floats, Ints, Pose, Shape, Sphere
from meshforge.rendering.camera import Camera, Floats32
from meshforge.symbolic import Surface

_CYLINDER_PROFILE = np.array(
    [[0, -1, 0, -1], [1, -1, 0, -1], [1, -1, 1, 0], [1, 1, 1, 0], [1, 1, 0, 1], [0, 1, 0, 1]], dtype=np.float64
)
"""Radius, height, and the normal's radial and axial part, from bottom to top; doubled rings make sharp rims."""

_BIAS = 5e-6  # shift towards the eye, an item, so that of two faces in one plane one wins everywhere
_SWELL = 2e-6  # the same for rays from all sides: things grow by so much of their size
_BIAS_STEPS = 64


@dataclass(frozen=True, eq=False, slots=True)
class RenderMesh:
    """Triangles of one thing: vertices (n, 3) [m], faces (m, 3); normals (n, 3) where it is to look round."""

    vertices: Floats
    faces: Ints
    normals: Floats | None = None


def to_render_mesh(shape: Shape | Surface, sides: int = 96) -> RenderMesh:
    """Return the triangles to draw a shape with; sides: how many a round one has about its axis."""
    match shape:
        case Sphere():
            return _revolve(_dome_profile(sides), sides, shape.pose, np.full(3, shape.radius))
        case Ellipsoid():
            return _revolve(_dome_profile(sides), sides, shape.pose, shape.radii)
        case Cylinder():
            scales = np.array([shape.radius, shape.radius, shape.half_length])
            return _revolve(_CYLINDER_PROFILE, sides, shape.pose, scales)
        case Capsule():
            dome = _dome_profile(sides)
            middle, straight = len(dome) // 2 + 1, np.array([0.0, shape.half_length / shape.radius, 0.0, 0.0])
            profile = np.concatenate([dome[:middle] - straight, dome[middle - 1 :] + straight])
            return _revolve(profile, sides, shape.pose, np.full(3, shape.radius))
        case Shape() | Surface():
            return RenderMesh(shape.vertices, shape.faces)
        case _:
            assert_never(shape)


def _dome_profile(sides: int) -> Floats:
    turn = np.linspace(-np.pi / 2, np.pi / 2, sides // 2 + 1)
    r, z = np.cos(turn), np.sin(turn)
    r[[0, -1]] = 0.0
    return np.column_stack([r, z, r, z])


def _revolve(profile: Floats, sides: int, pose: Pose, scales: Floats) -> RenderMesh:
    """The surface that a profile (k, 4) sweeps about Z, scaled along the axes, then posed."""
    turn = np.arange(sides) * (2 * np.pi / sides)
    circle = np.column_stack([np.cos(turn), np.sin(turn)])
    points, normals = np.empty((2, len(profile), sides, 3))
    for swept, rings in ((points, profile[:, :2]), (normals, profile[:, 2:])):  # each ring a radius and a height
        swept[..., :2], swept[..., 2] = rings[:, None, :1] * circle, rings[:, 1:]
    points, normals = points.reshape(-1, 3), normals.reshape(-1, 3)
    normals = normals / scales @ pose.rotation.T
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return RenderMesh(pose.apply(points * scales), _ring_faces(profile, sides), normals)


def _ring_faces(profile: Floats, sides: int) -> Ints:
    """Outward triangles between neighbouring rings; none between rings in one place, one a side at a pole."""
    here = np.arange(sides)
    there = (here + 1) % sides
    faces = []
    for k, (low, high) in enumerate(itertools.pairwise(profile)):
        a, b = k * sides, (k + 1) * sides
        if np.array_equal(low[:2], high[:2]):
            continue
        if low[0] > 0:
            faces.append(np.column_stack([a + here, a + there, b + there]))
        if high[0] > 0:
            faces.append(np.column_stack([a + here, b + there, b + here]))
    return np.concatenate(faces)


@dataclass(frozen=True, eq=False, slots=True)
class RayScene:
    """Triangles (m) with their item and normals, in a frame of unit size; embree: the ray caster.

    corners: (m, 3, 3); item: (m,); normals: (m, 3), outward; bent: at the corners (m, 3, 3), NaN where flat.
    """

    corners: Floats
    item: Ints
    normals: Floats
    bent: Floats
    embree: Any

    def smooth_normals(self, triangles: Ints, points: Floats) -> Floats:
        """Return the smooth normals at points (n, 3) of round triangles (n,)."""
        a, b, c = (self.corners[triangles, k] for k in range(3))
        normal = np.cross(b - a, c - a)
        area = np.einsum("ij,ij->i", normal, normal)
        second = np.einsum("ij,ij->i", np.cross(points - a, c - a), normal) / area
        third = np.einsum("ij,ij->i", np.cross(b - a, points - a), normal) / area
        mixed = np.einsum("ik,ikj->ij", np.stack([1 - second - third, second, third], axis=1), self.bent[triangles])
        smooth: Floats = mixed / np.linalg.norm(mixed, axis=1, keepdims=True)
        return smooth

    def depth(self, triangles: Ints, origins: Floats, directions: Floats) -> Floats:
        """Return how far along its ray each hit of a known triangle (n,) lies."""
        normals = self.normals[triangles]
        ahead = np.einsum("ij,ij->i", self.corners[triangles, 0] - origins, normals)
        facing = np.einsum("ij,ij->i", np.broadcast_to(directions, normals.shape), normals)
        depth: Floats = ahead / np.where(np.abs(facing) > 1e-12, facing, 1e-12)
        return depth


def build_scene(render_meshes: Sequence[RenderMesh], center: Floats, unit: float) -> RayScene:
    """Return the triangles of some render_meshes, moved so that `center` becomes the origin and `unit` [m] becomes one.

    No rays can meet them before `prepare_for_rays`.
    """
    item = np.repeat(np.arange(len(render_meshes)), [len(one.faces) for one in render_meshes])
    none = np.zeros((0, 3, 3))
    corners = np.concatenate([none, *(((one.vertices - center) / unit)[one.faces] for one in render_meshes)])
    bent = [np.full((len(m.faces), 3, 3), np.nan) if m.normals is None else m.normals[m.faces] for m in render_meshes]
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(cross, axis=1)
    solid = length > 1e-14
    corners, smooth, item = corners[solid], np.concatenate([none, *bent])[solid], item[solid]
    normals = cross[solid] / length[solid, None]
    return RayScene(corners, item, normals, smooth, None)


def prepare_for_rays(scene: RayScene, towards: Floats | None) -> RayScene:
    """Return the scene, ready for rays from one side; towards: (3,), of unit length.

    None makes it ready for all sides: things in one place then differ a little in size, not in depth.
    Raises MeshForgeError where embreex, which casts the rays, is not installed: it has no wheel for Linux on ARM.
    """
    try:
        from embreex.mesh_construction import TriangleMesh  # lazy: only pictures need it
        from embreex.rtcore_scene import EmbreeScene  # lazy: only pictures need it
    except ImportError as error:
        remedy = "There is no wheel of embreex for Linux on ARM: build it, or draw elsewhere. All but pictures works."
        raise MeshForgeError("pictures need embreex, which is not installed", remedy=remedy) from error

    away: Any = towards
    if towards is None:
        count = np.maximum(np.bincount(scene.item), 1)
        sums = [np.bincount(scene.item, part) for part in scene.corners.mean(axis=1).T]
        away = scene.corners - (np.stack(sums, axis=1) / count[:, None])[scene.item][:, None]
    order = (scene.item % _BIAS_STEPS)[:, None, None]
    corners = scene.corners + order * (away * (_SWELL if towards is None else _BIAS))
    embree = EmbreeScene()
    if len(corners):
        TriangleMesh(embree, corners.astype(np.float32))
    return replace(scene, corners=corners, embree=embree)


def window_rays(camera: Camera, columns: Floats, rows: Floats, start: float) -> tuple[Floats32, Floats32]:
    """Return origins (n, 3) and directions (n, 3), or (1, 3) where all agree, of the rays through pixels.

    columns (w,) and rows (h,) give the n = h * w pixels of a window, by rows; start: of parallel rays, towards the eye.
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
