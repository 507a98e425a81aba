"""The pieces of collision elements, as hulls and opaque pieces of an asset."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from meshforge.asset import Geom, Mentions, Opaque
from meshforge.formats.element_plan import Authored
from meshforge.formats.mesh_parts import MeshPart

Parts = Sequence[Sequence[MeshPart]]
"""The pieces of each element, in order."""
Told = Sequence[Sequence[Mentions]]
"""What else is said of each of them."""


def geoms_of(authored: Sequence[Authored], parts: Parts, told: Told) -> tuple[Geom, ...]:
    """The pieces that are hulls."""
    pieces = _pieces(authored, parts, told)
    return tuple(Geom(name, body, part.shape, mentions=said) for name, body, part, said in pieces if part.shape)


def opaque_of(authored: Sequence[Authored], parts: Parts, told: Told) -> tuple[Opaque, ...]:
    """The pieces that are none."""
    return tuple(
        Opaque(name, body, part.reason, part.surface, part.plane, said)
        for name, body, part, said in _pieces(authored, parts, told)
        if part.shape is None
    )


def _pieces(authored: Sequence[Authored], parts: Parts, told: Told) -> Iterator[tuple[str, str, MeshPart, Mentions]]:
    """Name, body, piece and what is said of it."""
    for element, own, words in zip(authored, parts, told, strict=True):
        for name, part, said in zip(element.names, own, words, strict=True):
            yield name, element.link, part, said
