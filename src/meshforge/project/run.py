"""Running the program: the job of each asset, the mesh before a rule, and edits by hand after the last one."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING

from meshforge.batch import RECORD_FILE, ApplyTask, AssetJob, Correction, replay_corrections
from meshforge.common import ProjectError, nearest_name
from meshforge.geometry import digest
from meshforge.language import Action, Program, Template
from meshforge.store import CorrectionsFile, read_corrections, read_json, to_correction_lines, write_json
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Demonstration, advance, begin_replay

if TYPE_CHECKING:
    from meshforge.project.project import Project


def build_jobs(project: Project, only: Collection[str] | None = None) -> tuple[AssetJob, ...]:
    """A job for each asset, or for some, with the project's labels and edits by hand."""
    layout, base = project.layout, project.found.base
    return tuple(
        AssetJob(
            asset,
            path,
            base,
            layout.labels(asset) if layout.labels(asset).exists() else None,
            project.corrections(asset),
            layout.preparation(asset) if (layout.preparation(asset) / RECORD_FILE).exists() else None,
        )
        for asset, path in project.found.ids.items()
        if only is None or asset in only
    )


def build_task(project: Project, program: Program) -> ApplyTask:
    """What `apply` does to each asset; the templates are those of the program and of all edits by hand."""
    corrected = project.found.ids.keys() & set(project.layout.ids_with("corrections"))
    edits = (edit for asset in sorted(corrected) for edit in project.corrections(asset))
    by_hand = (name for edit in edits for name in edit.action.templates)
    templates = project.templates(dict.fromkeys([*program.templates, *by_hand]))
    return ApplyTask(program, templates, project.layout.edited)


def build_work(
    project: Project, only: Collection[str] | None
) -> tuple[Program, tuple[AssetJob, ...], Mapping[str, Template]]:
    """The program, what it is to run on, and the templates. Raises ProjectError: no program yet, or no such asset."""
    for asset in only or ():
        project.path(asset)
    program = project.program()
    if program is None:
        raise ProjectError(
            "there is no program yet",
            where=str(project.folder),
            remedy=f"Learn it: meshforge synthesize {project.folder}",
        )
    return program, build_jobs(project, only), build_task(project, program).templates


def mesh_before_rule(
    project: Project, asset: str, rule: int, program: Program, meshes: Mapping[str, SymbolicMesh] | None = None
) -> SymbolicMesh:
    """The asset before a rule of a program, rules counted from 1; where a demonstration shows a step, after that step.

    meshes: as of `Project.synthesize`. Raises MeshForgeError where the asset cannot be turned, or an action fails.
    """
    mesh = (meshes or {}).get(asset) or project.mesh(asset)
    replay = begin_replay(asset, Demonstration(mesh, project.steps(asset), asset), program.orient, program.contact)
    templates = project.templates(program.templates)
    for number, line in enumerate(program.rules[: rule - 1], 1):
        replay = advance(replay, number, line, templates, program.extremity)
    return replay.mesh


def correct(project: Project, asset: str, select: Sequence[str], action: Action, label: str | None) -> None:
    """Add one edit by hand. Raises ProjectError for a hull that is not there after the program and the other edits."""
    path = project.layout.corrections(asset)
    with project.lock():
        before = read_corrections(path)
        mesh = _mesh_after_program(project, asset, before, action)
        for name in select:
            if name not in mesh.index:
                like = nearest_name(name, mesh.index)
                remedy = f"Did you mean {like!r}?" if like else None
                raise ProjectError(f"after the program there is no hull {name!r}", where=asset, remedy=remedy)
        added = Correction(tuple((name, digest(mesh.hull_of(name).shape)) for name in select), action, label)
        lines = to_correction_lines((*before, added))
        kept = read_json(path, CorrectionsFile)
        fresh = CorrectionsFile(asset=asset, steps=lines)
        write_json(path, kept.model_copy(update={"steps": lines}) if kept else fresh)


def drop_corrections(project: Project, asset: str) -> None:
    """Take all edits by hand away from an asset."""
    with project.lock():
        project.layout.corrections(asset).unlink(missing_ok=True)


def _mesh_after_program(project: Project, asset: str, before: Sequence[Correction], action: Action) -> SymbolicMesh:
    """The asset after the program and the edits by hand so far."""
    program = project.program() or Program(orient=project.orientation)
    names = [*program.templates, *(name for c in before for name in c.action.templates), *action.templates]
    templates = project.templates(dict.fromkeys(names))
    source = project.mesh(asset)
    edited, _ = replay_corrections(before, source, program.run(source, templates).mesh, program, templates)
    return edited
