"""What a user should know about how a URDF was read."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from meshforge.formats.urdf.kinematics import Links
from meshforge.formats.urdf.robot import xacro_lines
from meshforge.formats.xml import Element
from meshforge.words import counted, listed

Found = Sequence[tuple[str, Element]]
"""The name of the link and the element of each `<collision>`."""


def notes(robot: Element, links: Links, found: Found) -> tuple[str, ...]:
    """Notes on links without a parent, xacro, and collision elements that engines pass over."""
    return (*_roots(links), *_xacro(robot), *_stray(robot, found), *_shapes(found))


def _roots(links: Links) -> Iterator[str]:
    if len(links.roots) > 1:
        yield (
            f"{len(links.roots)} links have no parent joint ({listed(links.roots)}): each is taken at the origin, as "
            "MuJoCo does; PyBullet cannot load such a file"
        )


def _xacro(robot: Element) -> Iterator[str]:
    if lines := xacro_lines(robot):
        yield f"{counted(len(lines), 'xacro element')} not expanded, the first on line {lines[0]}: passed over"


def _stray(robot: Element, found: Found) -> Iterator[str]:
    """A note on collisions in elements that engines do not know."""
    known = {id(collision) for _, collision in found}
    lines = [e.line for e in robot.walk() if e.tag.lower() == "collision" and id(e) not in known]
    if lines:
        yield f"{counted(len(lines), 'collision')} in no link, the first on line {lines[0]}: passed over, as by engines"


def _shapes(found: Found) -> Iterator[str]:
    """Notes on collisions without a shape, or with more than the one that counts."""
    for link, collision in found:
        place = f"a collision of link {link!r} on line {collision.line} has"
        shapes = [len(geometry.children) for geometry in collision.each("geometry")]
        if not shapes or not shapes[0]:
            yield f"{place} no geometry and is left as it is"
        elif sum(shapes) > 1:
            yield f"{place} {sum(shapes)} shapes, of which one counts, as for engines"
