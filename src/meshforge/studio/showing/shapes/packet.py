"""Packets of shapes: a header, then the vertices and the triangles of all rows."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from meshforge.asset import Surface
from meshforge.studio.wire.asset import ShapeRow, ShapesHeader
from meshforge.studio.wire.base import Wire
from meshforge.symbolic import Hull, SymbolicMesh
from meshforge.views import Skin, skin

_SIDES, _FEWER = 48, 24  # of a round primitive about its axis: of a few, and of many
_MANY = 60
_ALIGNED = 4  # bytes, of the vertices and triangles

Row = tuple[ShapeRow, Skin]


def asset_packet(mesh: SymbolicMesh) -> bytes:
    """The shapes of an asset: its hulls in their order, then its opaque pieces that have a surface."""
    opaque = [(piece.name, piece.surface) for piece in mesh.asset.opaque if piece.surface] if mesh.asset else []
    return _packet([*hull_rows(mesh.hulls), *(_surface_row(name, surface) for name, surface in opaque)])


def visual_packet(mesh: SymbolicMesh) -> bytes:
    """The surfaces that an asset shows, each named after its body."""
    visuals = mesh.asset.visuals if mesh.asset else ()
    return _packet([_surface_row(surface.body or "", surface) for surface in visuals])


def hull_rows(hulls: Iterable[Hull]) -> list[Row]:
    """The rows of some hulls; round primitives finely enough to look round, less so where there are many."""
    hulls = list(hulls)
    sides = _SIDES if sum(hull.shape.is_primitive for hull in hulls) <= _MANY else _FEWER
    return [_row(hull.name, skin(hull.shape, sides)) for hull in hulls]


def shapes_packet(header: Wire, rows: Sequence[Row]) -> bytes:
    """A packet as `ShapesHeader` tells; header: it, or one with the same `rows` and more."""
    vertices = [np.asarray(drawn.vertices, "<f4").tobytes() for _, drawn in rows]
    faces = [np.asarray(drawn.faces, "<u4").tobytes() for _, drawn in rows]
    return framed(header.model_dump_json().encode(), *vertices, *faces)


def framed(header: bytes, *parts: bytes) -> bytes:
    """The length of a JSON header as uint32, the header padded with spaces to whole words, and what follows it."""
    padded = header + b" " * (-len(header) % _ALIGNED)
    return b"".join([len(padded).to_bytes(4, "little"), padded, *parts])


def _packet(rows: Sequence[Row]) -> bytes:
    return shapes_packet(ShapesHeader(rows=tuple(row for row, _ in rows)), rows)


def _surface_row(name: str, surface: Surface) -> Row:
    return _row(name, skin(surface), surface.rgba)


def _row(name: str, drawn: Skin, rgba: tuple[float, float, float, float] | None = None) -> Row:
    return ShapeRow(name=name, vertices=len(drawn.vertices), faces=len(drawn.faces), rgba=rgba), drawn
