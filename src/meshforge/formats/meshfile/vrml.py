"""Reading VRML 2.0, which CoACD and MeshLab write: a surface for each shape, its transforms applied."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import numpy as np

from meshforge.errors import AssetError
from meshforge.formats.meshfile.surface import RawSurface, checked, fans
from meshforge.formats.meshfile.vrml_nodes import Node, parse_nodes
from meshforge.geometry import Floats

_SOLIDS = {"Box", "Sphere", "Cylinder", "Cone", "Extrusion", "ElevationGrid"}
_PARENTS = {"Group", "Transform", "Anchor", "Collision", "Billboard", "Switch", "LOD"}
_MOST = 100_000  # nodes; USE in USE multiplies them without end


def parse_vrml(data: bytes, where: str) -> list[RawSurface]:
    """The surfaces of a VRML 2.0 file. Raises AssetError: not such a file, or shapes that are no face sets."""
    found: list[RawSurface] = []
    steps = itertools.count()
    try:
        for node in parse_nodes(data.decode("utf-8-sig", "replace"), where):
            _walk(node, np.eye(4), None, found, steps, where)
    except ValueError as error:
        raise AssetError(str(error), where=where, remedy="Export it as OBJ.") from error
    return checked(found, where)


def _walk(
    node: Node, world: Floats, name: str | None, found: list[RawSurface], steps: Iterator[int], where: str
) -> None:
    if next(steps) > _MOST:
        raise AssetError(f"it has more than {_MOST:,} nodes, most by USE", where=where, remedy="Export it as OBJ.")
    name = node.name or name
    if node.type == "Shape":
        for geometry in node.nodes("geometry"):
            found += _surface(geometry, world, node.name or name, where)
    if node.type in _PARENTS:
        world = world @ _transform(node) if node.type == "Transform" else world
        for key in ("children", "choice", "level"):
            for child in node.nodes(key):
                _walk(child, world, name, found, steps, where)


def _surface(node: Node, world: Floats, name: str | None, where: str) -> list[RawSurface]:
    if node.type in _SOLIDS:
        raise AssetError(f"shapes of kind {node.type} are not read", where=where, remedy="Export it as OBJ.")
    coordinates = node.nodes("coord")
    if node.type != "IndexedFaceSet" or not coordinates:
        return []
    numbers = coordinates[0].numbers("point")
    if len(numbers) % 3:
        raise AssetError("its points are not all of three numbers", where=where)
    if not np.isfinite(numbers).all():
        raise AssetError("a coordinate is not a finite number", where=where, remedy="Mend or export it again.")
    points = np.array(numbers, dtype=np.float64).reshape(-1, 3) @ world[:3, :3].T + world[:3, 3]
    indices = node.numbers("coordIndex")
    if not all(x.is_integer() for x in indices):
        raise AssetError("a face names a vertex by a number that is not whole", where=where)
    if not all(-1 <= x < len(points) for x in indices):
        raise AssetError(f"a face names a vertex that is not there, there are {len(points)}", where=where)
    faces = fans(_polygons([int(x) for x in indices]))
    return [RawSurface(name, points, faces[:, ::-1] if node.word("ccw") == "FALSE" else faces)]


def _polygons(indices: list[int]) -> list[list[int]]:
    """The polygons of indices that -1 parts."""
    polygons: list[list[int]] = [[]]
    for index in indices:
        if index == -1:
            polygons.append([])
        else:
            polygons[-1].append(index)
    return polygons


def _transform(node: Node) -> Floats:
    """The matrix of a Transform: translation, center, rotation, scale orientation, scale."""
    move = _moved(node.vector("translation", 3))
    center = node.vector("center", 3)
    turn = _turned(node.vector("rotation", 4))
    lean = _turned(node.vector("scaleOrientation", 4))
    scale = np.diag([*(node.vector("scale", 3) or [1.0, 1.0, 1.0]), 1.0])
    back = _moved([-x for x in center])
    with np.errstate(over="ignore", invalid="ignore"):  # vertices that are not finite are refused
        return move @ _moved(center) @ turn @ lean @ scale @ lean.T @ back


def _moved(offset: list[float]) -> Floats:
    matrix = np.eye(4)
    matrix[:3, 3] = offset or 0.0
    return matrix


def _turned(rotation: list[float]) -> Floats:
    """The matrix of a rotation given by axis and angle [rad]."""
    matrix = np.eye(4)
    if rotation:
        x, y, z = np.array(rotation[:3]) / max(float(np.linalg.norm(rotation[:3])), 1e-300)
        cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        matrix[:3, :3] += np.sin(rotation[3]) * cross + (1 - np.cos(rotation[3])) * cross @ cross
    return matrix
