"""Packets of an asset after its steps, one more action, or the program with corrections; and of its output."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from meshforge.batch import Correction, RuleEffect, read_stamp, replay_corrections
from meshforge.checks import check
from meshforge.common import ProjectError, nearest_name
from meshforge.formats import load
from meshforge.geometry import digest
from meshforge.language import Action, Program, RuleTrace, RunResult, Template
from meshforge.project import Project
from meshforge.store import parse_action_text
from meshforge.studio.queries.packets import EditNotes, finding_views, findings_of_new, pack_edited
from meshforge.studio.queries.replay import AssetReplay, replay_steps
from meshforge.studio.wire.asset import TraceLine
from meshforge.studio.wire.requests import PreviewRequest
from meshforge.symbolic import SymbolicMesh

ResultOf = Literal["program", "output"]


def preview_steps(project: Project, asset: str, mesh: SymbolicMesh, steps: int) -> bytes:
    """The packet of an asset after its first steps; mesh: the asset as it comes.

    A step that fails is left out, and the note says why. Raises ProgramError where the asset cannot be turned.
    """
    replay = replay_steps(project, asset, mesh, steps)
    home = replay.incoming_mesh
    notes = EditNotes(_describe_problems(replay), _trace_lines(replay), findings_of_new(mesh, home))
    return pack_edited(mesh, mesh, home, notes, replay.mesh)


def preview_action(project: Project, asset: str, mesh: SymbolicMesh, request: PreviewRequest) -> bytes:
    """The packet of an asset after one more action, on its own steps or on what the program makes of it.

    Raises MeshForgeError: no such hull, no such action, or one that fails.
    """
    if request.result:
        return _preview_correction(project, asset, mesh, request)
    action, label = parse_action_text(request.action, asset)
    before = replay_steps(project, asset, mesh, request.steps)
    after = before.apply(before.mask_of(request.select), action, label, project.templates(action.templates))
    start, home = before.incoming_mesh, after.incoming_mesh
    note = "; ".join(note for note in (_describe_problems(before), after.results[-1].note) if note)
    notes = EditNotes(note or None, _trace_lines(after)[-1:], findings_of_new(start, home))
    return pack_edited(mesh, start, home, notes, after.mesh)


def _preview_correction(project: Project, asset: str, mesh: SymbolicMesh, request: PreviewRequest) -> bytes:
    before = run_with_corrections(project, asset, mesh, project.program())
    one = make_correction(before.mesh, asset, request.select, *parse_action_text(request.action, asset))
    templates = {**before.templates, **project.templates(one.action.templates)}
    after, flags = replay_corrections((*before.corrections, one), mesh, before.run.mesh, before.program, templates)
    notes = EditNotes(findings=findings_of_new(before.mesh, after), flags=flags)
    return pack_edited(mesh, before.mesh, after, notes)


def _trace_lines(replay: AssetReplay) -> tuple[TraceLine, ...]:
    return tuple(
        TraceLine(rule=result.rule, selected=result.selected, made=result.made, note=result.error or result.note)
        for result in replay.results
    )


def _describe_problems(replay: AssetReplay) -> str | None:
    """Why steps were left out, None where all were done."""
    return "; ".join(result.error for result in replay.results if result.error) or None


def preview_result(project: Project, asset: str, mesh: SymbolicMesh, of: ResultOf, program: Program | None) -> bytes:
    """The packet of an edited asset. mesh: the asset as it comes; program: what is run, None changes nothing.

    Raises MeshForgeError where the program cannot run on it, or where there is no output.
    """
    if of == "program":
        now = run_with_corrections(project, asset, mesh, program)
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


@dataclass(frozen=True, eq=False, slots=True)
class RunWithCorrections:
    """An asset after the program and the edits by hand; flags: a sentence for each of these that was left out."""

    program: Program
    templates: Mapping[str, Template]
    run: RunResult
    corrections: tuple[Correction, ...]
    mesh: SymbolicMesh
    flags: tuple[str, ...]


def run_with_corrections(
    project: Project, asset: str, mesh: SymbolicMesh, program: Program | None
) -> RunWithCorrections:
    """An asset after a program and its corrections; None changes nothing. Raises MeshForgeError where it cannot run."""
    plan = program or Program(orient=project.orientation)
    corrections = project.corrections(asset)
    names = [*plan.templates, *(name for one in corrections for name in one.action.templates)]
    templates = project.templates(dict.fromkeys(names))
    run = plan.run(mesh, templates)
    after, flags = replay_corrections(corrections, mesh, run.mesh, plan, templates)
    return RunWithCorrections(plan, templates, run, corrections, after, flags)


def make_correction(
    mesh: SymbolicMesh, asset: str, select: Sequence[str], action: Action, label: str | None
) -> Correction:
    """One more edit by hand, on hulls of the mesh. Raises ProjectError for a hull that is not there."""
    for name in select:
        if name not in mesh.index:
            like = nearest_name(name, mesh.index)
            remedy = f"Did you mean {like!r}?" if like else None
            raise ProjectError(f"after the program there is no hull {name!r}", where=asset, remedy=remedy)
    return Correction(tuple((name, digest(mesh.hull_of(name).shape)) for name in select), action, label)
