"""What an asset is after its own steps, and what one more action would do."""

from __future__ import annotations

from meshforge.batch import replay
from meshforge.project import Project, parse_action_text
from meshforge.studio.showing.course import Course
from meshforge.studio.showing.replaying import walk
from meshforge.studio.showing.staging.corrected import added, corrected
from meshforge.studio.showing.staging.packets import Told, edited_packet, findings_of_made
from meshforge.studio.wire.asset import TraceLine
from meshforge.studio.wire.requests import PreviewRequest
from meshforge.symbolic import SymbolicMesh


def staged(project: Project, asset: str, mesh: SymbolicMesh, steps: int) -> bytes:
    """The packet of an asset after its first steps; mesh: the asset as it comes.

    A step that cannot be done is left out, and the note says why. Raises ProgramError where it cannot be turned.
    """
    course = walk(project, asset, mesh, steps)
    home = course.incoming_mesh
    told = Told(_problems(course), _trace(course), findings_of_made(mesh, home))
    return edited_packet(mesh, mesh, home, told, course.mesh)


def preview(project: Project, asset: str, mesh: SymbolicMesh, request: PreviewRequest) -> bytes:
    """The packet of an asset after one action more, on its own steps or on what the program makes of it.

    Raises MeshForgeError: no such hull, no such action, or one that cannot be done.
    """
    return (_preview_by_hand if request.result else _preview_step)(project, asset, mesh, request)


def _preview_step(project: Project, asset: str, mesh: SymbolicMesh, request: PreviewRequest) -> bytes:
    action, label = parse_action_text(request.action, asset)
    before = walk(project, asset, mesh, request.steps)
    after = before.apply(before.mask_of(request.select), action, label, project.templates(action.templates))
    start, home = before.incoming_mesh, after.incoming_mesh
    deed = after.results[-1]
    notes = "; ".join(note for note in (_problems(before), deed.note) if note)
    told = Told(notes or None, _trace(after)[-1:], findings_of_made(start, home))
    return edited_packet(mesh, start, home, told, after.mesh)


def _preview_by_hand(project: Project, asset: str, mesh: SymbolicMesh, request: PreviewRequest) -> bytes:
    before = corrected(project, asset, mesh, project.program())
    one = added(before.mesh, asset, request.select, *parse_action_text(request.action, asset))
    templates = {**before.templates, **project.templates(one.action.templates)}
    after, flags = replay((*before.corrections, one), mesh, before.run.mesh, before.program, templates)
    told = Told(findings=findings_of_made(before.mesh, after), flags=flags)
    return edited_packet(mesh, before.mesh, after, told)


def _trace(course: Course) -> tuple[TraceLine, ...]:
    return tuple(
        TraceLine(rule=deed.rule, selected=deed.selected, made=deed.made, note=deed.error or deed.note)
        for deed in course.results
    )


def _problems(course: Course) -> str | None:
    """Why steps were left out, None where all were done."""
    return "; ".join(deed.error for deed in course.results if deed.error) or None
