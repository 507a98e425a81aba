"""The joints that an SDF tells, in the root frame. What is not understood of them never stops a reading."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from meshforge.asset import Body, Joint, JointKind, unit
from meshforge.errors import AssetError
from meshforge.formats.sdf.files.values import is_true, text_of, values
from meshforge.formats.sdf.files.version import AXIS_IN_JOINT
from meshforge.formats.sdf.reading.compose import Composed
from meshforge.formats.sdf.reading.frames import WORLD, Scope
from meshforge.formats.sdf.reading.links import Links
from meshforge.formats.xml import Element, numbers
from meshforge.geometry import Floats, Pose
from meshforge.words import counted, listed

_KINDS: dict[str, tuple[JointKind, ...]] = {
    "fixed": ("fixed",),
    "revolute": ("revolute",),
    "continuous": ("revolute",),
    "screw": ("revolute",),
    "prismatic": ("prismatic",),
    "ball": ("ball",),
    "universal": ("revolute", "revolute"),
    "revolute2": ("revolute", "revolute"),
}
_ENDLESS = 1e15  # limits beyond mean none


@dataclass(slots=True)
class Joints:
    """The joints, the body of the world where one holds on to it, and what a user should know."""

    joints: list[Joint] = field(default_factory=list)
    world: tuple[Body, ...] = ()
    notes: list[str] = field(default_factory=list)


def read_joints(composed: Composed, links: Links) -> Joints:
    """The joints of all models that make trees of their bodies; those that close rings are told."""
    found = Joints()
    parents: dict[str, str] = {}
    passed: list[str] = []
    taken: list[str] = []
    for scope in composed.scopes():
        for element in scope.element.each("joint"):
            name = f"{scope.prefix}{element.attributes.get('name', '')}"
            type_ = element.attributes.get("type", "")
            ends = [_body(scope, text_of(element, role), links) for role in ("parent", "child")]
            parent, child = ends
            if type_ not in _KINDS or parent is None or child is None or child == WORLD or parent == child:
                passed.append(name)
            elif child in parents or _leads_to(parents, parent, child):
                taken.append(name)
            else:
                parents[child] = parent
                found.joints += _joints(scope, element, name, parent, child, links)
                if type_ == "screw":
                    found.notes.append(f"joint {name!r} is a screw: it is taken for one that turns only")
    if any(joint.parent == WORLD for joint in found.joints):
        found.world = (Body(WORLD, Pose.identity()),)
    if passed:
        found.notes.append(f"{counted(len(passed), 'joint')} passed over, not understood ({listed(passed, 3)})")
    if taken:
        found.notes.append(f"{counted(len(taken), 'joint')} passed over, which would close a ring ({listed(taken, 3)})")
    return found


def _leads_to(parents: dict[str, str], body: str, wanted: str) -> bool:
    """Whether a body hangs, at any depth, on another."""
    at: str | None = body
    while at is not None:
        if at == wanted:
            return True
        at = parents.get(at)
    return False


def _body(scope: Scope, name: str, links: Links) -> str | None:
    """The body that a name in a joint stands for: a link, or what a frame moves with; None where it is not there."""
    if name == WORLD:
        return WORLD if WORLD not in links.by_body else None
    seen = set()
    at, rest = scope, name
    while True:
        try:
            path = at.resolve(rest, "")
        except AssetError:
            return None
        frame = path[-1] if path else None
        inner = frame.inside if frame else at
        if frame is not None and frame in seen:
            return None
        if inner is not None:  # a model: its first link, or the one it names
            rest = inner.element.attributes.get("canonical_link", "") or next(iter(inner.links), "")
            at = inner
            if not rest:
                return None
        else:
            assert frame is not None
            if frame.link:
                own = next(key for key, value in frame.scope.frames.items() if value is frame)
                return f"{frame.scope.prefix}{own}"
            at, rest = frame.scope, frame.attached
        if frame is not None:
            seen.add(frame)


def _joints(scope: Scope, element: Element, name: str, parent: str, child: str, links: Links) -> Sequence[Joint]:
    """The joints of a `<joint>`, one after another; its frame is that of the child unless it tells another."""
    type_ = element.attributes["type"]
    own, where = element.attributes.get("name", ""), f"{scope.where}:{element.line}"
    try:
        pose = links.places.pose_of(scope, own, where) if own in scope.frames else links.by_body[child].pose
    except AssetError:
        pose = links.by_body[child].pose
    kinds = _KINDS[type_]
    found = []
    for kind, tag in zip(kinds, ("axis", "axis2"), strict=False):
        axis = element.first(tag)
        limit, dynamics = (axis.first("limit"), axis.first("dynamics")) if axis else (None, None)
        found.append(
            Joint(
                name if tag == "axis" else f"{name}_2",
                kind,
                parent,
                child,
                pose.translation,
                _axis(scope, axis, pose, links),
                _limits(limit) if kind in ("revolute", "prismatic") and type_ != "continuous" else None,
                damping=_number(dynamics, "damping") or 0.0,
                friction=_number(dynamics, "friction") or 0.0,
                effort=_positive(_number(limit, "effort")),
                velocity=_positive(_number(limit, "velocity")),
            )
        )
    return found


def _axis(scope: Scope, axis: Element | None, pose: Pose, links: Links) -> Floats:
    """The direction of an axis, told in the joint's frame, or in the one that it names."""
    xyz = axis.first("xyz") if axis else None
    try:
        direction = unit(values(xyz, 3, "")) if xyz else None
    except AssetError:
        direction = None
    turn = pose.rotation
    if axis is not None and xyz is not None:
        in_model = is_true(text_of(axis, "use_parent_model_frame", "1" if scope.version < AXIS_IN_JOINT else "0"))
        frame = xyz.attributes.get("expressed_in", "") or ("__model__" if in_model else "")
        if frame and scope.has(frame):
            turn = links.places.pose_of(scope, frame, scope.where).rotation
    told: Floats = turn @ (np.array([0.0, 0.0, 1.0]) if direction is None else direction)
    return told


def _limits(limit: Element | None) -> tuple[float, float] | None:
    """The range; none where it is empty or has no end."""
    lower, upper = _number(limit, "lower"), _number(limit, "upper")
    low, high = -np.inf if lower is None else lower, np.inf if upper is None else upper
    if not low < high or low <= -_ENDLESS or high >= _ENDLESS:
        return None
    return low, high


def _positive(value: float | None) -> float | None:
    """A largest effort or velocity; negative ones mean none."""
    return value if value is not None and 0 < value < _ENDLESS else None


def _number(parent: Element | None, tag: str) -> float | None:
    found = numbers(text_of(parent, tag))
    return found[0] if found and len(found) == 1 else None
