"""Packets of the shapes of an asset, a header, then vertices and triangles of all rows: as it comes, after its steps,
one more action, or the program with corrections; and of its output.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Literal

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
from meshforge.studio.queries.programs import replay_steps
from meshforge.studio.wire import Wire
from meshforge.studio.wire import asset as wire
from meshforge.studio.wire.requests import PreviewRequest
from meshforge.symbolic import Hull, SymbolicMesh

_SIDES, _FEWER = 48, 24  # of a round primitive about its axis: of a few, and of many
_MANY = 60
_ALIGNED = 4  # bytes, of the vertices and triangles

PacketRow = tuple[wire.ShapeRow, RenderMesh]


def pack_asset(mesh: SymbolicMesh) -> bytes:
    """Return the shapes of an asset: its hulls in their order, then its non-convex pieces that have a surface."""
    pieces = mesh.asset.non_convex if mesh.asset else ()
    surfaces = (_make_row(piece.name, to_render_mesh(piece.surface)) for piece in pieces if piece.surface)
    return _pack_rows([*hull_rows(mesh.hulls), *surfaces])


def pack_visual(mesh: SymbolicMesh) -> bytes:
    """Return the surfaces that an asset shows, each named after its body."""
    visuals = mesh.asset.visuals if mesh.asset else ()
    return _pack_rows([_make_row(surface.body or "", to_render_mesh(surface)) for surface in visuals])


def hull_rows(hulls: Iterable[Hull]) -> list[PacketRow]:
    """Return the rows of some hulls; round primitives have fewer sides where there are many of them."""
    hulls = list(hulls)
    sides = _SIDES if sum(hull.shape.is_primitive for hull in hulls) <= _MANY else _FEWER
    return [_make_row(hull.name, to_render_mesh(hull.shape, sides)) for hull in hulls]


def pack_shapes(header: Wire, rows: Sequence[PacketRow]) -> bytes:
    """Return a packet as `ShapesHeader` describes it; header: one of these, or a message with `rows` and more."""
    vertices = [np.asarray(drawn.vertices, "<f4").tobytes() for _, drawn in rows]
    faces = [np.asarray(drawn.faces, "<u4").tobytes() for _, drawn in rows]
    return frame_packet(header.model_dump_json().encode(), *vertices, *faces)


def frame_packet(header: bytes, *parts: bytes) -> bytes:
    """Return the length of a JSON header as uint32, the header padded with spaces to whole words, and the rest."""
    padded = header + b" " * (-len(header) % _ALIGNED)
    return b"".join([len(padded).to_bytes(4, "little"), padded, *parts])


def _pack_rows(rows: Sequence[PacketRow]) -> bytes:
    return pack_shapes(wire.ShapesHeader(rows=tuple(row for row, _ in rows)), rows)


def _make_row(name: str, drawn: RenderMesh) -> PacketRow:
    return wire.ShapeRow(name=name, vertices=len(drawn.vertices), faces=len(drawn.faces)), drawn


def pack_edited(
    source: SymbolicMesh,
    before: SymbolicMesh,
    after: SymbolicMesh,
    seen: SymbolicMesh | None = None,
    *,
    note: str | None = None,
    trace: Iterable[RuleTrace | RuleEffect] = (),
    findings: tuple[wire.FindingView, ...] = (),
    flags: tuple[str, ...] = (),
) -> bytes:
    """Return the packet of an edited asset. source: the asset as it comes; before, after: the edit, in the same frame.

    seen: `after` in the canonical frame, where that is at hand: its contacts are known already. The rest is as in
    `EditHeader`.
    """
    rows = hull_rows(hull for hull in after.hulls if not _has_hull(source, hull))
    header = wire.EditHeader(
        rows=tuple(row for row, _ in rows),
        hulls=hull_views(after),
        made=_names_not_in(after, before),
        removed=_names_not_in(before, after),
        changed=tuple(hull.name for hull in after.hulls if _is_other_shape(before, hull)),
        note=note,
        trace=tuple(map(_trace_line, trace)),
        findings=findings,
        flags=flags,
        volume=(sum(hull.volume for hull in before.hulls), sum(hull.volume for hull in after.hulls)),
        contacts=contact_names(seen or after),
    )
    return pack_shapes(header, rows)


def findings_of_new(before: SymbolicMesh, after: SymbolicMesh) -> tuple[wire.FindingView, ...]:
    """Return findings about the legality of the hulls that an edit made."""
    made = replace(after, hulls=tuple(hull for hull in after.hulls if hull.name not in before.index))
    return finding_views(found for found in check(made) if found.rule != "non_convex")


def finding_views(findings: Iterable[Finding]) -> tuple[wire.FindingView, ...]:
    """Return findings, one for each hull that they name."""
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


def _is_other_shape(before: SymbolicMesh, hull: Hull) -> bool:
    """Whether a hull of that name was of another shape before; one that was rounded when it was written is the same."""
    was = before.hull_of(hull.name).shape if hull.name in before.index else hull.shape
    if was is hull.shape:
        return False
    one, two = (np.stack([shape.aabb.min, shape.aabb.max]) for shape in (was, hull.shape))
    is_same_box = np.allclose(one, two, rtol=0, atol=1e-5 * float(np.ptp(one, axis=0).max()))  # in single precision
    return not (is_same_box and np.isclose(was.volume, hull.shape.volume, rtol=1e-4))


def _names_not_in(mesh: SymbolicMesh, other: SymbolicMesh) -> tuple[str, ...]:
    return tuple(hull.name for hull in mesh.hulls if hull.name not in other.index)


def hull_views(mesh: SymbolicMesh) -> tuple[wire.HullView, ...]:
    """Return all hulls of a mesh, in their order."""
    return tuple(map(wire.HullView.model_validate, mesh.hulls))


def contact_names(mesh: SymbolicMesh) -> tuple[tuple[str, str], ...]:
    """Return the pairs of hulls in contact, by name, in the order of the hulls."""
    return tuple((mesh.hulls[i].name, mesh.hulls[j].name) for i, j in sorted(mesh.contacts))


def preview_steps(project: Project, asset: str, mesh: SymbolicMesh, steps: int) -> bytes:
    """Return the packet of an asset after its first steps; mesh: the asset as it comes.

    A step that fails is left out, and the note says why. Raises ProgramError where the asset cannot be turned.
    """
    replay = replay_steps(project, asset, mesh, steps)
    home = replay.edited
    problems, found = _describe_problems(replay), findings_of_new(mesh, home)
    return pack_edited(mesh, mesh, home, replay.mesh, note=problems, trace=replay.trace, findings=found)


def preview_action(project: Project, asset: str, mesh: SymbolicMesh, request: PreviewRequest) -> bytes:
    """Return the packet of an asset after one more action, on its own steps or on what the program makes of it.

    Raises MeshForgeError: no such hull, no such action, or one that fails.
    """
    if request.result:
        return _preview_manual_edit(project, asset, mesh, request)
    action, label = read_action(request.action, asset)
    before = replace(replay_steps(project, asset, mesh, request.steps), memo=make_anew)  # each one is another
    after = before.apply(before.mask_of(request.select), action, label, project.templates(action.templates))
    start, home = before.edited, after.edited
    note = "; ".join(note for note in (_describe_problems(before), after.trace[-1].note) if note)
    found = findings_of_new(start, home)
    return pack_edited(mesh, start, home, after.mesh, note=note or None, trace=after.trace[-1:], findings=found)


def _preview_manual_edit(project: Project, asset: str, mesh: SymbolicMesh, request: PreviewRequest) -> bytes:
    before = run_with_manual_edits(project, asset, mesh, project.program())
    one = make_manual_edit(before.mesh, asset, request.select, *read_action(request.action, asset))
    templates = {**before.templates, **project.templates(one.action.templates)}
    after, flags = replay_manual_edits((*before.manual_edits, one), mesh, before.run.mesh, before.program, templates)
    return pack_edited(mesh, before.mesh, after, findings=findings_of_new(before.mesh, after), flags=flags)


def _trace_line(did: RuleTrace | RuleEffect) -> wire.TraceLine:
    error = did.error if isinstance(did, RuleTrace) else None
    return wire.TraceLine(rule=did.rule, selected=did.selected, made=did.made, note=error or did.note)


def _describe_problems(replay: Replay) -> str | None:
    return "; ".join(result.error for result in replay.trace if result.error) or None


def preview_result(
    project: Project, asset: str, mesh: SymbolicMesh, of: Literal["program", "output"], program: Program | None
) -> bytes:
    """Return the packet of an edited asset. mesh: the asset as it comes; program: what is run, None changes nothing.

    Raises MeshForgeError where the program cannot run on it, or where there is no output.
    """
    if of == "program":
        now = run_with_manual_edits(project, asset, mesh, program)
        found = finding_views(check(now.mesh))
        return pack_edited(mesh, mesh, now.mesh, trace=now.run.trace, findings=found, flags=now.flags)
    stamp = read_stamp(project.layout.edited, asset)
    if stamp is None or stamp.status not in ("edited", "unchanged"):
        why = stamp.error if stamp and stamp.error else None
        raise ProjectError(why or "it has no output yet", where=asset, remedy="Apply the program.")
    after = load(project.layout.edited / stamp.out)
    return pack_edited(mesh, mesh, after, trace=stamp.rules, findings=finding_views(check(after)), flags=stamp.flags)
