"""Goals on motion: that an asset stands, and that what joints move goes through its range."""

from dataclasses import dataclass, field
from itertools import product

import numpy as np

from meshforge.checks.goals.base import Goal, GoalSubject, NotApplicableError
from meshforge.checks.physics.mechanism import WELDED_JOINTS, ContactRules, JointTree
from meshforge.checks.physics.scene import Failure, Place
from meshforge.common import require_mujoco
from meshforge.geometry import Floats, Pose
from meshforge.language import (
    Direction,
    DirectionArgument,
    Extractor,
    ExtractorArgument,
    OptionArgument,
    QuantityArgument,
)
from meshforge.symbolic import Hull, Joint

_MOTIONS = {"revolute": "hinge", "continuous": "hinge", "prismatic": "slide"}


@dataclass(frozen=True, slots=True)
class Stands(Goal):
    """Dropped from 1 cm as one rigid body, leaning a little, it ends upright and at rest."""

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
        metadata={
            "argument": OptionArgument("about", ExtractorArgument()),
            "title": "About",
            "omitted": "its joint",
        },
    )
    axis: Direction | None = field(
        default=None, metadata={"argument": OptionArgument("axis", DirectionArgument()), "title": "Axis"}
    )
    angle: float | None = field(
        default=None, metadata={"argument": OptionArgument("angle", QuantityArgument("deg")), "title": "Angle"}
    )
    ignore: Extractor | None = field(
        default=None,
        metadata={"argument": OptionArgument("ignore", ExtractorArgument()), "title": "What may be met"},
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
            centre = np.mean([hull.shape.centroid for hull in subject.select(self.about)], axis=0)
            axis = Place(centre, np.array([0.0, self.angle, 0.0]), _frame(subject.turn_axis(self.axis)))
            names = {hull.name for hull in moved}
            rest = [hull for hull in subject.hulls if hull.name not in names]
            return try_swing(moved, rest, axis, subject.touching, "hinge", self._find_apart(subject))
        joints = _find_joints(subject, moved)
        if not joints:
            raise NotApplicableError(f"no joint moves {self.leaf}; give about, axis and angle")
        for joint, bodies in joints:
            moving = [hull for hull in subject.hulls if hull.body in bodies]
            rest = [hull for hull in subject.hulls if hull.body not in bodies]
            place = _place_of(joint, subject.upright)
            motion = _MOTIONS[joint.kind]
            if why := try_swing(moving, rest, place, subject.touching, motion, self._find_apart(subject)):  # type: ignore[arg-type]
                return why
        return None

    def _find_apart(self, subject: GoalSubject) -> frozenset[frozenset[str]]:
        """The pairs of hulls that may be in each other: what the file keeps apart, and what is to be ignored."""
        rules, hulls = ContactRules(subject.end), subject.end.hulls
        ignored = {hull.name for hull in subject.select_after(self.ignore)} if self.ignore is not None else set()
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
                found[body] = (joint, frozenset(_list_below(tree, body)))
                break
            body = tree.above[body]
    return list(found.values())


def _list_below(tree: JointTree, body: str) -> list[str]:
    bodies = [body]
    for one in bodies:
        bodies += tree.children_of(one)
    return bodies


def _place_of(joint: Joint, upright: Floats) -> Place:
    """Where a joint is, and its range. Raises NotApplicableError for one that has none."""
    if joint.kind not in _MOTIONS or joint.coupling is not None:
        raise NotApplicableError(f"the joint {joint.name or joint.child!r} is one that is not tried: {joint.kind}")
    if joint.limits is None and joint.kind == "prismatic":
        raise NotApplicableError(f"the joint {joint.name or joint.child!r} slides without limits")
    low, high = joint.limits or (0.0, 2 * np.pi)
    scale = 1.0 if joint.kind == "prismatic" else float(np.degrees(1.0))
    pose = Pose(upright, np.zeros(3))
    at, axis = pose.apply(joint.anchor[None])[0], upright @ joint.axis
    return Place(at, np.array([low * scale, high * scale, 0.0]), _frame(axis))


def _frame(axis: Floats) -> Floats:
    """A rotation (3, 3) whose first column is an axis."""
    helper = np.eye(3)[int(np.abs(axis).argmin())]
    second = np.cross(axis, helper)
    second /= np.linalg.norm(second)
    return np.stack([axis, second, np.cross(axis, second)], axis=1)
