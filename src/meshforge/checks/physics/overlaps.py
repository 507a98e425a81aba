"""Bodies that reach into each other before anything moves, or as a joint goes through its range; and pieces of a body
that touch nothing of it."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np

from meshforge import geometry
from meshforge.checks.physics.mechanism import ContactRules, JointTree, explain_untried, place_joint
from meshforge.checks.physics.model import FLOOR, compile_model, pose_on_floor
from meshforge.checks.physics.scene import Motion, Place, Touch, mm
from meshforge.common import GeometryError, join_names
from meshforge.engines import Finding, Severity
from meshforge.symbolic import Hull, Joint, SymbolicMesh, contact_graph

WITHOUT_BODIES = ("obj", "stl", "ply", "wrl", "folder")
"""Formats that say neither what is a body nor what is up: their files may be parts."""
DEEP = 0.005
"""Hulls of two bodies that reach into each other by more than this share of the diagonal are findings."""
JAMMED = 0.02
"""Of the diagonal: bodies that a joint holds may be in each other by so much, as most engines let these pass; drawers
are in sound cabinets of the corpus by 1.7%."""
WITHIN = 0.5
"""Of the volume of the smaller of two joined bodies: one that is in the other by more leaves no room between them."""
FLOATING, LOOSE = 0.05, 0.02
"""Of the diagonal: the gap around a piece that touches nothing of its body, an error and a warning."""
NEAR_AXIS = 0.2
"""Of the reach of what turns, the distance from its axis within which it may be in its neighbour: pins, and the edge of
a leaf that turns into the wall it hangs on."""
NEARLY = 0.9
"""Of the way from rest to a limit: what stops a joint later is doubtful only, as limits are often generous."""
_REMEDY = "Shrink or move one of the two, correct the limits, or exclude the pair from contact in the file."


@dataclass(frozen=True, slots=True)
class BodyOverlap:
    """Two bodies that reach into each other at rest pose; depth: at most [m]; joined: whether a joint holds them.

    excluded: whether the file lets these hulls pass through each other, so that it does no harm; share: of the smaller
    body's volume, what is in the other one, where they are joined; at_axis: whether they are so around the axis of a
    hinge between them, or the centre of a ball, where they may be.
    """

    bodies: tuple[str, str]
    hulls: tuple[str, str]
    depth: float
    joined: bool
    excluded: bool = False
    share: float = 0.0
    at_axis: bool = False

    def is_wrong(self, scale: float) -> bool:
        """Return whether it cannot be meant; scale: the diagonal [m]."""
        is_jammed = self.depth > JAMMED * scale or self.share > WITHIN
        return self.depth > DEEP * scale and not (self.excluded or self.at_axis) and (is_jammed or not self.joined)


def find_body_overlaps(mesh: SymbolicMesh, tree: JointTree) -> tuple[BodyOverlap, ...]:
    """Return the deepest contact of each pair of bodies that can move against each other, at rest pose, deepest first.

    Contacts that the file excludes, and those at the axis of a joint between the two, count for themselves. Raises
    ValueError where MuJoCo refuses the model.
    """
    import mujoco  # lazy: 0.3 s, only the physics checks need it

    model = compile_model(mesh, tree, everything=True)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    names = [model.geom(g).name for g in range(model.ngeom)]
    numbers = [-1 if name == FLOOR else int(name.rpartition(" ")[2]) for name in names]
    rigid, touching, back = tree.rigid_roots(), ContactRules(mesh), pose_on_floor(mesh).inverse()
    found: dict[tuple[str, str, bool, bool], BodyOverlap] = {}
    between: dict[tuple[str, str], list[tuple[Joint, float]]] = {}
    for contact in data.contact[: data.ncon]:
        first, second = sorted(numbers[int(g)] for g in contact.geom)
        if first < 0 or contact.dist >= 0:
            continue
        a, b = mesh.hulls[first], mesh.hulls[second]
        pair, depth = (rigid[a.body], rigid[b.body]), -float(contact.dist)
        if pair[0] == pair[1]:
            continue
        if pair not in between:
            between[pair] = _find_joints_between(mesh, tree, rigid, *pair)
        joints, at = between[pair], back.apply(np.array(contact.pos)[None])
        at_axis = any(joint.measure_distance(at) <= near for joint, near in joints)
        key = a.body, b.body, not touching.may_touch(first, second), at_axis
        if key not in found or found[key].depth < depth:
            found[key] = BodyOverlap(key[:2], (a.name, b.name), depth, bool(joints), key[2], at_axis=at_axis)
    least = DEEP * mesh.diagonal
    measured = (
        replace(one, share=_measure_share(mesh, one)) if one.joined and one.depth > least and not one.at_axis else one
        for one in found.values()
    )
    return tuple(sorted(measured, key=lambda overlap: (-overlap.depth, overlap.bodies)))


def _find_joints_between(
    mesh: SymbolicMesh, tree: JointTree, rigid: Mapping[str, str], first: str, second: str
) -> list[tuple[Joint, float]]:
    """The joints of two rigid groups of bodies, by their highest bodies, one of which hangs on the other; each with the
    distance from its axis, or from the centre of a ball, within which the two may be in each other [m]."""
    for child, parent in ((first, second), (second, first)):
        if child in tree.above and rigid[tree.above[child]] == parent:
            below = set(tree.list_below(child))
            hulls = [hull for hull in mesh.hulls if hull.body in below]
            return [(joint, measure_near(joint, hulls)) for joint in tree.joints[child]]
    return []


def measure_near(joint: Joint, moving: Sequence[Hull]) -> float:
    """Return how far from the axis of a joint what it turns may be in its neighbour [m]; below 0 where it slides."""
    turns = joint.kind in ("revolute", "ball")
    return NEAR_AXIS * max(joint.measure_distance(hull.vertices) for hull in moving) if turns else -1.0


def _measure_share(mesh: SymbolicMesh, overlap: BodyOverlap) -> float:
    """Of the volume of the smaller of two bodies, what is in the other one."""
    small, large = sorted(
        ([hull for hull in mesh.hulls if hull.body == body] for body in overlap.bodies),
        key=lambda hulls: sum(hull.volume for hull in hulls),
    )
    shared = sum(
        min(
            hull.volume,
            sum(geometry.overlap_volume(hull.shape, other.shape) for other in large if hull.aabb.touches(other.aabb)),
        )
        for hull in small
    )
    return shared / sum(hull.volume for hull in small)


def report_overlaps(overlaps: Sequence[BodyOverlap], scale: float) -> Iterator[Finding]:
    """Yield errors on bodies that cannot be meant to be in each other, warnings on others; scale: the diagonal [m]."""
    deep = [one for one in overlaps if one.depth > DEEP * scale and not one.excluded]
    wrong = [one for one in deep if one.is_wrong(scale)]
    doubtful = [one for one in deep if one not in wrong]
    kinds: tuple[tuple[Severity, list[BodyOverlap]], ...] = (("error", wrong), ("warning", doubtful))
    for severity, some in kinds:
        texts = [f"{o.hulls[0]} and {o.hulls[1]} ({mm(o.depth)}{', joined' if o.joined else ''})" for o in some]
        if texts:
            names = tuple(dict.fromkeys(name for overlap in some for name in overlap.hulls))
            message = f"hulls of bodies that move against each other overlap at rest: {join_names(texts)}"
            remedy = "Shrink or delete one, or exclude the pair from contact in the file."
            yield Finding("physics-overlap", severity, names, message, remedy)


def check_loose_pieces(mesh: SymbolicMesh, tree: JointTree) -> Iterator[Finding]:
    """Yield an error on pieces of bodies that float, a warning on those that are nearer to what they touch nothing of.

    Not on those of bodies that are fixed to the world, nor of formats in which all is one body because nothing else is
    said. Non-convex pieces may be between them: they count as their convex hulls.
    """
    if mesh.asset is not None and mesh.asset.format in ("gltf", *WITHOUT_BODIES):
        return
    rigid, left = tree.rigid_roots(), set[str]()
    hulls = [*mesh.hulls, *_enclose_pieces(mesh)]
    graph = contact_graph([hull.shape for hull in hulls], FLOATING * mesh.diagonal)
    kinds: tuple[tuple[Severity, float], ...] = (("error", FLOATING), ("warning", LOOSE))
    for severity, reach in kinds:
        pairs = [pair for pair, gap in graph.items() if gap <= reach * mesh.diagonal]
        alone = [(body, part) for body, part in _list_small_parts(hulls, rigid, pairs) if body != "world"]
        texts = [f"{join_names(part, 3)} of {body}" for body, part in alone if not left & {*part}]
        names = tuple(name for _, part in alone for name in part if not left & {*part})
        if texts:
            message = f"pieces that touch nothing of their body: {join_names(texts, 3)}"
            yield Finding("physics-loose", severity, names, message, "Move them, join them by a hull, or delete them.")
        left |= {*names}


def _enclose_pieces(mesh: SymbolicMesh) -> Iterator[Hull]:
    """Hulls around the non-convex pieces of a mesh that are no planes and span a volume."""
    for piece in mesh.asset.non_convex if mesh.asset else ():
        if piece.surface is not None and piece.plane is None:
            with suppress(GeometryError):
                yield Hull(piece.name, piece.body, geometry.convex_hull(piece.surface.vertices, name=piece.name))


def _list_small_parts(
    hulls: Sequence[Hull], rigid: Mapping[str, str], pairs: Sequence[tuple[int, int]]
) -> Iterator[tuple[str, list[str]]]:
    """Rigid groups of bodies, and the names of hulls that hang together by pairs, without the largest part of each."""
    part = {k: [k] for k in range(len(hulls))}
    for first, second in pairs:
        if rigid[hulls[first].body] == rigid[hulls[second].body] and part[first] is not part[second]:
            part[first] += part[second]
            part |= dict.fromkeys(part[second], part[first])
    found = sorted({id(one): one for one in part.values()}.values(), key=lambda one: -sum(hulls[k].volume for k in one))
    seen = set[str]()
    for one in found:
        body = rigid[hulls[one[0]].body]
        if body in seen:
            yield body, [hulls[k].name for k in one]
        seen.add(body)


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
    found: dict[Severity, list[tuple[str, list[str]]]] = {"error": [], "warning": []}
    for sweep in list_sweeps(mesh, tree, least):
        if block := _find_block(sweep, tree):
            severity, text, pair = block
            found[severity].append((f"{sweep.joint.name or sweep.joint.child} ({text})", pair))
    for severity, blocks in found.items():
        if blocks:
            texts, verb = join_names([text for text, _ in blocks], 3), "do" if severity == "error" else "may"
            names = tuple(dict.fromkeys(name for _, pair in blocks for name in pair))
            yield Finding(
                "physics-motion", severity, names, f"joints {verb} not move through their range: {texts}", _REMEDY
            )


@dataclass(frozen=True, eq=False, slots=True)
class JointSweep:
    """A joint on its way from rest to one of its limits, the others at rest; moving, still: hulls.

    start, end: of the way, in degrees of a hinge, metres of a slide; looks: what is in each other where on it, but for
    hulls that the file keeps apart.
    """

    joint: Joint
    motion: Motion
    start: float
    end: float
    moving: tuple[Hull, ...]
    still: tuple[Hull, ...]
    looks: Iterator[tuple[float, list[Touch]]]


def list_sweeps(mesh: SymbolicMesh, tree: JointTree, least: float) -> Iterator[JointSweep]:
    """Yield each joint that has limits and follows no other one, to either side; least: the depth [m]."""
    rules, hulls = ContactRules(mesh), mesh.hulls
    pairs = ((i, j) for i in range(len(hulls)) for j in range(i) if hulls[i].body != hulls[j].body)
    apart = {frozenset((hulls[i].name, hulls[j].name)) for i, j in pairs if not rules.may_touch(i, j)}
    for joint in (joint for own in tree.joints.values() for joint in own):
        below = set(tree.list_below(joint.child))
        moving = tuple(hull for hull in hulls if hull.body in below)
        still = tuple(hull for hull in hulls if hull.body not in below)
        limits = joint.limits or (0.0, 0.0)
        if explain_untried(joint) is None and limits[0] < limits[1] and moving and still:
            place, motion = place_joint(joint, np.eye(3))
            start = float(np.clip(0.0, *place.size[:2]))
            for end in (float(end) for end in place.size[:2] if end != start):
                way = Place(place.at, np.array([start, end, 0.0]), place.axes)
                looks = _watch(moving, still, way, least, motion, apart)
                yield JointSweep(joint, motion, start, end, moving, still, looks)


def _watch(
    moving: Sequence[Hull], still: Sequence[Hull], way: Place, least: float, motion: Motion, apart: set[frozenset[str]]
) -> Iterator[tuple[float, list[Touch]]]:
    from meshforge.checks.physics.motion import watch_joint  # lazy: MuJoCo takes 0.3 s

    for at, touches in watch_joint(moving, still, way, least, motion):
        yield at, [touch for touch in touches if touch.pair not in apart]


def _find_block(sweep: JointSweep, tree: JointTree) -> tuple[Severity, str, list[str]] | None:
    """The first thing in the way of a joint: an error where no other joint moves one of the two out of the way, and it
    stops well before the limit. What is in each other at the start does not count, nor what is around an axis."""
    from meshforge.checks.physics.motion import describe_place  # lazy: as above

    joint, known, near = sweep.joint, set[frozenset[str]](), measure_near(sweep.joint, sweep.moving)
    for at, touches in sweep.looks:
        known |= {touch.pair for touch in touches} if at == sweep.start else set()
        far = (one for one in touches if one.pair not in known and joint.measure_distance(one.at[None]) > near)
        if touch := next(far, None):
            names = [name.rpartition(" (")[0] for name in (touch.mover, touch.other)]
            groups = {hull.name: hull.body for hull in (*sweep.moving, *sweep.still)}
            rigid = tree.rigid_roots()
            alone = [rigid[groups[name]] for name in names] == [rigid[joint.child], rigid[joint.parent]]
            early = abs(at - sweep.start) < NEARLY * abs(sweep.end - sweep.start)
            text = f"{describe_place(at, sweep.motion)} {names[0]} is {mm(touch.depth)} in {names[1]}"
            return "error" if alone and early else "warning", text, names
    return None
