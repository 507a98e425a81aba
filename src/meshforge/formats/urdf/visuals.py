"""What the links of a URDF show."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from meshforge.errors import MeshForgeError
from meshforge.formats.references import Resolver
from meshforge.formats.urdf.numbers import origin
from meshforge.formats.urdf.shapes import geometry_of, mesh_scale, primitive
from meshforge.formats.visuals import LazySurfaces, Visual
from meshforge.formats.xml import Element
from meshforge.geometry import Pose


def read_visuals(
    links: Mapping[str, Element], poses: Mapping[str, Pose], resolver: Resolver, where: str
) -> LazySurfaces:
    """The visuals of all links; one that is not understood is left out, it never fails."""
    return LazySurfaces(
        tuple(
            visual
            for name, link in links.items()
            for element in link.each("visual")
            for visual in _visual(name, element, poses[name], resolver, where)
        )
    )


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
