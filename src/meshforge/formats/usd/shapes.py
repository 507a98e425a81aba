"""The collision of a prim as convex shapes and non-convex pieces in the root frame, as engines take it."""

from typing import Any

import numpy as np

from meshforge.common import GeometryError
from meshforge.formats.collision_pieces import CollisionPiece, build_round, build_solid, place_pieces, place_surface
from meshforge.formats.libraries import pxr
from meshforge.formats.meshfile.surface import FARTHEST, RawSurface, cut_fans
from meshforge.formats.usd.stage import UsdStage, rotation_of
from meshforge.geometry import Box, Floats, Pose, Sphere, hull_mesh, split_pieces

_FLAT = 1e-12  # of the largest stretch of a map; below, it is a projection
_LEAST = 1e-100  # of any stretch; below, its square is zero
_SHEAR = 1e-6
_TO_Z = {
    "X": np.array([[0.0, 0, 1], [0, 1, 0], [-1, 0, 0]]),
    "Y": np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]]),
    "Z": np.eye(3),
}
"""Rotations that take Z to the axis of a prim's shape."""
_WHOLE = ("convexHull", "boundingCube", "boundingSphere")
"""The approximations that make one shape of a mesh, whatever its pieces."""


def read_parts(scene: UsdStage, prim: Any, notes: list[str]) -> list[CollisionPiece]:
    """Return what a prim collides with; notes: gets what a user should know of how it was read."""
    linear, offset = scene.placement(prim)
    if not _is_regular(linear, offset):
        return [CollisionPiece(None, "it is scaled to nothing, or out of all bounds")]
    kind = str(prim.GetTypeName())
    if kind == "Mesh":
        return _parts_of_mesh(scene, prim, linear, offset)
    if kind == "Plane":
        plane = Pose(rotation_of(linear) @ _axis_rotation(scene, prim), offset)
        return [CollisionPiece(None, "a plane has no end", plane=plane)]
    return [_read_primitive(scene, prim, kind, linear, offset, notes)]


def _parts_of_mesh(scene: UsdStage, prim: Any, linear: Floats, offset: Floats) -> list[CollisionPiece]:
    mesh = None
    try:
        mesh = read_mesh(scene, prim)
        if len(mesh.faces) and np.abs(mesh.vertices[np.unique(mesh.faces)]).max() > FARTHEST:
            return [CollisionPiece(None, "its coordinates are out of all bounds")]
        how = str(scene.get(prim.GetAttribute("physics:approximation")) or "none")
        if how in _WHOLE and len(mesh.faces):
            return [_build_whole(how, mesh, linear, offset)]
        return place_pieces(split_pieces(mesh.vertices, mesh.faces, name=str(prim.GetPath())), linear, offset)
    except GeometryError as error:
        surface = place_surface(mesh.vertices, mesh.faces, linear, offset) if mesh and len(mesh.faces) else None
        return [CollisionPiece(None, error.problem, surface)]


def _build_whole(how: str, mesh: RawSurface, linear: Floats, offset: Floats) -> CollisionPiece:
    """One shape around a mesh; bounding boxes and spheres as engines make them: about the box of the mesh."""
    points = mesh.vertices[np.unique(mesh.faces)]
    low, high = points.min(axis=0), points.max(axis=0)
    middle, half = (low + high) / 2, (high - low) / 2
    if how == "convexHull" or half.min() <= 0:
        hull, fill = hull_mesh(mesh.vertices, mesh.faces)
        return CollisionPiece(hull.transform(linear, offset), fill=fill)
    if how == "boundingCube":
        return CollisionPiece(Box(Pose.of_translation(middle), half).transform(linear, offset))
    radius = float(np.linalg.norm(points - middle, axis=1).max() * np.linalg.norm(linear, axis=0).max())
    return CollisionPiece(Sphere(Pose.of_translation(linear @ middle + offset), radius))


def _read_primitive(
    scene: UsdStage, prim: Any, kind: str, linear: Floats, offset: Floats, notes: list[str]
) -> CollisionPiece:
    """A native shape; a round one that is scaled unevenly is what engines make of it."""
    scales = np.linalg.norm(linear, axis=0)
    turn = linear / scales
    if np.abs(turn.T @ turn - np.eye(3)).max() > _SHEAR:
        notes.append(f"{prim.GetPath()} is sheared: engines read it each in its own way, here it is a hull")
        shape = _build_primitive(scene, prim, kind, np.eye(3), np.zeros(3), np.ones(3))
        return shape if shape.shape is None else CollisionPiece(shape.shape.tessellate().transform(linear, offset))
    along = scales @ np.abs(_axis_rotation(scene, prim))  # of the shape's own axes
    across = scales if kind == "Sphere" else along[:2]
    if kind not in ("Cube",) and np.ptp(across) > _SHEAR * across.max():
        notes.append(f"{prim.GetPath()} is scaled unevenly: its radius counts by the largest factor, as in engines")
    return _build_primitive(scene, prim, kind, turn, offset, scales)


def _build_primitive(
    scene: UsdStage, prim: Any, kind: str, turn: Floats, offset: Floats, scales: Floats
) -> CollisionPiece:
    """A shape of a prim's own sizes times scales (3,), turned or mirrored and put in its place."""

    def size(name: str) -> float:
        return float(scene.get(prim.GetAttribute(name)) or 0.0)

    axis = _axis_rotation(scene, prim)
    wide, long = scales @ np.abs(axis)[:, :2], float(scales @ np.abs(axis)[:, 2])
    pose = Pose(_proper_rotation(turn @ axis), offset)
    match kind:
        case "Cube":
            sides = size("size") * scales
            return build_solid(kind, sides, lambda: Box(Pose(_proper_rotation(turn), offset), sides / 2))
        case "Sphere":
            radius = size("radius") * float(scales.max())
            return build_solid(kind, [radius], lambda: Sphere(pose, radius))
        case "Capsule" | "Cylinder" | "Cone":
            bottom, top = size("radius"), 0.0 if kind == "Cone" else size("radius")
        case "Capsule_1" | "Cylinder_1":
            bottom, top = size("radiusBottom"), size("radiusTop")
        case _:
            return CollisionPiece(None, f"a collider of type {kind or 'none'} is not known")
    widest = float(wide.max())
    return build_round(kind, pose, bottom * widest, top * widest, size("height") * long / 2)


def _axis_rotation(scene: UsdStage, prim: Any) -> Floats:
    return _TO_Z.get(str(scene.get(prim.GetAttribute("axis")) or "Z"), _TO_Z["Z"])


def _proper_rotation(turn: Floats) -> Floats:
    """A rotation (3, 3) that takes shapes about Z to where a rotation, or a reflection, takes them."""
    return rotation_of(turn * np.array([np.sign(np.linalg.det(turn)), 1.0, 1.0]))


def _is_regular(linear: Floats, offset: Floats) -> bool:
    if not (np.isfinite(linear).all() and np.isfinite(offset).all()):
        return False
    stretch = np.linalg.svd(linear, compute_uv=False)
    return bool(stretch[-1] > max(_FLAT * stretch[0], _LEAST) and np.abs(offset).max() <= FARTHEST)


def read_mesh(scene: UsdStage, prim: Any) -> RawSurface:
    """Return the surface of a Mesh prim in its own space; subdivision is not applied, as in engines.

    Raises GeometryError: its counts and indices do not fit together, or a coordinate is not finite.
    """
    mesh = pxr.UsdGeom.Mesh(prim)
    points = np.asarray(scene.get(mesh.GetPointsAttr()) or [], dtype=np.float64).reshape(-1, 3)
    corners = np.asarray(scene.get(mesh.GetFaceVertexIndicesAttr()) or [], dtype=np.int64)
    counts = np.asarray(scene.get(mesh.GetFaceVertexCountsAttr()) or [], dtype=np.int64)
    if (counts < 0).any() or counts.sum() != len(corners):
        raise GeometryError(f"its faces count {int(counts.sum())} corners, it has {len(corners)}")
    polygon, faces = cut_fans(corners, counts)
    faces = faces[~np.isin(polygon, np.asarray(scene.get(mesh.GetHoleIndicesAttr()) or [], dtype=np.int64))]
    where = str(prim.GetPath())
    if len(faces) and (faces.min() < 0 or faces.max() >= len(points)):
        raise GeometryError("a face names a vertex that is not there", where=where)
    if not np.isfinite(points[np.unique(faces)]).all():
        raise GeometryError("a coordinate is not a finite number", where=where)
    if scene.get(mesh.GetOrientationAttr()) == pxr.UsdGeom.Tokens.leftHanded:
        faces = faces[:, ::-1]
    return RawSurface(None, points, faces)
