"""Solids by manifold3d: volumes of overlaps and unions, inertia at one density; cuts by planes and intersections."""

import math
from collections.abc import Sequence
from typing import Any, assert_never

import manifold3d
import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry.arrays import Aabb, Floats
from meshforge.geometry.convex import convex_hull, spans_volume
from meshforge.geometry.round_shapes import Capsule, Cylinder, Ellipsoid, Sphere
from meshforge.geometry.shape import Box, Polytope, Shape

_SEGMENTS = 96  # segments of a round primitive; the surface is off by about 0.1% of the radius then


def overlap_volume(a: Shape, b: Shape) -> float:
    """Return the volume [m^3] that two shapes have in common, 0 where they only touch.

    Polytopes and boxes: to 1e-9 of the smaller volume. Round primitives are finely tessellated to their exact volume,
    which leaves an error of about 0.1% of the smaller volume.
    """
    if not a.aabb.intersects(b.aabb):
        return 0.0
    bounds = Aabb.union([a.aabb, b.aabb])
    return max(0.0, float((to_manifold(a, bounds) ^ to_manifold(b, bounds)).volume())) * bounds.diagonal**3


def volume_of_union(shapes: Sequence[Shape]) -> float:
    """Return the volume [m^3] that shapes fill together, what they share counted once; as exact as `overlap_volume`."""
    if not shapes:
        return 0.0
    bounds = Aabb.union(shape.aabb for shape in shapes)
    whole = manifold3d.Manifold.batch_boolean([to_manifold(shape, bounds) for shape in shapes], manifold3d.OpType.Add)
    return float(whole.volume()) * bounds.diagonal**3


def to_manifold(shape: Shape, bounds: Aabb) -> Any:
    """Return the shape in coordinates where `bounds` has a diagonal of one about the origin."""
    match shape:
        case Polytope() | Box():
            hull = shape.tessellate()
            return _manifold_of_hull(scale_points(hull.vertices, bounds), hull)
        case Sphere() | Ellipsoid() | Cylinder() | Capsule():
            fine = _tessellate(shape)
            grown = np.cbrt(shape.volume / fine.volume())  # of equal volume, it errs to both sides of the surface
            linear = shape.pose.rotation * (grown / bounds.diagonal)
            return fine.transform(np.column_stack([linear, (shape.pose.translation - bounds.center) / bounds.diagonal]))
        case _:
            raise TypeError(f"no solid of a shape of kind {shape.kind}")


def scale_points(vertices: Floats, bounds: Aabb) -> Floats:
    """Return vertices (n, 3) where `bounds` has a diagonal of one about the origin."""
    found: Floats = (vertices - bounds.center) / bounds.diagonal
    return found


def _manifold_of_hull(vertices: Floats, hull: Polytope) -> Any:
    solid = manifold3d.Manifold(manifold3d.Mesh64(vertices, hull.faces.astype(np.uint64)))
    if solid.status() != manifold3d.Error.NoError:
        raise GeometryError(f"a hull encloses no solid ({solid.status().name})", remedy="Make its convex hull anew.")
    return solid


def _tessellate(shape: Sphere | Ellipsoid | Cylinder | Capsule) -> Any:
    match shape:
        case Sphere():
            return manifold3d.Manifold.sphere(shape.radius, _SEGMENTS)
        case Ellipsoid():
            return manifold3d.Manifold.sphere(1.0, _SEGMENTS).scale(shape.radii)
        case Cylinder():
            length = 2 * shape.half_length
            return manifold3d.Manifold.cylinder(length, shape.radius, shape.radius, _SEGMENTS, center=True)
        case Capsule():
            return _revolve_capsule(shape.radius, shape.half_length)
        case _:
            assert_never(shape)


def _revolve_capsule(radius: float, half_length: float) -> Any:
    angle = np.linspace(0.0, np.pi / 2, _SEGMENTS // 4 + 1)
    dome = np.column_stack([radius * np.cos(angle), radius * np.sin(angle) + half_length])
    dome[-1, 0] = 0.0
    return manifold3d.CrossSection([np.concatenate([dome[::-1] * [1.0, -1.0], dome])]).revolve(_SEGMENTS)


def inertia(shapes: Sequence[Shape], mass: float, centre: Floats | None = None) -> tuple[Floats, Floats]:
    """Return the centre of mass (3,), and the inertia (3, 3) about it, of shapes that weigh `mass` [kg] together.

    centre: where that is known to be; None for that of the shapes. Where they overlap, they count twice, as in MuJoCo.
    """
    volumes = np.array([shape.volume for shape in shapes])
    shares = volumes / volumes.sum()
    middles = np.array([shape.centroid for shape in shapes])
    about = shares @ middles if centre is None else centre
    spreads = [_second_moment(shape) + np.outer(m - about, m - about) for shape, m in zip(shapes, middles, strict=True)]
    spread = np.einsum("k,kij->ij", shares, np.array(spreads))
    return about, mass * (np.trace(spread) * np.eye(3) - spread)


def combine_inertias(
    parts: Sequence[tuple[float, Floats, Floats]], about: Floats | None = None
) -> tuple[float, Floats, Floats]:
    """Return the mass [kg] of parts together, a centre (3,), and the inertia (3, 3) about it.

    parts: of each its mass, its centre and its inertia about that; about: the centre, None for the common one.
    """
    mass = sum(own for own, _, _ in parts)
    centre: Floats = np.sum([own * at for own, at, _ in parts], axis=0) / mass if about is None else about
    arms = [(own, at - centre, tensor) for own, at, tensor in parts]
    moved = [tensor + own * (arm @ arm * np.eye(3) - np.outer(arm, arm)) for own, arm, tensor in arms]
    return mass, centre, np.sum(moved, axis=0)


def principal_axes(inertia: Floats) -> tuple[Floats, Floats]:
    """Return the principal moments (3,) and axes, a rotation (3, 3), of an inertia (3, 3); its own if diagonal."""
    if not (inertia - np.diag(np.diag(inertia))).any():
        return np.diag(inertia).copy(), np.eye(3)
    moments, axes = np.linalg.eigh(inertia)
    return moments, axes * np.sign(np.linalg.det(axes))


def _second_moment(shape: Shape) -> Floats:
    """The mean (3, 3) of the products of two coordinates over a shape, from its centroid [m^2]."""
    match shape:
        case Box():
            return _rotate(shape.pose.rotation, shape.half**2 / 3)
        case Sphere():
            return np.eye(3) * shape.radius**2 / 5
        case Ellipsoid():
            return _rotate(shape.pose.rotation, shape.radii**2 / 5)
        case Cylinder():
            return _rotate(shape.pose.rotation, _moment_of_rod(shape.radius, shape.half_length))
        case Capsule():
            radius, half = (
                shape.radius,
                shape.half_length,
            )  # a cylinder, and halves of a ball 3/8 of the radius above it
            ends = np.array([radius**2 / 5, radius**2 / 5, half**2 + 3 / 4 * half * radius + radius**2 / 5])
            share = half / (half + 2 / 3 * radius)  # of the volume, that of the cylinder
            return _rotate(shape.pose.rotation, share * _moment_of_rod(radius, half) + (1 - share) * ends)
    return _moment_of_polytope(shape.tessellate(), shape.centroid)


def _rotate(rotation: Floats, squares: Floats) -> Floats:
    return np.asarray(rotation * squares @ rotation.T)


def _moment_of_rod(radius: float, half: float) -> Floats:
    return np.array([radius**2 / 4, radius**2 / 4, half**2 / 3])


def _moment_of_polytope(polytope: Polytope, middle: Floats) -> Floats:
    """The second moment (3, 3) of a polytope, by signed tetrahedra about its centroid [m^2]."""
    corners = (polytope.vertices - middle)[polytope.faces]
    volumes = np.linalg.det(corners)
    sums = corners.sum(axis=1)
    products = np.einsum("fki,fkj->fij", corners, corners) + np.einsum("fi,fj->fij", sums, sums)
    return np.asarray(np.einsum("f,fij->ij", volumes, products) / (20 * volumes.sum()))


_THIN = 1e-6  # a part that reaches less than this share of the shape's size beyond the plane is none


def cut(shape: Shape, point: Floats, normal: Floats) -> tuple[Polytope | None, Polytope | None]:
    """Return the parts of a shape below and above the plane through `point` (3,) across `normal` (3,).

    None stands for a part that is not there. Vertices of the shape stay what they are, bit for bit; a round primitive
    is cut as its tessellation. A part that is thinner than 1e-6 of the shape's size is left out.
    Raises GeometryError for a point that is not finite, or a normal without direction.
    """
    whole = shape.tessellate()
    if not np.isfinite(point).all():
        raise GeometryError("a plane needs a point whose coordinates are finite")
    direction = _normalize(normal)
    with np.errstate(over="ignore"):  # far enough from the shape is far enough
        heights = (whole.vertices - point) @ direction
    thin = _THIN * whole.aabb.diagonal
    if heights.min() >= -thin:
        return None, whole
    if heights.max() <= thin:
        return whole, None
    crossing = _cross_edges(whole, heights)
    below, above = whole.vertices[heights < 0], whole.vertices[heights > 0]
    return _hull_of_part(below, crossing), _hull_of_part(above, crossing)


def _normalize(normal: Floats) -> Floats:
    """The normal one long, however long it is. It is halved or doubled first, which rounds nothing."""
    most = float(np.abs(normal).max())
    if not (math.isfinite(most) and most > 0):
        raise GeometryError("a plane needs a normal that is finite and not zero")
    near = np.ldexp(normal, -math.frexp(most)[1])
    direction: Floats = near / np.linalg.norm(near)
    return direction


def _cross_edges(whole: Polytope, heights: Floats) -> Floats:
    """The points (n, 3) where edges meet the plane."""
    faces = whole.faces
    start, end = faces.ravel(), faces[:, [1, 2, 0]].ravel()
    through = (heights[start] < 0) & (heights[end] > 0)  # each edge has both senses, in its two faces
    start, end = start[through], end[through]
    share = (heights[start] / (heights[start] - heights[end]))[:, None]
    crossings = whole.vertices[start] * (1 - share) + whole.vertices[end] * share
    return np.concatenate([crossings, whole.vertices[heights == 0]])


def _hull_of_part(side: Floats, crossing: Floats) -> Polytope | None:
    points = np.concatenate([side, crossing])
    return convex_hull(points, name="a part of a cut") if spans_volume(points) else None


def intersect(a: Shape, b: Shape) -> Polytope | None:
    """Return what two convex shapes have in common, to rounding; None where that spans no volume.

    Round primitives count as their tessellations.
    """
    if not a.aabb.intersects(b.aabb):
        return None
    bounds = Aabb.union([a.aabb, b.aabb])
    common = to_manifold(a.tessellate(), bounds) ^ to_manifold(b.tessellate(), bounds)
    corners = np.asarray(common.to_mesh64().vert_properties, dtype=np.float64)[:, :3] * bounds.diagonal + bounds.center
    return convex_hull(corners, name="the common part") if len(corners) > 3 and spans_volume(corners) else None


def section(shape: Polytope, point: Floats, normal: Floats) -> tuple[float, float]:
    """Return the area [m^2] and the perimeter [m] of the section of a polytope by a plane; zeros where it misses it."""
    from scipy.spatial import ConvexHull, QhullError  # lazy: 0.5 s, half of all imports

    crossing = _cross_edges(shape, (shape.vertices - point) @ normal)
    if len(crossing) < 3:
        return 0.0, 0.0
    side = np.eye(3)[int(np.abs(normal).argmin())]
    u = np.cross(normal, side)
    u /= np.linalg.norm(u)
    flat = (crossing - point) @ np.column_stack([u, np.cross(normal, u)])
    try:
        outline = ConvexHull(flat)
    except QhullError:  # a line
        return 0.0, 0.0
    return float(outline.volume), float(outline.area)
