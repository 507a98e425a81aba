"""The convex shapes: one base, one file a kind."""

from meshforge.geometry.shapes.base import Shape
from meshforge.geometry.shapes.box import Box
from meshforge.geometry.shapes.capsule import Capsule
from meshforge.geometry.shapes.cylinder import Cylinder
from meshforge.geometry.shapes.ellipsoid import Ellipsoid
from meshforge.geometry.shapes.polytope import Polytope
from meshforge.geometry.shapes.sphere import Sphere

__all__ = ["Box", "Capsule", "Cylinder", "Ellipsoid", "Polytope", "Shape", "Sphere"]
