"""The `<geometry>` of collisions and visuals as convex shapes and non-convex pieces in the root frame."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from meshforge.common import AssetError, GeometryError, join_names
from meshforge.formats import collision_pieces, link_reader
from meshforge.formats.meshfile.surface import RawSurface, join_surfaces
from meshforge.formats.sdf.frames import is_true, read_floats, read_values, text_of
from meshforge.formats.xml import Element
from meshforge.geometry import Floats, Pose, convex_hull, hull_mesh

_UNIT = re.compile(rb"<unit\b[^>]*?\bmeter\s*=\s*[\"']\s*([0-9.eE+-]+)\s*[\"']")
_HEAD_BYTES = 100_000  # bytes within which a file says its unit
_MOST_POINTS = 10_000  # points of a polyline
NO_HULLS = {"heightmap": "a height map is no hull", "image": "an image is no hull", "empty": "it is empty"}
"""Elements of a `<geometry>` that are no shapes, and why."""


def read_polylines(lines: Sequence[Element], pose: Pose, where: str) -> collision_pieces.CollisionPiece:
    """Return outlines of points, drawn up to a height: a hull where there is one that is convex."""
    if len(lines) > 1:
        return collision_pieces.CollisionPiece(None, f"{len(lines)} polylines in one")
    corners = list(lines[0].each("point"))
    if len(corners) > _MOST_POINTS:
        raise AssetError(f"a polyline of {len(corners):,} points", where=f"{where}:{lines[0].line}")
    outline = np.array([read_values(point, 2, where) for point in corners]).reshape(-1, 2)
    height = float(read_floats(lines[0], "height", where, (1.0,))[0])
    try:
        ends = [np.column_stack([outline, np.full(len(outline), z)]) for z in (0.0, height)]
        hull = convex_hull(pose.apply(np.vstack(ends))) if len(outline) > 2 and height > 0 else None
    except GeometryError:
        hull = None
    if hull is None:
        return collision_pieces.CollisionPiece(None, "a polyline without volume")
    x, y = (outline - outline[0]).T
    volume = abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1))) / 2 * height
    if not np.isclose(volume, hull.volume, rtol=1e-6):
        return collision_pieces.CollisionPiece(None, "a polyline that is not convex")
    return collision_pieces.CollisionPiece(hull)


def read_submesh(mesh: Element) -> tuple[str, ...]:
    """Return the submesh that a `<mesh>` uses: its name, and `center` where it is moved; nothing for all."""
    submesh = mesh.first("submesh")
    name = text_of(submesh, "name")
    if not name or name == "__default__":
        return ()
    return (name, "center") if is_true(text_of(submesh, "center")) else (name,)


class SdfMeshes(link_reader.CollisionMeshes):
    """The mesh files of an SDF, of which elements use submeshes."""

    def select(self, surfaces: Sequence[RawSurface], part: tuple[str, ...]) -> Sequence[RawSurface]:
        """Return what a part of `read_submesh` stands for, in metres: Gazebo obeys the unit of a Collada file.

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


def hull_of(surfaces: Sequence[RawSurface], linear: Floats, offset: Floats) -> collision_pieces.CollisionPiece:
    """Return the convex hull of a mesh with `optimization="convex_hull"`, under x -> linear @ x + offset."""
    whole = join_surfaces(surfaces)
    try:
        hull, fill = hull_mesh(whole.vertices, whole.faces)
        return collision_pieces.CollisionPiece(hull.transform(linear, offset), fill=fill)
    except GeometryError as error:
        return collision_pieces.CollisionPiece(None, error.problem)


def collada_unit_of(mesh: Path) -> float:
    """Return the metres of the unit that a mesh file is in: as a Collada file says, 1 for all others."""
    if mesh.suffix.lower() != ".dae":
        return 1.0
    try:
        with mesh.open("rb") as stream:
            found = _UNIT.search(stream.read(_HEAD_BYTES))
        unit = float(found[1]) if found else 1.0
    except (OSError, ValueError):
        return 1.0
    return unit if 0 < unit < float("inf") else 1.0
