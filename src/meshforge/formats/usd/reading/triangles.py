"""The triangles of a Mesh prim, as authored: polygons cut into fans, left-handed ones turned round."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshforge.errors import GeometryError
from meshforge.formats.meshfile import RawSurface
from meshforge.formats.usd.reading.stage import Scene
from meshforge.geometry import Ints


def mesh_of(scene: Scene, prim: Any) -> RawSurface:
    """The surface of a Mesh prim in its own space; subdivision is not applied, as in engines.

    Raises GeometryError: its counts and indices do not fit together, or a coordinate is not finite.
    """
    from pxr import UsdGeom

    mesh = UsdGeom.Mesh(prim)
    points = np.asarray(scene.get(mesh.GetPointsAttr()) or [], dtype=np.float64).reshape(-1, 3)
    corners = np.asarray(scene.get(mesh.GetFaceVertexIndicesAttr()) or [], dtype=np.int64)
    counts = np.asarray(scene.get(mesh.GetFaceVertexCountsAttr()) or [], dtype=np.int64)
    faces = triangles(corners, counts, np.asarray(scene.get(mesh.GetHoleIndicesAttr()) or [], dtype=np.int64))
    where = str(prim.GetPath())
    if len(faces) and (faces.min() < 0 or faces.max() >= len(points)):
        raise GeometryError("a face names a vertex that is not there", where=where)
    if not np.isfinite(points[np.unique(faces)]).all():
        raise GeometryError("a coordinate is not a finite number", where=where)
    if scene.get(mesh.GetOrientationAttr()) == UsdGeom.Tokens.leftHanded:
        faces = faces[:, ::-1]
    return RawSurface(None, points, faces)


def triangles(corners: Ints, counts: Ints, holes: Ints) -> Ints:
    """The triangles (m, 3) of polygons of so many corners each, without those that are holes.

    Raises GeometryError: there are more or fewer corners than the counts say.
    """
    if (counts < 0).any() or counts.sum() != len(corners):
        raise GeometryError(f"its faces count {int(counts.sum())} corners, it has {len(corners)}")
    solid = np.maximum(counts - 2, 0)
    solid[holes[(holes >= 0) & (holes < len(counts))]] = 0
    first = np.repeat(np.cumsum(counts) - counts, solid)
    step = np.arange(solid.sum()) - np.repeat(np.cumsum(solid) - solid, solid)
    return np.stack([corners[first], corners[first + step + 1], corners[first + step + 2]], axis=1)
