"""What is kept of a URDF to write it back, and how its XML is read: links where they are at zero, joints, masses."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from meshforge.common import AssetError, nearest_name
from meshforge.formats import collision_pieces, kinematic_tree
from meshforge.formats.references import Resolver
from meshforge.formats.xml import Element, parse_xml
from meshforge.geometry import Floats, Pose
from meshforge.symbolic import Coupling, Document, Inertial, Joint, JointKind, Mechanism, unit_vector

VISUAL_SUFFIXES = (".obj", ".stl", ".dae")
"""The mesh files that ROS, PyBullet and others read."""


@dataclass(frozen=True, eq=False, slots=True)
class UrdfDocument(Document):
    """The source of an asset read from a URDF.

    source: the authored bytes; authored: one entry a `<collision>`, in order; resolver: finds its files;
    digests: of the mesh files that hold several pieces, so that a file changed since then is noticed.
    """

    source: bytes
    authored: tuple[collision_pieces.CollisionElement, ...]
    resolver: Resolver
    digests: tuple[tuple[Path, str], ...] = ()


def parse_robot(data: bytes, where: str) -> Element:
    """Return the `<robot>` of a URDF text in UTF-8. Raises AssetError: not well formed, or of another kind."""
    root = parse_xml(data, where)
    if root.tag != "robot":
        raise AssetError(f"is no URDF: its root element is <{root.tag}>, not <robot>", where=f"{where}:{root.line}")
    return root


def collisions(robot: Element) -> Iterator[tuple[str, Element]]:
    """Yield the name of the link and the element of each `<collision>`, in the order of the file."""
    for link in robot.each("link"):
        for collision in link.each("collision"):
            yield link.attributes["name"], collision


def references(robot: Element) -> list[str]:
    """Return every mesh and texture reference of the document, in order of mention, each once."""
    found = (e.attributes.get("filename") for e in robot.walk() if e.tag in ("mesh", "texture"))
    return list(dict.fromkeys(reference for reference in found if reference))


def read_floats(
    element: Element, attribute: str, count: int, where: str, default: tuple[float, ...] | None = None
) -> Floats:
    """Return the numbers (count,) of an attribute, `default` where it is left out.

    Raises AssetError with `where:line`: the attribute is missing, of another length, or not of finite numbers.
    """
    place = f"{where}:{element.line}"
    text = element.attributes.get(attribute)
    if text is None:
        if default is None:
            raise AssetError(f"<{element.tag}> has no attribute {attribute!r}", where=place)
        return np.array(default, dtype=np.float64)
    given = f"<{element.tag} {attribute}={text!r}>"
    if "${" in text:
        raise AssetError(f"{given} is a xacro expression", where=place, remedy="Expand the file with xacro first.")
    return kinematic_tree.read_numbers(text, count, given, place)


def read_origin(element: Element, where: str) -> Pose:
    """Return the pose of an element's first `<origin>`, identity where there is none."""
    place = element.first("origin")
    if place is None:
        return Pose.identity()
    zero = (0.0, 0.0, 0.0)
    xyz, rpy = (read_floats(place, attribute, 3, where, zero) for attribute in ("xyz", "rpy"))
    return Pose.from_rpy(list(xyz), list(rpy))


JOINT_KINDS: dict[str, JointKind] = {
    **kinematic_tree.COMMON_KINDS,
    "floating": "floating",
    "spherical": "ball",
}  # the last of Bullet
_X = (1.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class UrdfLinks:
    """The links by name in the order of the file, the pose root_T_link of each, and the links without a parent."""

    elements: Mapping[str, Element]
    poses: Mapping[str, Pose]
    roots: tuple[str, ...]


def read_links(robot: Element, where: str) -> UrdfLinks:
    """Return the links of a `<robot>`, placed.

    Raises AssetError with `where:line`: no link, a link without name or named twice, a joint that names a link
    which is not there, a link with two parents, a cycle.
    """
    elements = _collect_links(robot, where)
    joints: dict[str, tuple[Element, str]] = {}  # by child, each with its parent
    for element in robot.each("joint"):
        parent, child = (_read_end(element, role, elements, where) for role in ("parent", "child"))
        if child in joints:
            name, first = element.attributes.get("name", ""), joints[child][0]
            problem = f"two parents: joint {first.attributes.get('name', '')!r} of line {first.line}, and this one"
            raise AssetError(f"joint {name!r}: link {child!r} has {problem}", where=f"{where}:{element.line}")
        joints[child] = element, parent
    poses = _place_links(elements, joints, where)
    return UrdfLinks(elements, {name: poses[name] for name in elements}, tuple(n for n in elements if n not in joints))


def _collect_links(robot: Element, where: str) -> dict[str, Element]:
    found: dict[str, Element] = {}
    for element in robot.each("link"):
        name = element.attributes.get("name")
        if not name:
            raise AssetError("a <link> has no name", where=f"{where}:{element.line}")
        if name in found:
            problem = f"link {name!r} is there twice, first on line {found[name].line}"
            raise AssetError(problem, where=f"{where}:{element.line}", remedy="Rename one of them.")
        found[name] = element
    if not found:
        raise AssetError("there is no <link> in it", where=where)
    return found


def _read_end(joint: Element, role: str, links: Mapping[str, Element], where: str) -> str:
    name, place, end = joint.attributes.get("name", ""), f"{where}:{joint.line}", joint.first(role)
    link = end.attributes.get("link") if end else None
    if link is None:
        raise AssetError(f"joint {name!r} names no {role} link", where=place)
    if link not in links:
        like = nearest_name(link, links)
        remedy = f"The nearest name of a link is {like!r}." if like else None
        raise AssetError(f"joint {name!r}: its {role} link {link!r} is not there", where=place, remedy=remedy)
    return link


def _place_links(
    links: Mapping[str, Element], joints: Mapping[str, tuple[Element, str]], where: str
) -> dict[str, Pose]:
    poses: dict[str, Pose] = {}
    for name in links:
        chain: dict[str, None] = {}
        at = name
        while at not in poses and at in joints and at not in chain:
            chain[at] = None
            at = joints[at][1]
        if at in chain:
            ring = list(chain)[list(chain).index(at) :]
            path = " -> ".join([ring[0], *reversed(ring)])
            raise AssetError(f"the joints form a cycle: {path}", where=f"{where}:{joints[at][0].line}")
        poses.setdefault(at, Pose.identity())
        for link in reversed(chain):
            joint, parent = joints[link]
            poses[link] = poses[parent] @ read_origin(joint, where)
    return poses


def read_mechanism(robot: Element, links: UrdfLinks) -> Mechanism:
    """Return the mechanism of a `<robot>` whose links are placed; a joint of unknown type counts as fixed."""
    joints = tuple(_read_joint(element, links) for element in robot.each("joint"))
    inertials = (_read_inertial(name, link, links.poses[name]) for name, link in links.elements.items())
    return Mechanism(joints, tuple(i for i in inertials if i is not None))


def _read_joint(element: Element, links: UrdfLinks) -> Joint:
    parent, child = (end.attributes["link"] for role in ("parent", "child") if (end := element.first(role)))
    type_ = element.attributes.get("type", "fixed")
    pose = links.poses[child]
    limit, dynamics = element.first("limit"), element.first("dynamics")
    return Joint(
        element.attributes.get("name", ""),
        JOINT_KINDS.get(type_, "fixed"),
        parent,
        child,
        pose.translation,
        pose.rotation @ _read_axis(element.first("axis")),
        _read_limits(limit) if type_ in ("revolute", "prismatic") else None,
        damping=_read_number(dynamics, "damping") or 0.0,
        friction=_read_number(dynamics, "friction") or 0.0,
        effort=_read_number(limit, "effort") or None,
        velocity=_read_number(limit, "velocity") or None,
        empty_limits=_read_empty_limits(limit) if type_ in ("revolute", "prismatic") else None,
        coupling=_read_coupling(element.first("mimic")),
    )


def _read_coupling(mimic: Element | None) -> Coupling | None:
    if mimic is None:
        return None
    factor = _read_number(mimic, "multiplier")
    offset = _read_number(mimic, "offset") or 0.0
    return Coupling(mimic.attributes.get("joint", ""), (offset, 1.0 if factor is None else factor))


def _read_limits(limit: Element | None) -> tuple[float, float] | None:
    lower, upper = _read_number(limit, "lower") or 0.0, _read_number(limit, "upper") or 0.0
    return (lower, upper) if lower < upper else None


def _read_empty_limits(limit: Element | None) -> tuple[float, float] | None:
    if limit is None or not limit.attributes.keys() & {"lower", "upper"} or _read_limits(limit) is not None:
        return None
    return _read_number(limit, "lower") or 0.0, _read_number(limit, "upper") or 0.0


def _read_inertial(name: str, link: Element, root_t_link: Pose) -> Inertial | None:
    element = link.first("inertial")
    mass = _read_number(element.first("mass"), "value") if element else None
    if element is None or mass is None or mass <= 0:
        return None
    try:
        pose = root_t_link @ read_origin(element, "")
    except AssetError:
        pose = root_t_link
    tensor = element.first("inertia")
    inertia = kinematic_tree.tensor_of_moments(
        _read_number(tensor, name) or 0.0 for name in kinematic_tree.TENSOR_NAMES
    )
    return Inertial(name, mass, pose.translation, pose.rotation @ inertia @ pose.rotation.T)


def _read_number(element: Element | None, attribute: str) -> float | None:
    if element is None or attribute not in element.attributes:
        return None
    try:
        return float(read_floats(element, attribute, 1, "")[0])
    except AssetError:
        return None


def _read_axis(axis: Element | None) -> Floats:
    """The unit direction (3,) of an `<axis>`; X where there is none that can be read."""
    try:
        direction = unit_vector(read_floats(axis, "xyz", 3, "", _X)) if axis else None
    except AssetError:
        direction = None
    return np.array(_X) if direction is None else direction
