"""Running the project's program on its assets, into `edited/`."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.batch import AssetJob, Outcome, Task, apply
from meshforge.errors import ProjectError
from meshforge.formats import Mass
from meshforge.language import Program
from meshforge.preparation import RECORD

if TYPE_CHECKING:
    from meshforge.project.project import Project


def jobs(project: Project) -> tuple[AssetJob, ...]:
    """A job for each asset, with the project's labels and edits by hand."""
    layout, base = project.layout, project.found.base
    return tuple(
        AssetJob(
            asset,
            path,
            base,
            layout.labels(asset) if layout.labels(asset).exists() else None,
            project.corrections(asset),
            layout.preparation(asset) if (layout.preparation(asset) / RECORD).exists() else None,
        )
        for asset, path in project.found.ids.items()
    )


def task(project: Project, program: Program, work: tuple[AssetJob, ...]) -> Task:
    """What `apply` does to each asset; the templates are those of the program and of the edits by hand."""
    by_hand = (name for job in work for correction in job.corrections for name in correction.action.templates)
    templates = project.templates(dict.fromkeys([*program.templates, *by_hand]))
    return Task(program, templates, project.layout.edited)


def apply_program(
    project: Project,
    out: Path,
    *,
    workers: int | None,
    mass: Mass,
    link: bool,
    dry_run: bool,
    resume: bool,
    progress: Callable[[], None] | None,
) -> Iterator[Outcome]:
    """The outcomes of all assets. Raises ProjectError where there is no program yet."""
    program = project.program()
    if program is None:
        raise ProjectError(
            "there is no program yet",
            where=str(project.folder),
            remedy=f"Learn it: meshforge synthesize {project.folder}",
        )
    work = jobs(project)
    return apply(
        program,
        work,
        out,
        templates=task(project, program, work).templates,
        workers=workers,
        mass=mass,
        link=link,
        dry_run=dry_run,
        resume=resume,
        progress=progress,
    )
