"""corrections/ID.json: edits by hand on one asset, replayed after the program."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.batch import Correction, replay
from meshforge.errors import ProjectError, nearest
from meshforge.geometry import digest
from meshforge.language import Action, Program
from meshforge.project.json_files import read_json, write_json
from meshforge.project.steps import CorrectionsFile, correction_lines, corrections_of
from meshforge.symbolic import SymbolicMesh

if TYPE_CHECKING:
    from meshforge.project.project import Project


def corrections(path: Path) -> tuple[Correction, ...]:
    """The edits by hand in a file, none where there is no such file."""
    kept = read_json(path, CorrectionsFile)
    return corrections_of(kept.steps, path) if kept else ()


def correct(project: Project, asset: str, select: Sequence[str], action: Action, label: str | None) -> None:
    """Add one edit by hand. Raises ProjectError for a hull that is not there after the program and the other edits."""
    path = project.layout.corrections(asset)
    with project.lock():
        before = corrections(path)
        mesh = _edited(project, asset, before, action)
        for name in select:
            if name not in mesh.index:
                like = nearest(name, mesh.index)
                remedy = f"Did you mean {like!r}?" if like else None
                raise ProjectError(f"after the program there is no hull {name!r}", where=asset, remedy=remedy)
        added = Correction(tuple((name, digest(mesh.hull_of(name).shape)) for name in select), action, label)
        lines = correction_lines((*before, added))
        kept = read_json(path, CorrectionsFile)
        fresh = CorrectionsFile(asset=asset, steps=lines)
        write_json(path, kept.model_copy(update={"steps": lines}) if kept else fresh)


def drop(project: Project, asset: str) -> None:
    """Take all edits by hand away from an asset."""
    with project.lock():
        project.layout.corrections(asset).unlink(missing_ok=True)


def _edited(project: Project, asset: str, before: Sequence[Correction], action: Action) -> SymbolicMesh:
    """The asset after the program and the edits by hand so far."""
    program = project.program() or Program(orient=project.orientation)
    names = [*program.templates, *(name for c in before for name in c.action.templates), *action.templates]
    templates = project.templates(dict.fromkeys(names))
    source = project.mesh(asset)
    edited, _ = replay(before, source, program.run(source, templates).mesh, program, templates)
    return edited
