"""The collision of a prim as convex shapes and opaque pieces in the root frame, as engines take it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from meshforge.errors import GeometryError
from meshforge.formats.mesh_parts import MeshPart, mesh_parts, placed
from meshforge.formats.meshfile import FARTHEST
from meshforge.formats.usd.reading.stage import Scene, rotation_of
from meshforge.formats.usd.reading.triangles import mesh_of
from meshforge.geometry import Box, Capsule, Cylinder, Floats, Pose, Shape, Sphere, convex_hull, pieces

_FLAT = 1e-12  # of the largest stretch of a map; below, it is a projection
_LEAST = 1e-100  # of any stretch; below, its square is zero
_SHEAR = 1e-6
_RING = 32  # corners of each end of a cone or a tapered cylinder
_TO_Z = {
    "X": np.array([[0.0, 0, 1], [0, 1, 0], [-1, 0, 0]]),
    "Y": np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]]),
    "Z": np.eye(3),
}
"""Rotations that take Z to the axis of a prim's shape."""
WHOLE = ("convexHull", "boundingCube", "boundingSphere")
"""The approximations that make one shape of a mesh, whatever its pieces."""


def parts_of(scene: Scene, prim: Any, notes: list[str]) -> list[MeshPart]:
    """What a prim collides with; notes: gets what a user should know of how it was read."""
    linear, offset = scene.placement(prim)
    if not _is_regular(linear, offset):
        return [MeshPart(None, "it is scaled to nothing, or out of all bounds")]
    kind = str(prim.GetTypeName())
    if kind == "Mesh":
        return _of_mesh(scene, prim, linear, offset)
    if kind == "Plane":
        return [MeshPart(None, "a plane has no end", plane=Pose(rotation_of(linear) @ _axis(scene, prim), offset))]
    return [_primitive(scene, prim, kind, linear, offset, notes)]


def _of_mesh(scene: Scene, prim: Any, linear: Floats, offset: Floats) -> list[MeshPart]:
    """A mesh as its approximation has it: one shape, or its pieces."""
    try:
        mesh = mesh_of(scene, prim)
        if len(mesh.faces) and np.abs(mesh.vertices[np.unique(mesh.faces)]).max() > FARTHEST:
            return [MeshPart(None, "its coordinates are out of all bounds")]
        how = approximation(scene, prim)
        if how in WHOLE and len(mesh.faces):
            return [_whole(how, mesh.vertices[np.unique(mesh.faces)], linear, offset)]
        found = pieces(mesh.vertices, mesh.faces, name=str(prim.GetPath()))
    except GeometryError as error:
        if "mesh" in locals() and len(mesh.faces):
            return [MeshPart(None, error.problem, placed(mesh.vertices, mesh.faces, linear, offset))]
        return [MeshPart(None, error.problem)]
    return mesh_parts(found, linear, offset)


def approximation(scene: Scene, prim: Any) -> str:
    """The token of a mesh's approximation, `none` where it says none."""
    return str(scene.get(prim.GetAttribute("physics:approximation")) or "none")


def _whole(how: str, points: Floats, linear: Floats, offset: Floats) -> MeshPart:
    """One shape around points (n, 3); bounding boxes and spheres as engines make them: about the box of the mesh."""
    low, high = points.min(axis=0), points.max(axis=0)
    middle, half = (low + high) / 2, (high - low) / 2
    if how == "convexHull" or half.min() <= 0:
        return MeshPart(convex_hull(points).transform(linear, offset))
    if how == "boundingCube":
        return MeshPart(Box(Pose.of_translation(middle), half).transform(linear, offset))
    radius = float(np.linalg.norm(points - middle, axis=1).max() * np.linalg.norm(linear, axis=0).max())
    return MeshPart(Sphere(Pose.of_translation(linear @ middle + offset), radius))


def _primitive(scene: Scene, prim: Any, kind: str, linear: Floats, offset: Floats, notes: list[str]) -> MeshPart:
    """A native shape; a round one that is scaled unevenly is what engines make of it."""
    scales = np.linalg.norm(linear, axis=0)
    turn = linear / scales
    if np.abs(turn.T @ turn - np.eye(3)).max() > _SHEAR:
        notes.append(f"{prim.GetPath()} is sheared: engines read it each in its own way, here it is a hull")
        shape = _described(scene, prim, kind, np.eye(3), np.zeros(3), np.ones(3))
        return shape if shape.shape is None else MeshPart(shape.shape.tessellate().transform(linear, offset))
    along = scales @ np.abs(_axis(scene, prim))  # of the shape's own axes
    across = scales if kind == "Sphere" else along[:2]
    if kind not in ("Cube",) and np.ptp(across) > _SHEAR * across.max():
        notes.append(f"{prim.GetPath()} is scaled unevenly: its radius counts by the largest factor, as in engines")
    return _described(scene, prim, kind, turn, offset, scales)


def _described(scene: Scene, prim: Any, kind: str, turn: Floats, offset: Floats, scales: Floats) -> MeshPart:
    """A shape of a prim's own sizes times scales (3,), turned or mirrored and put in its place."""

    def size(name: str) -> float:
        return float(scene.get(prim.GetAttribute(name)) or 0.0)

    axis = _axis(scene, prim)
    wide, long = scales @ np.abs(axis)[:, :2], float(scales @ np.abs(axis)[:, 2])
    pose = Pose(_proper(turn @ axis), offset)
    match kind:
        case "Cube":
            sides = size("size") * scales
            return _solid(kind, sides, lambda: Box(Pose(_proper(turn), offset), sides / 2))
        case "Sphere":
            radius = size("radius") * float(scales.max())
            return _solid(kind, [radius], lambda: Sphere(pose, radius))
        case "Capsule" | "Cylinder" | "Cone" | "Capsule_1" | "Cylinder_1":
            return _round(kind, pose, _radii(kind, size) * float(wide.max()), size("height") * long / 2)
    return MeshPart(None, f"a collider of type {kind or 'none'} is not known")


def _radii(kind: str, size: Any) -> Floats:
    """The radii (2,) of the bottom and the top of a round shape."""
    if kind.endswith("_1"):
        return np.array([size("radiusBottom"), size("radiusTop")])
    return np.array([size("radius"), 0.0 if kind == "Cone" else size("radius")])


def _round(kind: str, pose: Pose, radii: Floats, half: float) -> MeshPart:
    """A cylinder, capsule or cone about Z of a pose; half: of its height [m]."""
    capsule, (bottom, top) = kind.startswith("Capsule"), radii
    sizes = [float(radii.max()), 2 * half]
    if capsule and bottom == top and half <= 1e-9 * bottom:
        return _solid("sphere", sizes[:1], lambda: Sphere(pose, float(bottom)))
    if bottom == top:
        make = Capsule if capsule else Cylinder
        return _solid(kind, sizes, lambda: make(pose, float(bottom), half))
    if radii.min() < 0:
        return MeshPart(None, f"a {kind} of negative radius")
    ends = np.concatenate([_end(bottom, -half, capsule), _end(top, half, capsule)])
    return _solid(kind, sizes, lambda: convex_hull(pose.apply(ends)))


def _end(radius: float, height: float, ball: bool) -> Floats:
    """Points (n, 3) of the disk or ball at a height."""
    if radius == 0:
        return np.array([[0.0, 0.0, height]])
    if ball:
        return np.asarray(Sphere(Pose.of_translation([0.0, 0.0, height]), radius).vertices)
    angles = np.arange(_RING) * (2 * np.pi / _RING)
    return np.column_stack([radius * np.cos(angles), radius * np.sin(angles), np.full(_RING, height)])


def _solid(kind: str, sizes: Sequence[float] | Floats, make: Any) -> MeshPart:
    """The shape that `make` makes, unless it has no volume."""
    if not np.isfinite(sizes).all() or min(sizes) <= 0:
        return MeshPart(None, f"a {kind.lower()} without volume: {', '.join(f'{s:g}' for s in sizes)} m")
    try:
        shape: Shape = make()
    except GeometryError as error:
        return MeshPart(None, error.problem)
    return MeshPart(shape)


def _axis(scene: Scene, prim: Any) -> Floats:
    """The rotation (3, 3) that takes Z to the axis that a prim says."""
    return _TO_Z.get(str(scene.get(prim.GetAttribute("axis")) or "Z"), _TO_Z["Z"])


def _proper(turn: Floats) -> Floats:
    """A rotation (3, 3) that takes shapes about Z to where a rotation, or a reflection, takes them."""
    nearly: Floats = turn * np.array([np.sign(np.linalg.det(turn)), 1.0, 1.0])
    left, _, right = np.linalg.svd(nearly)
    return np.asarray(left @ right)


def _is_regular(linear: Floats, offset: Floats) -> bool:
    """Whether a map leaves volume, and is made of numbers within bounds."""
    if not (np.isfinite(linear).all() and np.isfinite(offset).all()):
        return False
    stretch = np.linalg.svd(linear, compute_uv=False)
    return bool(stretch[-1] > max(_FLAT * stretch[0], _LEAST) and np.abs(offset).max() <= FARTHEST)
