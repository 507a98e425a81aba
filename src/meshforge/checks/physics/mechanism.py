"""The mechanism of a mesh: which body hangs on which as MuJoCo takes it, which hulls may touch and how they rub, and
whether the masses and inertias in its file can be those of its bodies."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import combinations
from typing import Any, Self

import numpy as np

from meshforge.checks.physics.scene import Motion, Place, frame_of_axis
from meshforge.common import join_names
from meshforge.engines import Finding, Severity
from meshforge.geometry import Aabb, Floats, Pose, inertia
from meshforge.symbolic import Hull, Inertial, Joint, SymbolicMesh

WELDED_JOINTS = ("fixed", "planar")
"""Joints that hold a body still in the model."""


@dataclass(eq=False, slots=True)
class JointTree:
    """The bodies of a mesh as MuJoCo wants them: nested, each below the one it is joined to.

    joints: of each body with the one above it. A body that nothing holds is free to fall.
    """

    bodies: dict[str, Pose]
    joints: dict[str, list[Joint]] = field(default_factory=dict)
    above: dict[str, str] = field(default_factory=dict)

    @classmethod
    def of(cls, mesh: SymbolicMesh) -> Self:
        """Return the tree of a mesh; bodies that a floating joint holds are roots, loops are cut."""
        known = {body.name: body.pose for body in (mesh.asset.bodies if mesh.asset else ())}
        bodies = {**known, **{hull.body: Pose.identity() for hull in mesh.hulls if hull.body not in known}}
        tree = cls(bodies)
        for joint in mesh.asset.mechanism.joints if mesh.asset else ():
            if joint.kind == "floating" or joint.child not in bodies or joint.parent not in bodies:
                continue
            if tree.above.get(joint.child, joint.parent) == joint.parent and joint.child != tree.root_of(joint.parent):
                tree.above[joint.child] = joint.parent
                tree.joints.setdefault(joint.child, []).append(joint)
        return tree

    def root_of(self, body: str) -> str:
        """Return the body, which nothing holds, that one hangs on."""
        while body in self.above:
            body = self.above[body]
        return body

    def list_below(self, body: str) -> list[str]:
        """Return a body and all that hangs on it."""
        bodies = [body]
        for one in bodies:
            bodies += self.children_of(one)
        return bodies

    def children_of(self, body: str) -> list[str]:
        """Return the bodies joined to one directly."""
        return [child for child, parent in self.above.items() if parent == body]

    def rigid_roots(self) -> dict[str, str]:
        """Return for each body the highest one that it is welded to."""
        found: dict[str, str] = {}
        for name in self.bodies:
            top = name
            while top in self.above and all(joint.kind in WELDED_JOINTS for joint in self.joints[top]):
                top = self.above[top]
            found[name] = top
        return found


_MOTIONS: Mapping[str, Motion] = {"revolute": "hinge", "prismatic": "slide"}


def explain_untried(joint: Joint) -> str | None:
    """Return why a joint is not moved through its range: that it follows another one, or has none; None where it is."""
    if joint.kind not in _MOTIONS or joint.coupling is not None:
        return f"the joint {joint.name or joint.child!r} is one that is not tried: {joint.kind}"
    if joint.limits is None and joint.kind == "prismatic":
        return f"the joint {joint.name or joint.child!r} slides without limits"
    return None


def place_joint(joint: Joint, upright: Floats) -> tuple[Place, Motion]:
    """Return where a joint is and its range, a full turn without limits, and how it moves; upright: the rotation (3, 3)
    that the hulls are turned by."""
    motion = _MOTIONS[joint.kind]
    low, high = joint.limits or (0.0, 2 * np.pi)
    scale = float(np.degrees(1.0)) if motion == "hinge" else 1.0
    axis = upright @ joint.axis
    return Place(upright @ joint.anchor, np.array([low * scale, high * scale, 0.0]), frame_of_axis(axis)), motion


@dataclass(frozen=True, slots=True)
class ContactAttributes:
    """How a hull collides, by the names and defaults of MJCF (XML reference, body/geom)."""

    contype: int = 1
    conaffinity: int = 1
    condim: int = 3
    priority: int = 0
    friction: tuple[float, ...] = (1.0, 0.005, 0.0001)


class ContactRules:
    """The contact of each hull of a mesh, in order: of the file, for a made hull of its parent, else the default.

    apart: pairs of bodies that the file keeps apart; paired: of hulls, by number, that touch all the same.
    """

    def __init__(self, mesh: SymbolicMesh) -> None:
        geoms = {geom.name: geom for geom in mesh.asset.geoms} if mesh.asset else {}
        sources = [hull.parent or hull.name for hull in mesh.hulls]
        attributes = [dict(geoms[name].contact) if name in geoms else {} for name in sources]
        self.hulls: tuple[Hull, ...] = mesh.hulls
        self.contacts = [_parse_contact(own) for own in attributes]
        mechanism = mesh.asset.mechanism if mesh.asset else None
        self.apart = {frozenset(pair) for pair in mechanism.apart} if mechanism else set()
        self.paired = set(_number_pairs(mechanism.paired, sources)) if mechanism else set()

    def may_touch(self, first: int, second: int) -> bool:
        """Return whether two hulls may touch, by their numbers; joints say nothing here."""
        if frozenset((first, second)) in self.paired:
            return True
        bodies = frozenset((self.hulls[first].body, self.hulls[second].body))
        a, b = self.contacts[first], self.contacts[second]
        return bodies not in self.apart and bool(a.contype & b.conaffinity or b.contype & a.conaffinity)


def _parse_contact(attributes: dict[str, str]) -> ContactAttributes:
    numbers = ("contype", "conaffinity", "condim", "priority")
    parsed: dict[str, Any] = {name: int(attributes[name]) for name in numbers if name in attributes}
    if "friction" in attributes:
        parsed["friction"] = tuple(map(float, attributes["friction"].split()))
    return ContactAttributes(**parsed)


def _number_pairs(pairs: tuple[tuple[str, str], ...], sources: list[str]) -> Iterator[frozenset[int]]:
    wanted = {frozenset(pair) for pair in pairs}
    touched = {name for pair in pairs for name in pair}
    for first, second in combinations([k for k, name in enumerate(sources) if name in touched], 2):
        if frozenset((sources[first], sources[second])) in wanted:
            yield frozenset((first, second))


LIGHTEST, HEAVIEST = 5.0, 9_000.0
"""Densities [kg/m^3] beyond which a mass is doubted: below any foam, and above copper."""
OFF = 10.0
"""Inertias that differ by more than this factor from those of the hulls are doubted."""
_ROUNDING = 1e-4  # of inertias that are written with few digits
_OUTSIDE = 0.1  # of the size of the hulls, by which a centre of mass may lie outside of their box

_REMEDIES = {
    "mass": "Correct mass and inertia in the file.",
    "density": "Correct the mass in the file, or apply --mass recompute.",
    "centre": "Correct the inertial origin in the file.",
    "inertia": "Correct the inertia in the file.",
}


def check_masses(mesh: SymbolicMesh) -> Iterator[Finding]:
    """Yield what is odd about the masses in the asset of a mesh: a finding for each rule, with its bodies."""
    found: dict[str, list[str]] = {rule: [] for rule in _REMEDIES}
    for inertial in mesh.asset.mechanism.inertials if mesh.asset else ():
        hulls = [hull for hull in mesh.hulls if hull.body == inertial.body]
        problem = find_inertial_problem(inertial)
        problems = [("mass", problem)] if problem else _compare_with_hulls(inertial, hulls) if hulls else ()
        for rule, text in problems:
            found[rule].append(f"body {inertial.body!r}: {text}")
    for rule, texts in found.items():
        if texts:
            severity: Severity = "error" if rule == "mass" else "warning"
            yield Finding(f"physics-{rule}", severity, (), join_names(texts, 3), _REMEDIES[rule])


def find_inertial_problem(inertial: Inertial) -> str | None:
    """Return why no solid has such a mass and inertia, None where one may."""
    if not (np.isfinite(inertial.mass) and np.isfinite(inertial.inertia).all() and np.isfinite(inertial.centre).all()):
        return "mass or inertia is not a finite number"
    if inertial.mass <= 0:
        return f"its mass is {inertial.mass:g} kg"
    low, middle, high = np.linalg.eigvalsh((inertial.inertia + inertial.inertia.T) / 2).tolist()
    if low <= 0:
        return f"its inertia has a principal moment of {low:.3g} kg m²"
    if low + middle < high * (1 - _ROUNDING):
        return f"its principal moments of inertia break the triangle rule: {low:.3g} + {middle:.3g} < {high:.3g} kg m²"
    return None


def _compare_with_hulls(inertial: Inertial, hulls: list[Hull]) -> Iterator[tuple[str, str]]:
    """Rules that an inertial breaks beside its hulls, and how."""
    shapes = [hull.shape for hull in hulls]
    volume = sum(shape.volume for shape in shapes)
    density = inertial.mass / volume
    if not LIGHTEST <= density <= HEAVIEST:
        yield "density", f"{inertial.mass:.3g} kg on hulls of {1000 * volume:.3g} l are {density:.3g} kg/m³"
    box = Aabb.union(shape.aabb for shape in shapes)
    beyond = float(np.maximum(box.min - inertial.centre, inertial.centre - box.max).max())
    if beyond > _OUTSIDE * box.diagonal:
        yield "centre", f"its centre of mass lies {beyond:.3g} m outside of the box of its hulls"
    _, solid = inertia(shapes, inertial.mass)
    ratio = np.linalg.eigvalsh(inertial.inertia) / np.linalg.eigvalsh(solid)
    worst = float(ratio[np.abs(np.log(ratio)).argmax()])
    if not 1 / OFF <= worst <= OFF:
        yield "inertia", f"its inertia is {worst:.3g} times that of its hulls at that mass"
