"""Joints moved through their range: limits between which nothing moves, and what stands in the way."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from meshforge.checks.physics.mechanism import ContactRules, JointTree, explain_untried, place_joint
from meshforge.checks.physics.scene import Place, Touch, mm
from meshforge.common import join_names
from meshforge.engines import Finding
from meshforge.geometry import Floats
from meshforge.symbolic import Hull, Joint, SymbolicMesh

NEAR_AXIS = 0.2
"""Of the reach of what turns, the distance from its axis within which it may be in its neighbour: pins, and the edge of
a leaf that turns into the wall it hangs on."""
NEARLY = 0.9
"""Of the way from rest to a limit: what stops a joint later is doubtful only, as limits are often generous."""


@dataclass(frozen=True, slots=True)
class JointBlock:
    """What stands in the way of a joint. hulls: the moved one first; share: of the way to the limit where it stops;
    text: where that is; depth: how deep they are in each other there [m]; certain: whether no other joint moves one of
    the two out of the way, and it stops well before the limit."""

    joint: str
    hulls: tuple[str, str]
    share: float
    text: str
    depth: float
    certain: bool


def find_blocks(mesh: SymbolicMesh, tree: JointTree, least: float) -> tuple[JointBlock, ...]:
    """Return what stands in the way of each joint with limits, the others being at rest; least: how deep hulls must be
    in each other [m].

    What is in each other at rest does not count, nor what the file keeps apart, nor what is around the axis of a hinge.
    Joints that follow others, or have no limits, are not moved.
    """
    apart = _find_apart(mesh)
    found = list[JointBlock]()
    for child, joints in tree.joints.items():
        for joint in joints:
            if explain_untried(joint) is None and joint.limits is not None and joint.limits[0] < joint.limits[1]:
                found += _watch(mesh, tree, joint, frozenset(tree.list_below(child)), least, apart)
    return tuple(found)


def _find_apart(mesh: SymbolicMesh) -> frozenset[frozenset[str]]:
    """The pairs of hulls that the file keeps from touching."""
    rules, hulls = ContactRules(mesh), mesh.hulls
    pairs = ((i, j) for i in range(len(hulls)) for j in range(i) if hulls[i].body != hulls[j].body)
    return frozenset(frozenset((hulls[i].name, hulls[j].name)) for i, j in pairs if not rules.may_touch(i, j))


def _watch(
    mesh: SymbolicMesh,
    tree: JointTree,
    joint: Joint,
    below: frozenset[str],
    least: float,
    apart: frozenset[frozenset[str]],
) -> Iterator[JointBlock]:
    """The first thing in the way of a joint to either side."""
    from meshforge.checks.physics.motion import describe_place, watch_joint  # lazy: MuJoCo takes 0.3 s

    moving = [hull for hull in mesh.hulls if hull.body in below]
    rest = [hull for hull in mesh.hulls if hull.body not in below]
    if not moving or not rest:
        return
    place, motion = place_joint(joint, np.eye(3))
    low, high = place.size[:2].tolist()
    start = min(max(0.0, low), high)
    near = NEAR_AXIS * _measure_reach(moving, place) if motion == "hinge" else -1.0
    bodies = {hull.name: hull.body for hull in mesh.hulls}
    for end in (low, high):
        known: set[frozenset[str]] | None = None
        way = Place(place.at, np.array([start, end, 0.0]), place.axes)
        for at, touches in watch_joint(moving, rest, way, least, motion) if end != start else ():
            pairs = {touch.pair: touch for touch in reversed([*touches]) if touch.pair not in apart}
            if known is None:
                known = set(pairs)
            touch = max(
                (one for pair, one in pairs.items() if pair not in known and not _is_pin(one, place, near)),
                key=lambda one: one.depth,
                default=None,
            )
            if touch is None:
                continue
            moved, other = (name.rpartition(" (")[0] for name in (touch.mover, touch.other))
            share = abs(at - start) / abs(end - start)
            rigid = tree.rigid_roots()
            alone = rigid[bodies[moved]] == rigid[joint.child] and rigid[bodies[other]] == rigid[joint.parent]
            text = describe_place(at, motion)
            certain = alone and share < NEARLY
            yield JointBlock(joint.name or joint.child, (moved, other), share, text, touch.depth, certain)
            break


def _measure_reach(moving: Sequence[Hull], place: Place) -> float:
    points: Floats = np.concatenate([hull.vertices for hull in moving]) - place.at
    return float(np.linalg.norm(np.cross(points, place.axes[:, 0]), axis=1).max())


def _is_pin(touch: Touch, place: Place, near: float) -> bool:
    return float(np.linalg.norm(np.cross(touch.at - place.at, place.axes[:, 0]))) <= near


def check_joint_limits(joints: Sequence[Joint]) -> Iterator[Finding]:
    """Yield an error on joints whose limits leave them no way to move."""
    found = {joint.name or joint.child: joint.empty_limits or joint.limits for joint in joints}
    texts = [f"{name} ({both[0]:g} to {both[1]:g})" for name, both in found.items() if both and not both[0] < both[1]]
    if texts:
        message = f"joints whose limits leave them no way to go, which engines take for none: {join_names(texts, 5)}"
        yield Finding("physics-limits", "error", (), message, "Write the lower limit first; or make the joint fixed.")


def report_blocks(blocks: Sequence[JointBlock]) -> Iterator[Finding]:
    """Yield joints that do not come through their range: an error for those that surely do not."""
    for certain in (True, False):
        some = [block for block in blocks if block.certain is certain]
        texts = [f"{b.joint} ({b.text} {b.hulls[0]} is {mm(b.depth)} in {b.hulls[1]})" for b in some]
        if some:
            may = "do" if certain else "may"
            message = f"joints {may} not move through their range: {join_names(texts, 3)}"
            names = tuple(dict.fromkeys(name for block in some for name in block.hulls))
            remedy = "Shrink or move one of the two, correct the limits, or exclude the pair from contact in the file."
            yield Finding("physics-motion", "error" if certain else "warning", names, message, remedy)
