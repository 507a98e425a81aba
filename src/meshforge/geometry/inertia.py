"""The inertia of solids of one density."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from meshforge.geometry.arrays import Floats
from meshforge.geometry.shapes import Box, Capsule, Cylinder, Ellipsoid, Polytope, Shape, Sphere


def inertia(shapes: Sequence[Shape], mass: float, centre: Floats | None = None) -> tuple[Floats, Floats]:
    """The centre of mass (3,), and the inertia (3, 3) about it, of shapes that weigh `mass` [kg] together.

    centre: where that is known to be; None for that of the shapes. Where they overlap, they count twice, as in MuJoCo.
    """
    volumes = np.array([shape.volume for shape in shapes])
    shares = volumes / volumes.sum()
    middles = np.array([shape.centroid for shape in shapes])
    about = shares @ middles if centre is None else centre
    spreads = [_spread(shape) + np.outer(m - about, m - about) for shape, m in zip(shapes, middles, strict=True)]
    spread = np.einsum("k,kij->ij", shares, np.array(spreads))
    return about, mass * (np.trace(spread) * np.eye(3) - spread)


def _spread(shape: Shape) -> Floats:
    """The mean (3, 3) of the products of two coordinates over a shape, from its centroid [m^2]."""
    match shape:
        case Box():
            return _turned(shape.pose.rotation, shape.half**2 / 3)
        case Sphere():
            return np.eye(3) * shape.radius**2 / 5
        case Ellipsoid():
            return _turned(shape.pose.rotation, shape.radii**2 / 5)
        case Cylinder():
            return _turned(shape.pose.rotation, _of_rod(shape.radius, shape.half_length))
        case Capsule():
            return _turned(shape.pose.rotation, _of_capsule(shape.radius, shape.half_length))
    return _of_polytope(shape.tessellate(), shape.centroid)


def _turned(rotation: Floats, squares: Floats) -> Floats:
    return np.asarray(rotation * squares @ rotation.T)


def _of_rod(radius: float, half: float) -> Floats:
    return np.array([radius**2 / 4, radius**2 / 4, half**2 / 3])


def _of_capsule(radius: float, half: float) -> Floats:
    """That of a cylinder and the halves of a ball on its ends, whose centroids are 3/8 of their radius above these."""
    along = half**2 + 3 / 4 * half * radius + radius**2 / 5
    ends = np.array([radius**2 / 5, radius**2 / 5, along])
    share = half / (half + 2 / 3 * radius)  # of the volume, that of the cylinder
    return np.asarray(share * _of_rod(radius, half) + (1 - share) * ends)


def _of_polytope(polytope: Polytope, middle: Floats) -> Floats:
    """The same by signed tetrahedra about the centroid."""
    corners = (polytope.vertices - middle)[polytope.faces]
    volumes = np.linalg.det(corners)
    sums = corners.sum(axis=1)
    products = np.einsum("fki,fkj->fij", corners, corners) + np.einsum("fi,fj->fij", sums, sums)
    return np.asarray(np.einsum("f,fij->ij", volumes, products) / (20 * volumes.sum()))
