"""What running the project's program on its assets takes: jobs and templates."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING

from meshforge.batch import AssetJob, Task
from meshforge.errors import ProjectError
from meshforge.language import Program, Template
from meshforge.preparation import RECORD

if TYPE_CHECKING:
    from meshforge.project.project import Project


def jobs(project: Project, only: Collection[str] | None = None) -> tuple[AssetJob, ...]:
    """A job for each asset, or for some, with the project's labels and edits by hand."""
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
        if only is None or asset in only
    )


def task(project: Project, program: Program) -> Task:
    """What `apply` does to each asset; the templates are those of the program and of all edits by hand."""
    corrected = project.found.ids.keys() & set(project.layout.ids_with("corrections"))
    edits = (edit for asset in sorted(corrected) for edit in project.corrections(asset))
    by_hand = (name for edit in edits for name in edit.action.templates)
    templates = project.templates(dict.fromkeys([*program.templates, *by_hand]))
    return Task(program, templates, project.layout.edited)


def work(
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
    return program, jobs(project, only), task(project, program).templates
