"""The `<geometry>` of collisions and visuals as convex shapes and non-convex pieces in the root frame."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from meshforge.common import AssetError, GeometryError, join_names
from meshforge.formats.collision_pieces import (
    CollisionMeshes,
    CollisionPiece,
    MeshUse,
    place_pieces,
    refuse_zero_scale,
    turn_z_to,
)
from meshforge.formats.meshfile.surface import RawSurface, join_surfaces
from meshforge.formats.sdf import document, models
from meshforge.formats.sdf.frames import is_true, read_floats, read_values, text_of
from meshforge.formats.xml import Element, format_numbers
from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Floats, Pose, Shape, Sphere, convex_hull, hull_mesh

_AROUND = 32  # corners of the base of a cone
_MOST_POINTS = 10_000  # points of a polyline
_NO_HULLS = {"heightmap": "a height map is no hull", "image": "an image is no hull", "empty": "it is empty"}


def read_primitive(kind: Element, pose: Pose, where: str) -> CollisionPiece:
    """The shape of an element that is no mesh; pose: root_T_geometry. What is left out has libsdformat's default.

    Raises AssetError with `where:line` for an unreadable number.
    """
    match kind.tag:
        case "box":
            extent = read_floats(kind, "size", where, (1.0, 1.0, 1.0))
            shape: Shape = Box(pose, extent / 2)
        case "ellipsoid":
            extent = read_floats(kind, "radii", where, (1.0, 1.0, 1.0))
            shape = Ellipsoid(pose, extent)
        case "sphere":
            extent = read_floats(kind, "radius", where, (1.0,))
            shape = Sphere(pose, float(extent[0]))
        case "cylinder" | "capsule" | "cone":
            radius = read_floats(kind, "radius", where, (1.0 if kind.tag == "cylinder" else 0.5,))
            extent = np.concatenate([radius, read_floats(kind, "length", where, (1.0,))])
            if kind.tag == "cone":
                return _build_cone(pose, *extent.tolist())
            make = Cylinder if kind.tag == "cylinder" else Capsule
            shape = make(pose, float(extent[0]), float(extent[1]) / 2)
        case "plane":
            return CollisionPiece(
                None, "a plane has no end", plane=pose @ turn_z_to(read_floats(kind, "normal", where, (0, 0, 1)))
            )
        case _:
            return CollisionPiece(None, _NO_HULLS.get(kind.tag, f"<{kind.tag}> is no geometry that is known"))
    if extent.min() <= 0 or shape.volume == 0:
        return CollisionPiece(None, f"a {kind.tag} without volume: {format_numbers(extent)} m")
    return CollisionPiece(shape)


def _build_cone(pose: Pose, radius: float, length: float) -> CollisionPiece:
    """A cone about Z, its tip up, centred at half its height, as a hull of as many sides as a cylinder has."""
    if radius <= 0 or length <= 0:
        return CollisionPiece(None, f"a cone without volume: {format_numbers((radius, length))} m")
    turn = np.arange(_AROUND) * (2 * np.pi / _AROUND)
    ring = np.column_stack([radius * np.cos(turn), radius * np.sin(turn), np.full(_AROUND, -length / 2)])
    return _hull_part(np.vstack([ring, [0, 0, length / 2]]), pose, "a cone without volume")


def read_polylines(geometry: Element, pose: Pose, where: str) -> CollisionPiece:
    """The `<polyline>` elements of a geometry: outlines of points, drawn up to a height; a hull where that is convex.

    Raises AssetError with `where:line` for an unreadable number.
    """
    lines = list(geometry.each("polyline"))
    if len(lines) > 1:
        return CollisionPiece(None, f"{len(lines)} polylines in one")
    corners = list(lines[0].each("point"))
    if len(corners) > _MOST_POINTS:
        raise AssetError(f"a polyline of {len(corners):,} points", where=f"{where}:{lines[0].line}")
    outline = np.array([read_values(point, 2, where) for point in corners]).reshape(-1, 2)
    height = float(read_floats(lines[0], "height", where, (1.0,))[0])
    if len(outline) < 3 or height <= 0:
        return CollisionPiece(None, "a polyline without volume")
    if not _is_convex(outline):
        return CollisionPiece(None, "a polyline that is not convex")
    ends = [np.column_stack([outline, np.full(len(outline), z)]) for z in (0.0, height)]
    return _hull_part(np.vstack(ends), pose, "a polyline without volume")


def _is_convex(outline: Floats) -> bool:
    """Whether an outline (n, 2), closed or not, turns one way only, and just once round."""
    steps = np.roll(outline, -1, axis=0) - outline
    steps = steps[np.abs(steps).max(axis=1) > 0]
    if len(steps) < 3:
        return False
    after = np.roll(steps, -1, axis=0)
    turns = np.arctan2(steps[:, 0] * after[:, 1] - steps[:, 1] * after[:, 0], (steps * after).sum(axis=1))
    one_way = bool((turns > -1e-9).all() or (turns < 1e-9).all())
    return one_way and abs(abs(float(turns.sum())) - 2 * np.pi) < 1e-6


def _hull_part(points: Floats, pose: Pose, reason: str) -> CollisionPiece:
    try:
        return CollisionPiece(convex_hull(pose.apply(points)))
    except GeometryError:
        return CollisionPiece(None, reason)


def read_mesh_scale(mesh: Element, where: str, label: str) -> Floats:
    """The factors (3,) by which a `<mesh>` is scaled. Raises AssetError naming `label`: a factor is zero."""
    scale = read_floats(mesh, "scale", where, (1.0, 1.0, 1.0))
    given = f"<scale>{text_of(mesh, 'scale')}</scale>"
    refuse_zero_scale(scale, label, given, f"{where}:{mesh.line}")
    return scale


def read_submesh(mesh: Element) -> tuple[str, ...]:
    """What of its file a `<mesh>` uses: nothing for all, else the name of a submesh, and `center` where it is moved."""
    submesh = mesh.first("submesh")
    name = text_of(submesh, "name")
    if not name or name == "__default__":
        return ()
    return (name, "center") if is_true(text_of(submesh, "center")) else (name,)


def select_submesh(surfaces: Sequence[RawSurface], part: tuple[str, ...]) -> Sequence[RawSurface]:
    """What a part of `read_submesh` stands for, in metres: Gazebo obeys the unit of a Collada file.

    Raises AssetError: there is no such submesh.
    """
    found = [s for s in surfaces if not part or s.name == part[0]]
    if not found:
        names = [s.name for s in surfaces if s.name]
        remedy = f"Its submeshes are {join_names(names, 5)}." if names else "None of its submeshes has a name."
        raise AssetError(f"the mesh has no submesh {part[0]!r}", remedy=remedy)
    scaled = [replace(s, vertices=s.vertices * s.unit, unit=1.0) if s.unit != 1.0 else s for s in found]
    if "center" not in part[1:]:
        return scaled
    used = np.concatenate([s.vertices[np.unique(s.faces)] for s in scaled])
    middle = (used.min(axis=0) + used.max(axis=0)) / 2
    return [replace(s, vertices=s.vertices - middle) for s in scaled]


def hull_of(surfaces: Sequence[RawSurface], linear: Floats, offset: Floats) -> CollisionPiece:
    """The convex hull of a mesh that says it is one (`optimization="convex_hull"`), under x -> linear @ x + offset."""
    whole = join_surfaces(surfaces)
    try:
        hull, fill = hull_mesh(whole.vertices, whole.faces)
        return CollisionPiece(hull.transform(linear, offset), fill=fill)
    except GeometryError as error:
        return CollisionPiece(None, error.problem)


def read_parts(collision: models.SdfCollision, use: MeshUse | None, meshes: CollisionMeshes) -> list[CollisionPiece]:
    """The pieces of a collision, in the root frame; none where it has no geometry."""
    kind, pose, where = document.geometry_of(collision.element), collision.pose, collision.link.scope.where
    if kind is None:
        return []
    if use is not None:
        linear = pose.rotation * read_mesh_scale(kind, where, use.label)
        if kind.attributes.get("optimization") == "convex_hull":
            return [hull_of(meshes.surfaces(use), linear, pose.translation)]
        return place_pieces(meshes.pieces(use), linear, pose.translation, meshes.surfaces(use))
    geometry = collision.element.first("geometry")
    assert geometry is not None  # it holds the kind
    return [read_polylines(geometry, pose, where) if kind.tag == "polyline" else read_primitive(kind, pose, where)]
