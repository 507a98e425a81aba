"""Learning the project's program from its demonstrations, and keeping it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.batch import file_digest, program_digest, text_digest
from meshforge.errors import ProjectError
from meshforge.files import write_atomically
from meshforge.language import Program
from meshforge.preparation import RECORD
from meshforge.project.json_files import JsonFile, read_json, write_json
from meshforge.synthesis import Ambiguous, Found, Options, Outcome, synthesize

if TYPE_CHECKING:
    from meshforge.project.project import Project


class _Learned(JsonFile):
    """What a program was learned from, so that it is noticed when that changes."""

    program: str
    lesson: str


def learn(project: Project, accepting: bool, options: Options | None) -> Outcome:
    """What can be learned from the demonstrations. Raises ProjectError where there are none."""
    demos = project.demonstrations()
    if not demos:
        raise ProjectError(
            "nothing is demonstrated yet",
            where=str(project.folder),
            remedy=f"Show the steps on an asset or two: meshforge demonstrate {project.folder} ASSET STEPS...",
        )
    lesson = lesson_digest(project)
    settings = project.settings
    names = dict.fromkeys(name for demo in demos.values() for step in demo.steps for name in step.action.templates)
    outcome = synthesize(
        tuple(demos.values()),
        batch=dict(project.named_meshes()),
        orient=project.orientation,
        templates=project.templates(names),
        vocabulary=settings.vocabulary or None,
        contact=settings.thresholds.contact,
        extremity=settings.thresholds.extremity,
        options=options or Options(),
    )
    if accepting and isinstance(outcome, Found | Ambiguous):
        accept(project, outcome.program)
        with project.lock():
            learned = _Learned(program=program_digest(outcome.program), lesson=lesson)
            write_json(project.layout.learned, learned)
    return outcome


def accept(project: Project, program: Program) -> None:
    """Keep a program as the project's; one that it takes the place of stays as `program.previous.mf`."""
    path, text = project.layout.program, str(program)
    with project.lock():
        old = path.read_text(encoding="utf-8") if path.exists() else text
        if old != text:
            write_atomically(path.with_name("program.previous.mf"), old)
        write_atomically(path, text)


def is_outdated(project: Project, program: Program) -> bool:
    """Whether a program was learned here, and from other demonstrations, labels or settings than there are now.

    A program that a person wrote or changed is never outdated.
    """
    learned = read_json(project.layout.learned, _Learned)
    if not learned or learned.program != program_digest(program):
        return False
    return learned.lesson != lesson_digest(project)


def lesson_digest(project: Project) -> str:
    """The digest of all that is learned from: settings, and the steps, labels and files of demonstrated assets."""
    layout, settings = project.layout, project.settings
    words = [settings.orient, str(settings.vocabulary), str(settings.thresholds)]
    for asset, path in project.found.ids.items():
        if layout.demonstration(asset).exists():
            files = [layout.demonstration(asset), layout.labels(asset), layout.preparation(asset) / RECORD, path]
            words += [asset, *(file_digest(file) for file in files if file.is_file())]
    return text_digest("\n".join(words))
