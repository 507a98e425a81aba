"""Exact distances between convex shapes, by coal, behind a sweep over AABBs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import coal
import numpy as np

from meshforge.geometry.aabb import Aabb
from meshforge.geometry.arrays import Floats
from meshforge.geometry.pose import Pose
from meshforge.geometry.shapes import Box, Capsule, Cylinder, Ellipsoid, Polytope, Shape, Sphere


def distance(a: Shape, b: Shape) -> float:
    """The smallest distance [m] between two convex shapes, 0 where they touch or overlap."""
    frame = _UnitFrame.around([a, b])
    return frame.gap(frame.placed(a), frame.placed(b))


def close_pairs(
    shapes: Sequence[Shape], reach: float, settled: frozenset[int] = frozenset()
) -> dict[tuple[int, int], float]:
    """Distance of each pair (i, j), i < j, of shapes at most `reach` [m] apart, in order of (i, j).

    settled: indices among which no pair is wanted, only pairs with one of the others.
    """
    if len(shapes) < 2:
        return {}
    frame = _UnitFrame.around(shapes)
    placed: list[Any] = [None] * len(shapes)
    found: dict[tuple[int, int], float] = {}
    for i, j in _broad_phase(shapes, reach):
        if i in settled and j in settled:
            continue
        for k in (i, j):
            placed[k] = placed[k] or frame.placed(shapes[k])
        gap = frame.gap(placed[i], placed[j])
        if gap <= reach:
            found[i, j] = gap
    return found


def _broad_phase(shapes: Sequence[Shape], reach: float) -> list[tuple[int, int]]:
    """Pairs whose AABBs are within `reach`, in order."""
    low = np.array([s.aabb.min for s in shapes])
    high = np.array([s.aabb.max for s in shapes])
    gaps = np.maximum(low[:, None] - high[None, :], low[None, :] - high[:, None]).clip(0)
    near = np.einsum("ijk,ijk->ij", gaps, gaps) <= reach * reach * (1 + 1e-12)
    return [(int(i), int(j)) for i, j in zip(*np.nonzero(np.triu(near, 1)), strict=True)]


class _UnitFrame:
    """Coordinates in which all shapes together have a diagonal of one: coal errs on others."""

    def __init__(self, bounds: Aabb) -> None:
        self.center = bounds.center
        self.scale = bounds.diagonal or 1.0
        self.request = coal.DistanceRequest()
        self.request.enable_signed_distance = False
        self.result = coal.DistanceResult()

    @staticmethod
    def around(shapes: Sequence[Shape]) -> _UnitFrame:
        return _UnitFrame(Aabb.union(s.aabb for s in shapes))

    def placed(self, shape: Shape) -> tuple[Any, Any]:
        """coal's geometry and transform of a shape, in this frame."""
        size = self.scale
        match shape:
            case Polytope():
                return _convex((shape.vertices - self.center) / size, shape.faces), coal.Transform3s()
            case Box():
                return coal.Box(*(2 * shape.half / size)), self._transform(shape.pose)
            case Sphere():
                return coal.Sphere(shape.radius / size), self._transform(shape.pose)
            case Cylinder():
                return coal.Cylinder(shape.radius / size, 2 * shape.half_length / size), self._transform(shape.pose)
            case Capsule():
                return coal.Capsule(shape.radius / size, 2 * shape.half_length / size), self._transform(shape.pose)
            case Ellipsoid():
                return coal.Ellipsoid(*(shape.radii / size)), self._transform(shape.pose)
            case _:
                raise TypeError(f"no distance for shapes of kind {shape.kind}")

    def gap(self, a: tuple[Any, Any], b: tuple[Any, Any]) -> float:
        self.result.clear()
        return max(0.0, float(coal.distance(a[0], a[1], b[0], b[1], self.request, self.result))) * self.scale

    def _transform(self, pose: Pose) -> Any:
        return coal.Transform3s(pose.rotation, (pose.translation - self.center) / self.scale)


def _convex(vertices: Floats, faces: Any) -> Any:
    points = coal.StdVec_Vec3s()
    points.extend(list(vertices))
    triangles = coal.StdVec_Triangle()
    triangles.extend([coal.Triangle(*map(int, face)) for face in faces])
    return coal.Convex(points, triangles)
