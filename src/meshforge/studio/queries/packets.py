"""Packets of the shapes of an asset, a header, then vertices and triangles of all rows: as it comes, after its steps,
one more action, or the program with corrections; and of its output.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Literal, cast

import numpy as np

from meshforge.batch import RuleEffect, read_stamp, replay_manual_edits
from meshforge.checks import Finding, check
from meshforge.common import ProjectError
from meshforge.formats import load
from meshforge.geometry import digest
from meshforge.language import Program, Replay, RuleTrace, make_anew
from meshforge.project import Project, make_manual_edit, run_with_manual_edits
from meshforge.rendering import RenderMesh, to_render_mesh
from meshforge.studio.actions import read_action
from meshforge.studio.queries.replay import replay_steps
from meshforge.studio.wire import Wire
from meshforge.studio.wire import asset as wire
from meshforge.studio.wire.asset import TraceLine
from meshforge.studio.wire.requests import PreviewRequest
from meshforge.symbolic import Hull, Surface, SymbolicMesh

_SIDES, _FEWER = 48, 24  # of a round primitive about its axis: of a few, and of many
_MANY = 60
_ALIGNED = 4  # bytes, of the vertices and triangles

PacketRow = tuple[wire.ShapeRow, RenderMesh]


def pack_asset(mesh: SymbolicMesh) -> bytes:
    """The shapes of an asset: its hulls in their order, then its non-convex pieces that have a surface."""
    pieces = mesh.asset.non_convex if mesh.asset else ()
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
    """What the page shows of an edit besides its hulls; the fields are those of `EditHeader`."""

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
    header = wire.EditHeader(
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
    return finding_views(found for found in check(made) if found.rule != "non_convex")


def finding_views(findings: Iterable[Finding]) -> tuple[wire.FindingView, ...]:
    """Findings, one for each hull that they name."""
    return tuple(
        wire.FindingView(severity=found.severity, text=f"{found.message}. {found.remedy}", hull=hull)
        for found in findings
        for hull in found.hulls or (None,)
    )


def _has_hull(source: SymbolicMesh, hull: Hull) -> bool:
    if hull.name not in source.index:
        return False
    mine = source.hull_of(hull.name).shape
    return mine is hull.shape or digest(mine) == digest(hull.shape)


def _names_not_in(mesh: SymbolicMesh, other: SymbolicMesh) -> tuple[str, ...]:
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


ResultOf = Literal["program", "output"]


def preview_steps(project: Project, asset: str, mesh: SymbolicMesh, steps: int) -> bytes:
    """The packet of an asset after its first steps; mesh: the asset as it comes.

    A step that fails is left out, and the note says why. Raises ProgramError where the asset cannot be turned.
    """
    replay = replay_steps(project, asset, mesh, steps)
    home = replay.edited
    notes = EditNotes(_describe_problems(replay), _trace_lines(replay), findings_of_new(mesh, home))
    return pack_edited(mesh, mesh, home, notes, replay.mesh)


def preview_action(project: Project, asset: str, mesh: SymbolicMesh, request: PreviewRequest) -> bytes:
    """The packet of an asset after one more action, on its own steps or on what the program makes of it.

    Raises MeshForgeError: no such hull, no such action, or one that fails.
    """
    if request.result:
        return _preview_manual_edit(project, asset, mesh, request)
    action, label = read_action(request.action, asset)
    before = replace(replay_steps(project, asset, mesh, request.steps), memo=make_anew)  # each one is another
    after = before.apply(before.mask_of(request.select), action, label, project.templates(action.templates))
    start, home = before.edited, after.edited
    note = "; ".join(note for note in (_describe_problems(before), after.trace[-1].note) if note)
    notes = EditNotes(note or None, _trace_lines(after)[-1:], findings_of_new(start, home))
    return pack_edited(mesh, start, home, notes, after.mesh)


def _preview_manual_edit(project: Project, asset: str, mesh: SymbolicMesh, request: PreviewRequest) -> bytes:
    before = run_with_manual_edits(project, asset, mesh, project.program())
    one = make_manual_edit(before.mesh, asset, request.select, *read_action(request.action, asset))
    templates = {**before.templates, **project.templates(one.action.templates)}
    after, flags = replay_manual_edits((*before.manual_edits, one), mesh, before.run.mesh, before.program, templates)
    notes = EditNotes(findings=findings_of_new(before.mesh, after), flags=flags)
    return pack_edited(mesh, before.mesh, after, notes)


def _trace_lines(replay: Replay) -> tuple[TraceLine, ...]:
    return tuple(
        TraceLine(rule=result.rule, selected=result.selected, made=result.made, note=result.error or result.note)
        for result in replay.trace
    )


def _describe_problems(replay: Replay) -> str | None:
    return "; ".join(result.error for result in replay.trace if result.error) or None


def preview_result(project: Project, asset: str, mesh: SymbolicMesh, of: ResultOf, program: Program | None) -> bytes:
    """The packet of an edited asset. mesh: the asset as it comes; program: what is run, None changes nothing.

    Raises MeshForgeError where the program cannot run on it, or where there is no output.
    """
    if of == "program":
        now = run_with_manual_edits(project, asset, mesh, program)
        return pack_edited(mesh, mesh, now.mesh, _collect_notes(now.mesh, now.run.trace, now.flags))
    stamp = read_stamp(project.layout.edited, asset)
    if stamp is None or stamp.status not in ("edited", "unchanged"):
        why = stamp.error if stamp and stamp.error else None
        raise ProjectError(why or "it has no output yet", where=asset, remedy="Apply the program.")
    after = load(project.layout.edited / stamp.out)
    return pack_edited(mesh, mesh, after, _collect_notes(after, stamp.rules, stamp.flags))


def _collect_notes(mesh: SymbolicMesh, rules: Iterable[RuleTrace | RuleEffect], flags: tuple[str, ...]) -> EditNotes:
    trace = tuple(TraceLine(rule=r.rule, selected=r.selected, made=r.made, note=r.note) for r in rules)
    return EditNotes(trace=trace, findings=finding_views(check(mesh)), flags=flags)
