"""The `<robot>` of a URDF: its collision elements and what it refers to."""

from __future__ import annotations

from collections.abc import Iterator

from meshforge.errors import AssetError
from meshforge.formats.xml import Element, parsed


def robot_of(data: bytes, where: str) -> Element:
    """The `<robot>` of a URDF text in UTF-8. Raises AssetError: not well formed, or of another kind."""
    root = parsed(data, where)
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


def xacro_lines(robot: Element) -> list[int]:
    """Where xacro elements stand that no one has expanded, which engines pass over."""
    return [element.line for element in robot.walk() if element.tag.startswith("xacro:")]
