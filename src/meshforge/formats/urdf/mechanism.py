"""The joints and masses that a URDF tells, in the root frame. What is not understood of them never stops a reading."""

from __future__ import annotations

import numpy as np

from meshforge.asset import Inertial, Joint, JointKind, Mechanism, unit
from meshforge.errors import AssetError
from meshforge.formats.urdf.kinematics import Links
from meshforge.formats.urdf.numbers import floats, origin
from meshforge.formats.xml import Element
from meshforge.geometry import Floats, Pose

_KINDS: dict[str, JointKind] = {
    "fixed": "fixed",
    "revolute": "revolute",
    "continuous": "revolute",
    "prismatic": "prismatic",
    "floating": "floating",
    "planar": "planar",
    "spherical": "ball",  # of Bullet
}
_MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


def read_mechanism(robot: Element, links: Links) -> Mechanism:
    """The mechanism of a `<robot>` whose links are placed; a joint of unknown type counts as fixed."""
    joints = tuple(_joint(element, links) for element in robot.each("joint"))
    inertials = (_inertial(name, link, links.poses[name]) for name, link in links.elements.items())
    return Mechanism(joints, tuple(i for i in inertials if i is not None))


def _joint(element: Element, links: Links) -> Joint:
    """A `<joint>`; its frame is that of its child link."""
    parent, child = (_end(element, role) for role in ("parent", "child"))
    type_ = element.attributes.get("type", "fixed")
    pose = links.poses[child]
    axis = unit(_vector(element.first("axis"), "xyz", (1.0, 0.0, 0.0)))
    limit, dynamics = element.first("limit"), element.first("dynamics")
    return Joint(
        element.attributes.get("name", ""),
        _KINDS.get(type_, "fixed"),
        parent,
        child,
        pose.translation,
        pose.rotation @ (np.array([1.0, 0.0, 0.0]) if axis is None else axis),
        _limits(limit) if type_ in ("revolute", "prismatic") else None,
        damping=_number(dynamics, "damping") or 0.0,
        friction=_number(dynamics, "friction") or 0.0,
        effort=_number(limit, "effort") or None,
        velocity=_number(limit, "velocity") or None,
    )


def _end(joint: Element, role: str) -> str:
    end = joint.first(role)
    assert end is not None  # `read_links` saw both
    return end.attributes["link"]


def _limits(limit: Element | None) -> tuple[float, float] | None:
    """The range; none where it is empty, as MuJoCo reads that."""
    lower, upper = _number(limit, "lower") or 0.0, _number(limit, "upper") or 0.0
    return (lower, upper) if lower < upper else None


def _inertial(name: str, link: Element, root_t_link: Pose) -> Inertial | None:
    element = link.first("inertial")
    mass = _number(element.first("mass"), "value") if element else None
    if element is None or mass is None or mass <= 0:
        return None
    try:
        pose = root_t_link @ origin(element, "")
    except AssetError:
        pose = root_t_link
    tensor = element.first("inertia")
    xx, xy, xz, yy, yz, zz = (_number(tensor, moment) or 0.0 for moment in _MOMENTS)
    inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    return Inertial(name, mass, pose.translation, pose.rotation @ inertia @ pose.rotation.T)


def _number(element: Element | None, attribute: str) -> float | None:
    """A number, None where there is none that can be read."""
    if element is None or attribute not in element.attributes:
        return None
    try:
        return float(floats(element, attribute, 1, "")[0])
    except AssetError:
        return None


def _vector(element: Element | None, attribute: str, default: tuple[float, float, float]) -> Floats:
    if element is None:
        return np.array(default)
    try:
        return floats(element, attribute, 3, "", default)
    except AssetError:
        return np.array(default)
