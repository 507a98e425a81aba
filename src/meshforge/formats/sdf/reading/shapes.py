"""A `<geometry>` of an SDF as convex shapes and opaque pieces in the root frame."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from meshforge.errors import AssetError, GeometryError
from meshforge.formats.mesh_parts import MeshPart, facing
from meshforge.formats.meshfile import RawSurface
from meshforge.formats.sdf.files.values import floats, is_true, text_of, values
from meshforge.formats.xml import Element, shown
from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Floats, Pose, Shape, Sphere, convex_hull
from meshforge.words import listed

_LEAST = 1e-12  # a factor that is taken for zero
_AROUND = 32  # corners of the base of a cone
_MOST = 10_000  # points of a polyline
_PLAIN = {"heightmap": "a height map is no hull", "image": "an image is no hull", "empty": "it is empty"}


def primitive(kind: Element, pose: Pose, where: str) -> MeshPart:
    """The shape of an element that is no mesh; pose: root_T_geometry. What is left out has libsdformat's default.

    Raises AssetError with `where:line` for an unreadable number.
    """
    match kind.tag:
        case "box":
            extent = floats(kind, "size", where, (1.0, 1.0, 1.0))
            shape: Shape = Box(pose, extent / 2)
        case "ellipsoid":
            extent = floats(kind, "radii", where, (1.0, 1.0, 1.0))
            shape = Ellipsoid(pose, extent)
        case "sphere":
            extent = floats(kind, "radius", where, (1.0,))
            shape = Sphere(pose, float(extent[0]))
        case "cylinder" | "capsule" | "cone":
            radius = floats(kind, "radius", where, (1.0 if kind.tag == "cylinder" else 0.5,))
            extent = np.concatenate([radius, floats(kind, "length", where, (1.0,))])
            if kind.tag == "cone":
                return _cone(pose, *extent.tolist())
            make = Cylinder if kind.tag == "cylinder" else Capsule
            shape = make(pose, float(extent[0]), float(extent[1]) / 2)
        case "plane":
            return MeshPart(None, "a plane has no end", plane=pose @ facing(floats(kind, "normal", where, (0, 0, 1))))
        case _:
            return MeshPart(None, _PLAIN.get(kind.tag, f"<{kind.tag}> is no geometry that is known"))
    if extent.min() <= 0 or shape.volume == 0:
        return MeshPart(None, f"a {kind.tag} without volume: {shown(extent)} m")
    return MeshPart(shape)


def _cone(pose: Pose, radius: float, length: float) -> MeshPart:
    """A cone about Z, its tip up, centred at half its height, as a hull of as many sides as a cylinder has."""
    if radius <= 0 or length <= 0:
        return MeshPart(None, f"a cone without volume: {shown((radius, length))} m")
    turn = np.arange(_AROUND) * (2 * np.pi / _AROUND)
    ring = np.column_stack([radius * np.cos(turn), radius * np.sin(turn), np.full(_AROUND, -length / 2)])
    return _hull(np.vstack([ring, [0, 0, length / 2]]), pose, "a cone without volume")


def polylines(geometry: Element, pose: Pose, where: str) -> MeshPart:
    """The `<polyline>` elements of a geometry: outlines of points, drawn up to a height; a hull where that is convex.

    Raises AssetError with `where:line` for an unreadable number.
    """
    lines = list(geometry.each("polyline"))
    if len(lines) > 1:
        return MeshPart(None, f"{len(lines)} polylines in one")
    corners = list(lines[0].each("point"))
    if len(corners) > _MOST:
        raise AssetError(f"a polyline of {len(corners):,} points", where=f"{where}:{lines[0].line}")
    outline = np.array([values(point, 2, where) for point in corners]).reshape(-1, 2)
    height = float(floats(lines[0], "height", where, (1.0,))[0])
    if len(outline) < 3 or height <= 0:
        return MeshPart(None, "a polyline without volume")
    if not _is_convex(outline):
        return MeshPart(None, "a polyline that is not convex")
    ends = [np.column_stack([outline, np.full(len(outline), z)]) for z in (0.0, height)]
    return _hull(np.vstack(ends), pose, "a polyline without volume")


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


def _hull(points: Floats, pose: Pose, reason: str) -> MeshPart:
    try:
        return MeshPart(convex_hull(pose.apply(points)))
    except GeometryError:
        return MeshPart(None, reason)


def mesh_scale(mesh: Element, where: str, label: str) -> Floats:
    """The factors (3,) by which a `<mesh>` is scaled. Raises AssetError naming `label`: a factor is zero."""
    scale = floats(mesh, "scale", where, (1.0, 1.0, 1.0))
    if np.abs(scale).min() < _LEAST:
        raise AssetError(
            f"collision {label!r} is scaled to nothing: <scale>{text_of(mesh, 'scale')}</scale>",
            where=f"{where}:{mesh.line}",
            remedy="Give every axis a factor that is not zero.",
        )
    return scale


def mesh_part(mesh: Element) -> tuple[str, ...]:
    """What of its file a `<mesh>` uses: nothing for all, else the name of a submesh, and `center` where it is moved."""
    submesh = mesh.first("submesh")
    name = text_of(submesh, "name")
    if not name or name == "__default__":
        return ()
    return (name, "center") if is_true(text_of(submesh, "center")) else (name,)


def chosen(surfaces: Sequence[RawSurface], part: tuple[str, ...]) -> Sequence[RawSurface]:
    """What a part of `mesh_part` stands for, in metres: Gazebo obeys the unit of a Collada file.

    Raises AssetError: there is no such submesh.
    """
    found = [s for s in surfaces if not part or s.name == part[0]]
    if not found:
        names = [s.name for s in surfaces if s.name]
        remedy = f"Its submeshes are {listed(names, 5)}." if names else "None of its submeshes has a name."
        raise AssetError(f"the mesh has no submesh {part[0]!r}", remedy=remedy)
    scaled = [replace(s, vertices=s.vertices * s.unit, unit=1.0) if s.unit != 1.0 else s for s in found]
    if "center" not in part[1:]:
        return scaled
    used = np.concatenate([s.vertices[np.unique(s.faces)] for s in scaled])
    middle = (used.min(axis=0) + used.max(axis=0)) / 2
    return [replace(s, vertices=s.vertices - middle) for s in scaled]


def hull_of(surfaces: Sequence[RawSurface], linear: Floats, offset: Floats) -> MeshPart:
    """The convex hull of a mesh that says it is one (`optimization="convex_hull"`), under x -> linear @ x + offset."""
    points = np.concatenate([s.vertices[np.unique(s.faces)] for s in surfaces])
    try:
        return MeshPart(convex_hull(points @ linear.T + offset))
    except GeometryError as error:
        return MeshPart(None, error.problem)
