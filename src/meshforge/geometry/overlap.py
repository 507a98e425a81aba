"""Volumes of what shapes have in common, and of all they fill together, by manifold3d."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, assert_never

import manifold3d
import numpy as np

from meshforge.errors import GeometryError
from meshforge.geometry.aabb import Aabb
from meshforge.geometry.arrays import Floats
from meshforge.geometry.shapes import Box, Capsule, Cylinder, Ellipsoid, Polytope, Shape, Sphere

_AROUND = 96  # segments of a round primitive; the surface is off by about 0.1% of the radius then


def overlap_volume(a: Shape, b: Shape) -> float:
    """The volume [m^3] that two shapes have in common, 0 where they only touch.

    Polytopes and boxes: to 1e-9 of the smaller volume. Round primitives are finely tessellated to their exact volume,
    which leaves an error of about 0.1% of the smaller volume.
    """
    low, high = np.maximum(a.aabb.min, b.aabb.min), np.minimum(a.aabb.max, b.aabb.max)
    if not (low < high).all():
        return 0.0
    bounds = Aabb.union([a.aabb, b.aabb])
    common = solid(a, bounds) ^ solid(b, bounds)
    return max(0.0, float(common.volume())) * bounds.diagonal**3


def volume_of_union(shapes: Sequence[Shape]) -> float:
    """The volume [m^3] that shapes fill together, what they share counted once; as exact as `overlap_volume`."""
    if not shapes:
        return 0.0
    bounds = Aabb.union(shape.aabb for shape in shapes)
    solids = [solid(shape, bounds) for shape in shapes]
    whole = manifold3d.Manifold.batch_boolean(solids, manifold3d.OpType.Add)
    return float(whole.volume()) * bounds.diagonal**3


def solid(shape: Shape, bounds: Aabb) -> Any:
    """The shape in coordinates where `bounds` has a diagonal of one about the origin."""
    match shape:
        case Polytope() | Box():
            hull = shape.tessellate()
            return _mesh((hull.vertices - bounds.center) / bounds.diagonal, hull)
        case Sphere() | Ellipsoid() | Cylinder() | Capsule():
            fine = _tessellated(shape)
            grown = np.cbrt(shape.volume / fine.volume())  # of equal volume, it errs to both sides of the surface
            linear = shape.pose.rotation * (grown / bounds.diagonal)
            offset = (shape.pose.translation - bounds.center) / bounds.diagonal
            return fine.transform(np.column_stack([linear, offset]))
        case _:
            raise TypeError(f"no solid of a shape of kind {shape.kind}")


def _mesh(vertices: Floats, hull: Polytope) -> Any:
    solid = manifold3d.Manifold(manifold3d.Mesh64(vertices, hull.faces.astype(np.uint64)))
    if solid.status() != manifold3d.Error.NoError:
        raise GeometryError(f"a hull encloses no solid ({solid.status().name})", remedy="Make its convex hull anew.")
    return solid


def _tessellated(shape: Sphere | Ellipsoid | Cylinder | Capsule) -> Any:
    """A fine mesh of a round primitive about the origin of its pose."""
    match shape:
        case Sphere():
            return manifold3d.Manifold.sphere(shape.radius, _AROUND)
        case Ellipsoid():
            return manifold3d.Manifold.sphere(1.0, _AROUND).scale(shape.radii)
        case Cylinder():
            length = 2 * shape.half_length
            return manifold3d.Manifold.cylinder(length, shape.radius, shape.radius, _AROUND, center=True)
        case Capsule():
            return _capsule(shape.radius, shape.half_length)
        case _:
            assert_never(shape)


def _capsule(radius: float, half_length: float) -> Any:
    """A fine mesh of a capsule about Z, turned from its outline."""
    angle = np.linspace(0.0, np.pi / 2, _AROUND // 4 + 1)
    dome = np.column_stack([radius * np.cos(angle), radius * np.sin(angle) + half_length])
    dome[-1, 0] = 0.0
    outline = np.concatenate([dome[::-1] * [1.0, -1.0], dome])
    return manifold3d.CrossSection([outline]).revolve(_AROUND)
