"""What a URDF calls its collision elements besides their names: by their meshes, and by what their links show."""

from __future__ import annotations

from collections.abc import Iterator

from meshforge.asset import Mentions
from meshforge.formats.mentioned import Named, mentions, stem
from meshforge.formats.urdf.shapes import geometry_of
from meshforge.formats.xml import Element


def element_mentions(link: Element, collision: Element) -> Mentions:
    """What is said of a `<collision>` of a link."""
    own = _named(collision)
    return mentions(own, list(_shown(link))) if own else ()


def _shown(link: Element) -> Iterator[Named]:
    for visual in link.each("visual"):
        if named := _named(visual):
            yield named


def _named(element: Element) -> Named | None:
    """The names of a collision or visual element; of a collision its own is not told, which its hulls have."""
    kind = geometry_of(element)
    if kind is None:
        return None
    material = element.first("material")
    reference = kind.attributes.get("filename", "")
    origin = element.first("origin")
    place = tuple(sorted(origin.attributes.items())) if origin else ()
    shape = reference or (kind.tag, tuple(sorted(kind.attributes.items())), place)
    name = "" if element.tag == "collision" else element.attributes.get("name", "")
    return Named(shape, name, stem(reference), material.attributes.get("name", "") if material else "")
