"""What is kept of a URDF to write it back, and how its XML is read: the robot, its collisions and references,
numbers and poses."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from meshforge.common import AssetError
from meshforge.formats.collision_pieces import CollisionElement
from meshforge.formats.meshfile.surface import FARTHEST
from meshforge.formats.references import Resolver
from meshforge.formats.xml import Element, parse_numbers, parse_xml
from meshforge.geometry import Floats, Pose
from meshforge.symbolic import Document

GEOMETRY_TAGS = ("box", "sphere", "cylinder", "capsule", "plane", "mesh")
"""The elements of a `<geometry>` that engines know."""


@dataclass(frozen=True, eq=False, slots=True)
class UrdfDocument(Document):
    """The source of an asset read from a URDF.

    source: the authored bytes; authored: one entry a `<collision>`, in order; resolver: finds its files;
    digests: of the mesh files that hold several pieces, so that a file changed since then is noticed.
    """

    source: bytes
    authored: tuple[CollisionElement, ...]
    resolver: Resolver
    digests: tuple[tuple[Path, str], ...] = ()


def parse_robot(data: bytes, where: str) -> Element:
    """The `<robot>` of a URDF text in UTF-8. Raises AssetError: not well formed, or of another kind."""
    root = parse_xml(data, where)
    if root.tag != "robot":
        raise AssetError(f"is no URDF: its root element is <{root.tag}>, not <robot>", where=f"{where}:{root.line}")
    return root


def collisions(robot: Element) -> Iterator[tuple[str, Element]]:
    """The name of the link and the element of each `<collision>`, in the order of the file."""
    for link in robot.each("link"):
        for collision in link.each("collision"):
            yield link.attributes["name"], collision


def references(robot: Element) -> list[str]:
    """Every mesh and texture reference of the document, in order of mention, each once."""
    found = (e.attributes.get("filename") for e in robot.walk() if e.tag in ("mesh", "texture"))
    return list(dict.fromkeys(reference for reference in found if reference))


def read_floats(
    element: Element, attribute: str, count: int, where: str, default: tuple[float, ...] | None = None
) -> Floats:
    """The numbers (count,) of an attribute, `default` where it is left out.

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
    values = parse_numbers(text)
    if values is None or len(values) != count:
        wanted = "a finite number" if count == 1 else f"{count} finite numbers"
        raise AssetError(f"{given} does not hold {wanted}", where=place)
    if any(abs(value) > FARTHEST for value in values):
        raise AssetError(f"{given} is larger than anything", where=place)
    return np.array(values)


def read_origin(element: Element, where: str) -> Pose:
    """The pose of an element's first `<origin>`, identity where there is none."""
    place = element.first("origin")
    if place is None:
        return Pose.identity()
    zero = (0.0, 0.0, 0.0)
    xyz, rpy = (read_floats(place, attribute, 3, where, zero) for attribute in ("xyz", "rpy"))
    return Pose.from_rpy(list(xyz), list(rpy))


def geometry_of(element: Element) -> Element | None:
    """What the `<geometry>` of a collision or visual holds, None where there is nothing."""
    geometry = element.first("geometry")
    if geometry is None or not geometry.children:
        return None
    return next((child for child in geometry.children if child.tag in GEOMETRY_TAGS), geometry.children[0])
