"""What became of an asset: what the program makes of it now, or its written output."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal

from meshforge.batch import RuleLine, read_stamp
from meshforge.checks import check
from meshforge.errors import ProjectError
from meshforge.formats import load
from meshforge.language import Program, RuleTrace
from meshforge.project import Project
from meshforge.studio.showing.staging.corrected import corrected
from meshforge.studio.showing.staging.packets import Told, edited_packet, finding_views
from meshforge.studio.wire.asset import TraceLine
from meshforge.symbolic import SymbolicMesh

Of = Literal["program", "output"]


def result(project: Project, asset: str, mesh: SymbolicMesh, of: Of, program: Program | None) -> bytes:
    """The packet of an edited asset. mesh: the asset as it comes; program: what is run, None changes nothing.

    Raises MeshForgeError where the program cannot run on it, or where there is no output.
    """
    return _output(project, asset, mesh) if of == "output" else _run(project, asset, mesh, program)


def _run(project: Project, asset: str, mesh: SymbolicMesh, program: Program | None) -> bytes:
    now = corrected(project, asset, mesh, program)
    return edited_packet(mesh, mesh, now.mesh, _told(now.mesh, now.run.trace, now.flags))


def _output(project: Project, asset: str, mesh: SymbolicMesh) -> bytes:
    stamp = read_stamp(project.layout.edited, asset)
    if stamp is None or stamp.status not in ("edited", "unchanged"):
        why = stamp.error if stamp and stamp.error else None
        raise ProjectError(why or "it has no output yet", where=asset, remedy="Apply the program.")
    after = load(project.layout.edited / stamp.out)
    return edited_packet(mesh, mesh, after, _told(after, stamp.rules, stamp.flags))


def _told(mesh: SymbolicMesh, rules: Iterable[RuleTrace | RuleLine], flags: tuple[str, ...]) -> Told:
    trace = tuple(TraceLine(rule=r.rule, selected=r.selected, made=r.made, note=r.note) for r in rules)
    return Told(trace=trace, findings=finding_views(check(mesh)), flags=flags)
