"""The mechanism of a mesh as MuJoCo takes it: which body hangs on which, which hulls may touch, and how they rub."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from itertools import combinations
from typing import Any

from meshforge.geometry import Pose
from meshforge.symbolic import Hull, Joint, SymbolicMesh

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

    @staticmethod
    def of(mesh: SymbolicMesh) -> JointTree:
        """The tree of a mesh; bodies that a floating joint holds are roots, loops are cut."""
        named = mesh.asset.bodies if mesh.asset else ()
        known = {body.name: body.pose for body in named}
        bodies = {**known, **{hull.body: Pose.identity() for hull in mesh.hulls if hull.body not in known}}
        tree = JointTree(bodies)
        for joint in mesh.asset.mechanism.joints if mesh.asset else ():
            if joint.kind == "floating" or joint.child not in bodies or joint.parent not in bodies:
                continue
            if tree.above.get(joint.child, joint.parent) == joint.parent and not tree._is_below(joint):
                tree.above[joint.child] = joint.parent
                tree.joints.setdefault(joint.child, []).append(joint)
        return tree

    def _is_below(self, joint: Joint) -> bool:
        """Whether the parent of a joint hangs below its child."""
        at: str | None = joint.parent
        while at is not None and at != joint.child:
            at = self.above.get(at)
        return at is not None

    def roots_of(self, bodies: Iterable[str]) -> set[str]:
        """The roots, which nothing holds, that some bodies hang on."""
        found = set()
        for body in bodies:
            while body in self.above:
                body = self.above[body]
            found.add(body)
        return found

    def children_of(self, body: str) -> list[str]:
        """The bodies joined to one directly."""
        return [child for child, parent in self.above.items() if parent == body]

    def rigid_roots(self) -> dict[str, str]:
        """For each body the highest one that it is welded to."""
        found: dict[str, str] = {}
        for name in self.bodies:
            top = name
            while top in self.above and all(joint.kind in WELDED_JOINTS for joint in self.joints[top]):
                top = self.above[top]
            found[name] = top
        return found


@dataclass(frozen=True, slots=True)
class ContactAttributes:
    """How a hull collides, by the names and defaults of MJCF (XML reference, body/geom)."""

    contype: int = 1
    conaffinity: int = 1
    condim: int = 3
    priority: int = 0
    friction: tuple[float, ...] = (1.0, 0.005, 0.0001)

    def can_meet(self, other: ContactAttributes) -> bool:
        """Whether the bits let the two collide."""
        return bool(self.contype & other.conaffinity or other.contype & self.conaffinity)


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
        """Whether two hulls may touch, by their numbers; joints say nothing here."""
        if frozenset((first, second)) in self.paired:
            return True
        bodies = frozenset((self.hulls[first].body, self.hulls[second].body))
        return bodies not in self.apart and self.contacts[first].can_meet(self.contacts[second])


def _parse_contact(attributes: dict[str, str]) -> ContactAttributes:
    numbers = ("contype", "conaffinity", "condim", "priority")
    parsed: dict[str, Any] = {name: int(attributes[name]) for name in numbers if name in attributes}
    if "friction" in attributes:
        parsed["friction"] = tuple(map(float, attributes["friction"].split()))
    return ContactAttributes(**parsed)


def _number_pairs(pairs: tuple[tuple[str, str], ...], sources: list[str]) -> Iterator[frozenset[int]]:
    """The pairs of hulls that were made of the geoms of a pair."""
    wanted = {frozenset(pair) for pair in pairs}
    touched = {name for pair in pairs for name in pair}
    of_pairs = [k for k, name in enumerate(sources) if name in touched]
    for first, second in combinations(of_pairs, 2):
        if frozenset((sources[first], sources[second])) in wanted:
            yield frozenset((first, second))
