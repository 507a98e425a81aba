"""What an SDF calls its collisions besides their names: by their meshes, and by what their links show."""

from __future__ import annotations

from meshforge.asset import Mentions
from meshforge.formats.mentioned import Named, mentions, stem
from meshforge.formats.sdf.files.elements import geometry_of, mesh_uri
from meshforge.formats.sdf.files.values import text_of
from meshforge.formats.xml import Element


def element_mentions(link: Element, collision: Element) -> Mentions:
    """What is said of a `<collision>` of a link."""
    own = _named(collision)
    shown = [named for visual in link.each("visual") if (named := _named(visual))]
    return mentions(own, shown) if own else ()


def _named(element: Element) -> Named | None:
    """The names of a collision or visual element; of a collision its own is not told, which its hulls have."""
    kind = geometry_of(element)
    if kind is None:
        return None
    reference = mesh_uri(kind) if kind.tag == "mesh" else ""
    sizes = tuple((child.tag, " ".join(child.text.split())) for child in kind.children)
    shape = reference or (kind.tag, sizes, " ".join(text_of(element, "pose").split()))
    material = element.first("material")
    script = material.first("script") if material else None
    name = "" if element.tag == "collision" else element.attributes.get("name", "")
    return Named(shape, name, stem(reference), text_of(script, "name"))
