"""Shapes fitted to others: what fills a bounding box, and the smallest box, cylinder or capsule around points."""

from meshforge.geometry.fit.box import tight_box
from meshforge.geometry.fit.fill import aabb_box, aabb_capsule, aabb_cylinder, aabb_sphere, longest_axis, mapped_to
from meshforge.geometry.fit.round import tight_capsule, tight_cylinder

__all__ = [
    "aabb_box",
    "aabb_capsule",
    "aabb_cylinder",
    "aabb_sphere",
    "longest_axis",
    "mapped_to",
    "tight_box",
    "tight_capsule",
    "tight_cylinder",
]
