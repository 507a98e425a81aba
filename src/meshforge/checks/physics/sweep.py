"""Joints moved through their range: limits between which nothing moves, and what stands in the way."""

from collections.abc import Iterator

import numpy as np

from meshforge.checks.physics.mechanism import ContactRules, JointTree, explain_untried, place_joint
from meshforge.checks.physics.scene import Place, mm
from meshforge.common import join_names
from meshforge.engines import Finding, Severity
from meshforge.symbolic import Joint, SymbolicMesh

NEAR_AXIS = 0.2
"""Of the reach of what turns, the distance from its axis within which it may be in its neighbour: pins, and the edge of
a leaf that turns into the wall it hangs on."""
NEARLY = 0.9
"""Of the way from rest to a limit: what stops a joint later is doubtful only, as limits are often generous."""
_REMEDY = "Shrink or move one of the two, correct the limits, or exclude the pair from contact in the file."


def check_joints(mesh: SymbolicMesh, tree: JointTree, least: float) -> Iterator[Finding]:
    """Yield an error on joints whose limits leave them no way to move, and on those that do not come through their
    range while the others are at rest; a warning where that is doubtful. least: how deep hulls are in each other [m].

    What is in each other at rest does not count, nor what the file keeps apart, nor what is around the axis of a hinge.
    Joints that follow others, or have no limits, are not moved.
    """
    joints = mesh.asset.mechanism.joints if mesh.asset else ()
    ends = {joint.name or joint.child: joint.empty_limits or joint.limits for joint in joints}
    if empty := [f"{name} ({both[0]:g} to {both[1]:g})" for name, both in ends.items() if both and both[0] >= both[1]]:
        message = f"joints whose limits leave them no way to go, which engines take for none: {join_names(empty, 5)}"
        yield Finding("physics-limits", "error", (), message, "Write the lower limit first; or make the joint fixed.")
    rules, hulls = ContactRules(mesh), mesh.hulls
    pairs = ((i, j) for i in range(len(hulls)) for j in range(i) if hulls[i].body != hulls[j].body)
    apart = {frozenset((hulls[i].name, hulls[j].name)) for i, j in pairs if not rules.may_touch(i, j)}
    found: dict[Severity, list[tuple[str, list[str]]]] = {"error": [], "warning": []}
    for joint in (joint for own in tree.joints.values() for joint in own):
        if explain_untried(joint) is None and joint.limits is not None and joint.limits[0] < joint.limits[1]:
            for severity, text, pair in _find_blocks(mesh, tree, joint, least, apart):
                found[severity].append((f"{joint.name or joint.child} ({text})", pair))
    for severity, blocks in found.items():
        if blocks:
            texts, verb = join_names([text for text, _ in blocks], 3), "do" if severity == "error" else "may"
            names = tuple(dict.fromkeys(name for _, pair in blocks for name in pair))
            yield Finding(
                "physics-motion", severity, names, f"joints {verb} not move through their range: {texts}", _REMEDY
            )


def _find_blocks(
    mesh: SymbolicMesh, tree: JointTree, joint: Joint, least: float, apart: set[frozenset[str]]
) -> Iterator[tuple[Severity, str, list[str]]]:
    """The first thing in the way of a joint to either side: an error where no other joint moves one of the two out of
    the way, and it stops well before the limit."""
    from meshforge.checks.physics.motion import describe_place, watch_joint  # lazy: MuJoCo takes 0.3 s

    below, rigid = set(tree.list_below(joint.child)), tree.rigid_roots()
    moving = [hull for hull in mesh.hulls if hull.body in below]
    rest = [hull for hull in mesh.hulls if hull.body not in below]
    if not moving or not rest:
        return
    place, motion = place_joint(joint, np.eye(3))
    start = float(np.clip(0.0, *place.size[:2]))
    near = NEAR_AXIS * max(joint.measure_distance(hull.vertices) for hull in moving) if motion == "hinge" else -1.0
    groups = {hull.name: rigid[hull.body] for hull in mesh.hulls}
    for end in (float(end) for end in place.size[:2] if end != start):
        way, known = Place(place.at, np.array([start, end, 0.0]), place.axes), apart
        for at, touches in watch_joint(moving, rest, way, least, motion):
            seen = [touch for touch in touches if touch.pair not in known]
            known = known | {touch.pair for touch in seen} if at == start else known
            far = (one for one in seen if one.pair not in known and joint.measure_distance(one.at[None]) > near)
            if touch := next(far, None):
                names = [name.rpartition(" (")[0] for name in (touch.mover, touch.other)]
                alone = [groups[name] for name in names] == [rigid[joint.child], rigid[joint.parent]]
                early = abs(at - start) < NEARLY * abs(end - start)
                text = f"{describe_place(at, motion)} {names[0]} is {mm(touch.depth)} in {names[1]}"
                yield "error" if alone and early else "warning", text, names
                break
