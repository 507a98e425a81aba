"""Pure shapes: hulls, native primitives, poses, and what can be measured and made of them."""

from meshforge.geometry.aabb import Aabb, bounds
from meshforge.geometry.arrays import Floats, Ints, frozen_floats, frozen_ints
from meshforge.geometry.common import Parting, common, parted
from meshforge.geometry.convex import FLATNESS, convex_hull, principal_extents, spans_volume
from meshforge.geometry.cut import cut
from meshforge.geometry.digest import digest, same_shape
from meshforge.geometry.distance import close_pairs, distance
from meshforge.geometry.enclose import Budget, Enclosure, enclosing
from meshforge.geometry.fit import (
    aabb_box,
    aabb_capsule,
    aabb_cylinder,
    aabb_sphere,
    longest_axis,
    mapped_to,
    tight_box,
    tight_capsule,
    tight_cylinder,
)
from meshforge.geometry.inertia import inertia
from meshforge.geometry.nearest import nearest_on_triangles
from meshforge.geometry.overlap import overlap_volume, volume_of_union
from meshforge.geometry.pieces import Piece, pieces
from meshforge.geometry.polygons import LEVEL, normals_of, polygon_sizes
from meshforge.geometry.pose import Pose
from meshforge.geometry.shapes import Box, Capsule, Cylinder, Ellipsoid, Polytope, Shape, Sphere
from meshforge.geometry.surface import is_closed, is_convex, neighbours, outward

__all__ = [
    "FLATNESS",
    "LEVEL",
    "Aabb",
    "Box",
    "Budget",
    "Capsule",
    "Cylinder",
    "Ellipsoid",
    "Enclosure",
    "Floats",
    "Ints",
    "Parting",
    "Piece",
    "Polytope",
    "Pose",
    "Shape",
    "Sphere",
    "aabb_box",
    "aabb_capsule",
    "aabb_cylinder",
    "aabb_sphere",
    "bounds",
    "close_pairs",
    "common",
    "convex_hull",
    "cut",
    "digest",
    "distance",
    "enclosing",
    "frozen_floats",
    "frozen_ints",
    "inertia",
    "is_closed",
    "is_convex",
    "longest_axis",
    "mapped_to",
    "nearest_on_triangles",
    "neighbours",
    "normals_of",
    "outward",
    "overlap_volume",
    "parted",
    "pieces",
    "polygon_sizes",
    "principal_extents",
    "same_shape",
    "spans_volume",
    "tight_box",
    "tight_capsule",
    "tight_cylinder",
    "volume_of_union",
]
