"""Goals on motion: that an asset stands, and that what joints move goes through its range."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import reduce
from itertools import product
from operator import or_

import numpy as np

from meshforge.checks.goals.base import Goal, GoalSubject, NotApplicableError, Part
from meshforge.checks.physics.mechanism import WELDED_JOINTS, ContactRules, JointTree, explain_untried, place_joint
from meshforge.checks.physics.scene import Failure, Place, frame_of_axis
from meshforge.common import require_mujoco
from meshforge.geometry import Aabb
from meshforge.language import (
    Direction,
    DirectionArgument,
    Extractor,
    ExtractorArgument,
    OptionArgument,
    QuantityArgument,
)
from meshforge.symbolic import Hull, Joint, bits_of, split_by_contact

_SMALL = 0.5  # of the diagonal of what moves, below which what touches it alone hangs on it


@dataclass(frozen=True, slots=True)
class Stands(Goal):
    """Dropped from 1 cm as one rigid body, leaning a little, it ends upright and at rest."""

    on_level = True

    def find_failure(self, subject: GoalSubject) -> Failure | None:
        require_mujoco("a goal")
        from meshforge.checks.physics.motion import try_stand  # lazy: MuJoCo takes 0.3 s

        return try_stand(subject.hulls, subject.end.diagonal)


@dataclass(frozen=True, slots=True)
class Swings(Goal):
    """What moves a selection, a joint or an axis, goes through its range, and nothing else is met."""

    leaf: Extractor = field(metadata={"argument": ExtractorArgument(), "title": "What moves"})
    about: Extractor | None = field(
        default=None,
        metadata={"argument": OptionArgument("about", ExtractorArgument()), "title": "About", "omitted": "its joint"},
    )
    axis: Direction | None = field(
        default=None, metadata={"argument": OptionArgument("axis", DirectionArgument()), "title": "Axis"}
    )
    angle: float | None = field(
        default=None, metadata={"argument": OptionArgument("angle", QuantityArgument("deg")), "title": "Angle"}
    )
    ignore: Extractor | None = field(
        default=None, metadata={"argument": OptionArgument("ignore", ExtractorArgument()), "title": "What may be met"}
    )

    def conflict(self) -> str | None:
        given = [self.about, self.axis, self.angle]
        if any(one is not None for one in given) and None in given:
            return "swings takes about, axis and angle together, or none of them"
        return None

    def find_failure(self, subject: GoalSubject) -> Failure | None:
        require_mujoco("a goal")
        from meshforge.checks.physics.motion import try_swing  # lazy: MuJoCo takes 0.3 s

        moved = subject.select_after(self.leaf)
        if not moved:
            return Failure(f"nothing of {self.leaf} is left")
        if self.about is not None:
            assert self.axis and self.angle
            pins = subject.select(self.about)
            centre = np.mean([hull.shape.centroid for hull in pins], axis=0)
            axis = Place(centre, np.array([0.0, self.angle, 0.0]), frame_of_axis(subject.turn_axis(self.axis)))
            pin_names = {hull.name for hull in (*pins, *subject.select_after(self.about)) if hull not in moved}
            moving = [*moved, *(hull for hull in self._find_attachments(subject, pins) if hull.name not in pin_names)]
            rest = [hull for hull in subject.hulls if hull not in moving and hull.name not in pin_names]
            return try_swing(moving, rest, axis, subject.touching, "hinge", self._find_apart(subject))
        joints = _find_joints(subject, moved)
        if not joints:
            raise NotApplicableError(f"no joint moves {self.leaf}; give about, axis and angle")
        for joint, bodies in joints:
            moving = [hull for hull in subject.hulls if hull.body in bodies]
            rest = [hull for hull in subject.hulls if hull.body not in bodies]
            if problem := explain_untried(joint):
                raise NotApplicableError(problem)
            place, motion = place_joint(joint, subject.upright)
            if why := try_swing(moving, rest, place, subject.touching, motion, self._find_apart(subject)):
                return why
        return None

    def _find_attachments(self, subject: GoalSubject, pins: Sequence[Hull]) -> Iterator[Hull]:
        """What hangs on what moves, such as a handle: hulls where small pieces were that touched it, without pins."""
        mesh, leaf = subject.start, subject.select(self.leaf)
        own, fixed = (sum(1 << mesh.index[hull.name] for hull in hulls) for hulls in (leaf, pins))
        near = reduce(or_, (mesh.adjacency[k] for k in bits_of(own)))
        pieces = [one for one in split_by_contact(mesh, (1 << len(mesh.hulls)) - 1 & ~(own | fixed)) if one & near]
        parts = [Part(tuple(subject.hulls_before[k] for k in bits_of(piece)), np.eye(3)) for piece in pieces]
        most = _SMALL * Aabb.union(hull.aabb for hull in leaf).diagonal
        beside = [part for part in parts if part.box.diagonal < most]
        moved = subject.select_after(self.leaf)
        yield from (hull for hull in subject.hulls if hull not in moved and any(one.holds(hull, 0.0) for one in beside))

    def _find_apart(self, subject: GoalSubject) -> frozenset[frozenset[str]]:
        """The pairs of hulls that may be in each other: what the file keeps apart, and what is to be ignored."""
        rules, hulls = ContactRules(subject.end), subject.end.hulls
        ignored = {hull.name for hull in subject.select_any(self.ignore)}
        apart = set[frozenset[str]]()
        for (i, one), (j, other) in product(enumerate(hulls), repeat=2):
            if i < j and (one.name in ignored or other.name in ignored or not rules.may_touch(i, j)):
                apart.add(frozenset((one.name, other.name)))
        return frozenset(apart)


def _find_joints(subject: GoalSubject, moved: tuple[Hull, ...]) -> list[tuple[Joint, frozenset[str]]]:
    """The joints nearest above some hulls that can move, each with the bodies below it."""
    tree = JointTree.of(subject.end)
    found = dict[str, tuple[Joint, frozenset[str]]]()
    for body in dict.fromkeys(hull.body for hull in moved):
        while body in tree.above:
            joint = next((one for one in reversed(tree.joints[body]) if one.kind not in WELDED_JOINTS), None)
            if joint is not None:
                found[body] = (joint, frozenset(tree.list_below(body)))
                break
            body = tree.above[body]
    return list(found.values())
