"""Links and joints of a URDF: where each link is in the root frame when all joints are at zero."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from meshforge.errors import AssetError, nearest
from meshforge.formats.urdf.numbers import origin
from meshforge.formats.xml import Element
from meshforge.geometry import Pose


@dataclass(frozen=True, slots=True)
class Links:
    """The links by name in the order of the file, the pose root_T_link of each, and the links without a parent."""

    elements: Mapping[str, Element]
    poses: Mapping[str, Pose]
    roots: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class _Joint:
    name: str
    parent: str
    child: str
    pose: Pose
    line: int


def read_links(robot: Element, where: str) -> Links:
    """The links of a `<robot>`, placed.

    Raises AssetError with `where:line`: no link, a link without name or named twice, a joint that names a link
    which is not there, a link with two parents, a cycle.
    """
    elements = _named_links(robot, where)
    parents: dict[str, _Joint] = {}
    for element in robot.each("joint"):
        joint = _joint(element, elements, where)
        if joint.child in parents:
            first = parents[joint.child]
            problem = f"link {joint.child!r} has two parents: joint {first.name!r} of line {first.line}, and this one"
            raise AssetError(f"joint {joint.name!r}: {problem}", where=f"{where}:{joint.line}")
        parents[joint.child] = joint
    poses = _placed(elements, parents, where)
    return Links(elements, {name: poses[name] for name in elements}, tuple(n for n in elements if n not in parents))


def _named_links(robot: Element, where: str) -> dict[str, Element]:
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


def _joint(element: Element, links: Mapping[str, Element], where: str) -> _Joint:
    name = element.attributes.get("name", "")
    place = f"{where}:{element.line}"
    ends = []
    for role in ("parent", "child"):
        end = element.first(role)
        link = end.attributes.get("link") if end else None
        if link is None:
            raise AssetError(f"joint {name!r} names no {role} link", where=place)
        if link not in links:
            like = nearest(link, links)
            remedy = f"The nearest name of a link is {like!r}." if like else None
            raise AssetError(f"joint {name!r}: its {role} link {link!r} is not there", where=place, remedy=remedy)
        ends.append(link)
    return _Joint(name, ends[0], ends[1], origin(element, where), element.line)


def _placed(links: Mapping[str, Element], parents: Mapping[str, _Joint], where: str) -> dict[str, Pose]:
    """root_T_link of all links, each after its parent."""
    poses: dict[str, Pose] = {}
    for name in links:
        chain: dict[str, None] = {}
        at = name
        while at not in poses and at in parents and at not in chain:
            chain[at] = None
            at = parents[at].parent
        if at in chain:
            ring = list(chain)[list(chain).index(at) :]
            path = " -> ".join([ring[0], *reversed(ring)])
            raise AssetError(f"the joints form a cycle: {path}", where=f"{where}:{parents[at].line}")
        poses.setdefault(at, Pose.identity())
        for link in reversed(chain):
            poses[link] = poses[parents[link].parent] @ parents[link].pose
    return poses
