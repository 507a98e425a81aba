"""Which body hangs on which."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from meshforge.asset import Joint
from meshforge.geometry import Pose
from meshforge.symbolic import SymbolicMesh

WELDED = ("fixed", "planar")
"""Joints that hold a body still in the model."""


@dataclass(eq=False, slots=True)
class Tree:
    """The bodies of a mesh as MuJoCo wants them: nested, each below the one it is joined to.

    joints: of each body with the one above it. A body that nothing holds is free to fall.
    """

    bodies: dict[str, Pose]
    joints: dict[str, list[Joint]] = field(default_factory=dict)
    above: dict[str, str] = field(default_factory=dict)

    @staticmethod
    def of(mesh: SymbolicMesh) -> Tree:
        """The tree of a mesh; bodies that a floating joint holds are roots, loops are cut."""
        named = mesh.asset.bodies if mesh.asset else ()
        known = {body.name: body.pose for body in named}
        bodies = {**known, **{hull.body: Pose.identity() for hull in mesh.hulls if hull.body not in known}}
        tree = Tree(bodies)
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
            while top in self.above and all(joint.kind in WELDED for joint in self.joints[top]):
                top = self.above[top]
            found[name] = top
        return found
