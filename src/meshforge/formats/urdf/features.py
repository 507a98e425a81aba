"""What a URDF holds besides links, hulls, joints, masses and visuals, and what one made of another format holds."""

from __future__ import annotations

import re
from collections.abc import Iterator

from meshforge.asset import Feature, What
from meshforge.formats.urdf.document import UrdfDocument
from meshforge.formats.urdf.robot import robot_of
from meshforge.formats.xml import Element, Text

HOLDS = frozenset(
    {
        What.NAMES,
        What.BODIES,
        What.BOXES,
        What.SPHERES,
        What.CYLINDERS,
        What.OPAQUE,
        What.JOINTS,
        What.FIXED_JOINTS,
        What.SPEEDS,
        What.MASSES,
        What.VISUALS,
        What.COLORS,
    }
)
COULD = frozenset({What.MIMICS, What.CONTACT, What.COMMENTS, What.MATERIALS, What.TEXTURES})
INSTEAD = {
    What.CAPSULES: "written as triangles",
    What.ELLIPSOIDS: "written as triangles",
    What.BALL_JOINTS: "written as three joints that turn about one point",
}
MESHES = (".obj", ".stl", ".dae")
"""The mesh files that ROS, PyBullet and others read."""
_KNOWN = ("link", "joint", "material")
_COMMENT = re.compile(rb"<!--")


def features_of(document: UrdfDocument) -> Iterator[Feature]:
    """The features of a URDF that its asset does not tell."""
    data = Text.of(document.source).data
    robot = robot_of(data, "")
    joints = list(robot.each("joint"))
    yield Feature(What.MIMICS, tuple(_name(joint) for joint in joints if joint.first("mimic")))
    yield Feature(What.TEXTURES, tuple(dict.fromkeys(e.attributes.get("filename", "") for e in _textures(robot))))
    yield Feature(What.CONTACT, tuple(_name(link) for link in robot.each("link") if link.first("contact")))
    others = [child.tag for child in robot.children if child.tag not in _KNOWN]
    others += [
        part.tag for joint in joints for part in joint.children if part.tag in ("safety_controller", "calibration")
    ]
    kinds = tuple(dict.fromkeys(others))
    yield Feature(What.OTHERS, kinds, len(others) - len(kinds))
    yield Feature(What.COMMENTS, unnamed=len(_COMMENT.findall(data)))


def _textures(robot: Element) -> Iterator[Element]:
    return (element for element in robot.walk() if element.tag == "texture")


def _name(element: Element) -> str:
    return element.attributes.get("name", "")
