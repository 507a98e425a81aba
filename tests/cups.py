"""A square cup: what it shows, and hulls that fit it or fill it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from meshforge.geometry import Aabb, Box, Pose, Shape
from meshforge.symbolic import Asset, Body, Document, Geom, Inertial, Joint, Mechanism, Surface, SymbolicMesh
from tests.soups import merge_solids

BOTTOM = Box.of_bounds(Aabb([0, 0, 0], [0.1, 0.1, 0.01]))
WALLS = (
    Box.of_bounds(Aabb([0, 0, 0.01], [0.01, 0.1, 0.1])),
    Box.of_bounds(Aabb([0.09, 0, 0.01], [0.1, 0.1, 0.1])),
    Box.of_bounds(Aabb([0.01, 0, 0.01], [0.09, 0.01, 0.1])),
    Box.of_bounds(Aabb([0.01, 0.09, 0.01], [0.09, 0.1, 0.1])),
)
LID = Box.of_bounds(Aabb([0, 0, 0.1], [0.1, 0.1, 0.11]))
WHOLE = Box.of_bounds(Aabb([0, 0, 0], [0.1, 0.1, 0.1]))
INSIDE = 0.08 * 0.08 * 0.09 * 1000
"""What fits into the cup [l]."""


def surface(shapes: Sequence[Shape], body: str | None = "cup") -> Surface:
    """What some shapes show together, inner faces and all."""
    return Surface(*merge_solids(shapes), body)


def cup(
    *hulls: Shape,
    shown: Sequence[Shape] = (BOTTOM, *WALLS),
    inertials: Sequence[Inertial] = (),
    joints: Sequence[Joint] = (),
    bodies: Sequence[str] = (),
) -> SymbolicMesh:
    """A mesh that shows a cup and has these hulls, h0, h1 and so on, of the bodies given, by default all of `cup`."""
    names = [*bodies, *["cup"] * (len(hulls) - len(bodies))]
    geoms = tuple(Geom(f"h{k}", name, shape) for k, (name, shape) in enumerate(zip(names, hulls, strict=True)))
    visuals = (surface(shown),) if shown else ()
    known = tuple(Body(name, Pose.identity()) for name in dict.fromkeys(["cup", *names]))
    mechanism = Mechanism(tuple(joints), tuple(inertials))
    return SymbolicMesh.of(
        Asset(Path("cup.urdf"), "urdf", known, geoms, Document(), visuals=visuals, mechanism=mechanism)
    )
