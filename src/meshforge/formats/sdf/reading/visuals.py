"""What the links of an SDF show."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from meshforge.errors import MeshForgeError
from meshforge.formats.sdf.files.elements import geometry_of, mesh_uri
from meshforge.formats.sdf.files.values import text_of
from meshforge.formats.sdf.reading.compose import Composed
from meshforge.formats.sdf.reading.links import Link, Links, place_in
from meshforge.formats.sdf.reading.shapes import mesh_scale, polylines, primitive
from meshforge.formats.sdf.reading.units import unit_of
from meshforge.formats.visuals import Rgba, Visual, VisualSurfaces
from meshforge.formats.xml import Element, numbers


def read_visuals(links: Links, composed: Composed) -> VisualSurfaces:
    """The visuals of all links; one that is not understood is left out, it never fails."""
    return VisualSurfaces(
        tuple(
            replace(visual, rgba=_color(element))
            for link in links.by_body.values()
            for element in link.element.each("visual")
            for visual in _visual(links, link, element, composed)
        )
    )


def _color(visual: Element) -> Rgba | None:
    """The diffuse colour that a visual tells, as transparent as it says."""
    found = numbers(text_of(visual.first("material"), "diffuse"))
    if not found or len(found) not in (3, 4):
        return None
    red, green, blue, alpha = (min(1.0, max(0.0, share)) for share in [*found, 1.0][:4])
    through = numbers(text_of(visual, "transparency")) or [0.0]
    return red, green, blue, alpha * (1.0 - min(1.0, max(0.0, through[0])))


def _visual(links: Links, link: Link, element: Element, composed: Composed) -> Iterator[Visual]:
    kind, where = geometry_of(element), link.where
    if kind is None:
        return
    try:
        at = place_in(links.places, link, element)
        if kind.tag == "mesh":
            path = composed.sources[link.scope.source].resolver.find(mesh_uri(kind))
            if path is not None:
                scale = mesh_scale(kind, where, "visual") * unit_of(path)
                yield Visual(link.body, path, at.rotation * scale, at.translation)
            return
        geometry = element.first("geometry")
        assert geometry is not None  # it holds the kind
        part = polylines(geometry, at, where) if kind.tag == "polyline" else primitive(kind, at, where)
        if part.shape is not None:
            yield Visual(link.body, part.shape, np.eye(3), np.zeros(3))
    except MeshForgeError:
        return
