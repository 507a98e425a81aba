"""What a program makes of an asset, with the edits by hand that come after it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from meshforge.batch import Correction, replay
from meshforge.errors import ProjectError, nearest
from meshforge.geometry import digest
from meshforge.language import Action, Program, RunResult, Template
from meshforge.project import Project
from meshforge.symbolic import SymbolicMesh


@dataclass(frozen=True, eq=False, slots=True)
class Corrected:
    """An asset after the program and the edits by hand; flags: a sentence for each of these that was left out."""

    program: Program
    templates: Mapping[str, Template]
    run: RunResult
    corrections: tuple[Correction, ...]
    mesh: SymbolicMesh
    flags: tuple[str, ...]


def corrected(project: Project, asset: str, mesh: SymbolicMesh, program: Program | None) -> Corrected:
    """What a program makes of an asset now; None changes nothing. Raises MeshForgeError where it cannot run."""
    plan = program or Program(orient=project.orientation)
    corrections = project.corrections(asset)
    names = [*plan.templates, *(name for one in corrections for name in one.action.templates)]
    templates = project.templates(dict.fromkeys(names))
    run = plan.run(mesh, templates)
    after, flags = replay(corrections, mesh, run.mesh, plan, templates)
    return Corrected(plan, templates, run, corrections, after, flags)


def added(mesh: SymbolicMesh, asset: str, select: Sequence[str], action: Action, label: str | None) -> Correction:
    """One edit by hand more, on hulls of the mesh. Raises ProjectError for one that is not there."""
    for name in select:
        if name not in mesh.index:
            like = nearest(name, mesh.index)
            remedy = f"Did you mean {like!r}?" if like else None
            raise ProjectError(f"after the program there is no hull {name!r}", where=asset, remedy=remedy)
    return Correction(tuple((name, digest(mesh.hull_of(name).shape)) for name in select), action, label)
