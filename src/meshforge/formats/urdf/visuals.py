"""What the links of a URDF show."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from meshforge.errors import MeshForgeError
from meshforge.formats.references import Resolver
from meshforge.formats.urdf.numbers import floats, origin
from meshforge.formats.urdf.shapes import geometry_of, mesh_scale, primitive
from meshforge.formats.visuals import Rgba, Visual, VisualSurfaces
from meshforge.formats.xml import Element
from meshforge.geometry import Pose


def read_visuals(
    robot: Element, links: Mapping[str, Element], poses: Mapping[str, Pose], resolver: Resolver, where: str
) -> VisualSurfaces:
    """The visuals of all links; one that is not understood is left out, it never fails."""
    colors = _colors(robot, where)
    return VisualSurfaces(
        tuple(
            replace(visual, rgba=_color(element.first("material"), colors, where))
            for name, link in links.items()
            for element in link.each("visual")
            for visual in _visual(name, element, poses[name], resolver, where)
        )
    )


def _colors(robot: Element, where: str) -> dict[str, Rgba]:
    """The colours of materials by their names, wherever in the file they are told."""
    materials = (element for element in robot.walk() if element.tag == "material" and "name" in element.attributes)
    told = ((material.attributes["name"], _color(material, {}, where)) for material in materials)
    return {name: color for name, color in told if color is not None}


def _color(material: Element | None, named: Mapping[str, Rgba], where: str) -> Rgba | None:
    """The colour that a material tells, or else the one of its name."""
    if material is None:
        return None
    color = material.first("color")
    if color is None:
        return named.get(material.attributes.get("name", ""))
    try:
        red, green, blue, alpha = floats(color, "rgba", 4, where).tolist()
    except MeshForgeError:
        return None
    return red, green, blue, alpha


def _visual(link: str, element: Element, pose: Pose, resolver: Resolver, where: str) -> Iterator[Visual]:
    kind = geometry_of(element)
    if kind is None:
        return
    try:
        at = pose @ origin(element, where)
        if kind.tag != "mesh":
            shape = primitive(kind, at, where).shape
            if shape is not None:
                yield Visual(link, shape, np.eye(3), np.zeros(3))
        elif path := resolver.find(kind.attributes.get("filename", "")):
            yield Visual(link, path, at.rotation * mesh_scale(kind, where, "visual"), at.translation)
    except MeshForgeError:
        return
