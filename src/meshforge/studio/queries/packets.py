"""Packets of the shapes of an asset, as it comes or edited: a header, then vertices and triangles of all rows."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import cast

import numpy as np

from meshforge.checks import Finding, check
from meshforge.geometry import digest
from meshforge.rendering import RenderMesh, to_render_mesh
from meshforge.studio.wire import Wire
from meshforge.studio.wire import asset as wire
from meshforge.symbolic import Hull, Surface, SymbolicMesh

_SIDES, _FEWER = 48, 24  # of a round primitive about its axis: of a few, and of many
_MANY = 60
_ALIGNED = 4  # bytes, of the vertices and triangles

PacketRow = tuple[wire.ShapeRow, RenderMesh]


def pack_asset(mesh: SymbolicMesh) -> bytes:
    """The shapes of an asset: its hulls in their order, then its non-convex pieces that have a surface."""
    pieces = mesh.asset.opaque if mesh.asset else ()
    return _pack_rows([*hull_rows(mesh.hulls), *(_make_surface_row(p.name, p.surface) for p in pieces if p.surface)])


def pack_visual(mesh: SymbolicMesh) -> bytes:
    """The surfaces that an asset shows, each named after its body."""
    visuals = mesh.asset.visuals if mesh.asset else ()
    return _pack_rows([_make_surface_row(surface.body or "", surface) for surface in visuals])


def hull_rows(hulls: Iterable[Hull]) -> list[PacketRow]:
    """The rows of some hulls; round primitives have fewer sides where there are many of them."""
    hulls = list(hulls)
    sides = _SIDES if sum(hull.shape.is_primitive for hull in hulls) <= _MANY else _FEWER
    return [_make_row(hull.name, to_render_mesh(hull.shape, sides)) for hull in hulls]


def pack_shapes(header: Wire, rows: Sequence[PacketRow]) -> bytes:
    """A packet as `ShapesHeader` describes it; header: one of these, or a message with the same `rows` and more."""
    vertices = [np.asarray(drawn.vertices, "<f4").tobytes() for _, drawn in rows]
    faces = [np.asarray(drawn.faces, "<u4").tobytes() for _, drawn in rows]
    return frame_packet(header.model_dump_json().encode(), *vertices, *faces)


def frame_packet(header: bytes, *parts: bytes) -> bytes:
    """The length of a JSON header as uint32, the header padded with spaces to whole words, and what follows it."""
    padded = header + b" " * (-len(header) % _ALIGNED)
    return b"".join([len(padded).to_bytes(4, "little"), padded, *parts])


def _pack_rows(rows: Sequence[PacketRow]) -> bytes:
    return pack_shapes(wire.ShapesHeader(rows=tuple(row for row, _ in rows)), rows)


def _make_surface_row(name: str, surface: Surface) -> PacketRow:
    return _make_row(name, to_render_mesh(surface), surface.rgba)


def _make_row(name: str, drawn: RenderMesh, rgba: tuple[float, float, float, float] | None = None) -> PacketRow:
    return wire.ShapeRow(name=name, vertices=len(drawn.vertices), faces=len(drawn.faces), rgba=rgba), drawn


@dataclass(frozen=True, eq=False, slots=True)
class EditNotes:
    """What the page shows of an edit besides its hulls; the fields are those of `EditedHeader`."""

    note: str | None = None
    trace: tuple[wire.TraceLine, ...] = ()
    findings: tuple[wire.FindingView, ...] = ()
    flags: tuple[str, ...] = ()


def pack_edited(
    source: SymbolicMesh, before: SymbolicMesh, after: SymbolicMesh, notes: EditNotes, seen: SymbolicMesh | None = None
) -> bytes:
    """The packet of an edited asset. source: the asset as it comes; before, after: the edit, in the same frame.

    seen: `after` in the canonical frame, where that is at hand: its contacts are known already.
    """
    rows = hull_rows(hull for hull in after.hulls if not _has_hull(source, hull))
    header = wire.EditedHeader(
        rows=tuple(row for row, _ in rows),
        hulls=hull_views(after),
        made=_names_not_in(after, before),
        removed=_names_not_in(before, after),
        note=notes.note,
        trace=notes.trace,
        findings=notes.findings,
        flags=notes.flags,
        volume=(sum(hull.volume for hull in before.hulls), sum(hull.volume for hull in after.hulls)),
        contacts=contact_names(seen or after),
    )
    return pack_shapes(header, rows)


def findings_of_new(before: SymbolicMesh, after: SymbolicMesh) -> tuple[wire.FindingView, ...]:
    """Findings about the legality of the hulls that an edit made."""
    made = replace(after, hulls=tuple(hull for hull in after.hulls if hull.name not in before.index))
    return finding_views(found for found in check(made) if found.rule != "opaque")


def finding_views(findings: Iterable[Finding]) -> tuple[wire.FindingView, ...]:
    """Findings, one for each hull that they name."""
    return tuple(
        wire.FindingView(severity=found.severity, text=f"{found.message}. {found.remedy}", hull=hull)
        for found in findings
        for hull in found.hulls or (None,)
    )


def _has_hull(source: SymbolicMesh, hull: Hull) -> bool:
    """Whether the asset has a hull of that name and shape."""
    if hull.name not in source.index:
        return False
    mine = source.hull_of(hull.name).shape
    return mine is hull.shape or digest(mine) == digest(hull.shape)


def _names_not_in(mesh: SymbolicMesh, other: SymbolicMesh) -> tuple[str, ...]:
    """The names of hulls that another mesh has not."""
    return tuple(hull.name for hull in mesh.hulls if hull.name not in other.index)


def hull_view(hull: Hull) -> wire.HullView:
    """A hull; vertices and faces of a round primitive are those of its tessellation."""
    return wire.HullView(
        name=hull.name,
        body=hull.body,
        label=hull.label,
        confidence=hull.confidence,
        source=hull.source,
        volume=hull.volume,
        vertices=len(hull.vertices),
        faces=len(hull.faces),
        primitive=cast(wire.PrimitiveKind, hull.shape.kind) if hull.shape.is_primitive else None,
        parent=hull.parent,
    )


def hull_views(mesh: SymbolicMesh) -> tuple[wire.HullView, ...]:
    """All hulls of a mesh, in their order."""
    return tuple(map(hull_view, mesh.hulls))


def contact_names(mesh: SymbolicMesh) -> tuple[tuple[str, str], ...]:
    """The pairs of hulls in contact, by name, in the order of the hulls."""
    return tuple((mesh.hulls[i].name, mesh.hulls[j].name) for i, j in sorted(mesh.contacts))
