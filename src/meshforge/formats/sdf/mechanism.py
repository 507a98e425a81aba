"""Joints and masses of an SDF in the root frame."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from meshforge.common import AssetError, join_names, pluralize
from meshforge.formats.kinematic_tree import TENSOR_NAMES, tensor_of_moments
from meshforge.formats.sdf.document import AXIS_IN_JOINT
from meshforge.formats.sdf.frames import MODEL, WORLD, is_computed, is_true, pose_of, read_values, text_of
from meshforge.formats.sdf.models import ModelScope, ModelTree
from meshforge.formats.xml import Element, parse_numbers
from meshforge.geometry import Floats, Pose
from meshforge.symbolic import Coupling, Inertial, Joint, JointKind, unit_vector

_KINDS: dict[str, JointKind] = {
    "fixed": "fixed",
    "revolute": "revolute",
    "continuous": "revolute",
    "prismatic": "prismatic",
    "ball": "ball",
}
_ENDLESS = 1e15  # limits beyond mean none
_UNIT_TENSOR = (1.0, 0.0, 0.0, 1.0, 0.0, 1.0)


def read_joints(tree: ModelTree) -> tuple[list[Joint], list[str]]:
    """Return the joints of all models that make trees of their bodies, and notes on those that are passed over."""
    joints, notes = list[Joint](), list[str]()
    parents: dict[str, str] = {}
    passed: dict[str, list[str]] = {"not understood": [], "which would close a ring": []}
    for scope in tree.scopes:
        for element in scope.element.each("joint"):
            name = f"{scope.prefix}{element.attributes.get('name', '')}"
            type_ = element.attributes.get("type", "")
            parent, child = (_find_body(tree, scope, text_of(element, role)) for role in ("parent", "child"))
            if type_ not in _KINDS or parent is None or child is None or child == WORLD or parent == child:
                passed["not understood"].append(name)
                continue
            above: str | None = parent
            while above not in (None, child):
                above = parents.get(above or "")
            if child in parents or above == child:
                passed["which would close a ring"].append(name)
                continue
            parents[child] = parent
            joints.append(_read_joint(tree, scope, element, name, parent, child))
    for why, names in passed.items():
        if names:
            notes.append(f"{pluralize(len(names), 'joint')} passed over, {why} ({join_names(names, 3)})")
    return joints, notes


def _find_body(tree: ModelTree, scope: ModelScope, name: str) -> str | None:
    """The body that a name in a joint stands for: a link, or what a frame moves with; None where it is not there."""
    if name == WORLD:
        return WORLD if WORLD not in tree.links else None
    return tree.frames.find_body(scope.path, name)


def _read_joint(tree: ModelTree, scope: ModelScope, element: Element, name: str, parent: str, child: str) -> Joint:
    """The joint of an element; its frame is that of the child unless it names another."""
    type_ = element.attributes["type"]
    at, axis = pose_of(element, scope.where), element.first("axis")
    base, place = at.base or text_of(element, "child"), f"{scope.where}:{at.line}"
    pose = tree.frames.pose_of(scope.path, base, place) @ at.pose
    limit, dynamics = (axis.first("limit"), axis.first("dynamics")) if axis else (None, None)
    return Joint(
        name,
        _KINDS[type_],
        parent,
        child,
        pose.translation,
        _read_axis(tree, scope, axis, pose),
        _read_limits(limit) if type_ in ("revolute", "prismatic") else None,
        damping=_number_or(dynamics, "damping", 0.0),
        friction=_number_or(dynamics, "friction", 0.0),
        effort=_positive_or_none(_read_number(limit, "effort")),
        velocity=_positive_or_none(_read_number(limit, "velocity")),
        coupling=_read_coupling(scope, axis.first("mimic")) if axis else None,
    )


def _read_coupling(scope: ModelScope, mimic: Element | None) -> Coupling | None:
    if mimic is None:
        return None
    joint, factor = f"{scope.prefix}{mimic.attributes.get('joint', '')}", _number_or(mimic, "multiplier", 1.0)
    return Coupling(joint, (_number_or(mimic, "offset", 0.0) - factor * _number_or(mimic, "reference", 0.0), factor))


def _read_axis(tree: ModelTree, scope: ModelScope, axis: Element | None, pose: Pose) -> Floats:
    """The direction (3,) of an axis in the root frame; given in the joint's frame, or the one that it names."""
    xyz = axis.first("xyz") if axis else None
    try:
        direction = unit_vector(read_values(xyz, 3, "")) if xyz else None
    except AssetError:
        direction = None
    turn = pose.rotation
    if axis is not None and xyz is not None:
        in_model = is_true(
            text_of(axis, "use_parent_model_frame", "1" if scope.source.version < AXIS_IN_JOINT else "0")
        )
        frame = xyz.attributes.get("expressed_in", "") or (MODEL if in_model else "")
        if frame:
            turn = tree.frames.pose_of(scope.path, frame, f"{scope.where}:{xyz.line}").rotation
    return np.asarray(turn @ (np.array([0.0, 0.0, 1.0]) if direction is None else direction))


def _read_limits(limit: Element | None) -> tuple[float, float] | None:
    lower, upper = _read_number(limit, "lower"), _read_number(limit, "upper")
    low, high = -np.inf if lower is None else lower, np.inf if upper is None else upper
    if not low < high or low <= -_ENDLESS or high >= _ENDLESS:
        return None
    return low, high


def _positive_or_none(value: float | None) -> float | None:
    """A largest effort or velocity; negative ones mean none."""
    return value if value is not None and 0 < value < _ENDLESS else None


def _read_number(parent: Element | None, tag: str) -> float | None:
    found = parse_numbers(text_of(parent, tag))
    return found[0] if found and len(found) == 1 else None


def read_masses(tree: ModelTree) -> Iterator[Inertial]:
    """Yield the masses that the file says; not those that Gazebo computes of collisions. Raises AssetError."""
    for body, link in tree.links.items():
        element = link.element.first("inertial")
        mass = _number_or(element, "mass", 1.0)
        if element is None or is_computed(element) or mass <= 0:
            continue
        pose = tree.pose_in_link(link, element)
        tensor = element.first("inertia")
        moments = [_number_or(tensor, name, one) for name, one in zip(TENSOR_NAMES, _UNIT_TENSOR, strict=True)]
        yield Inertial(body, mass, pose.translation, pose.rotation @ tensor_of_moments(moments) @ pose.rotation.T)


def _number_or(parent: Element | None, tag: str, default: float) -> float:
    found = _read_number(parent, tag)
    return default if found is None else found
