"""The project's program: kept with what it was learned from, so that it is noticed when that changes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from meshforge.batch import file_digest, program_digest, text_digest
from meshforge.errors import ProgramError
from meshforge.files import write_atomically
from meshforge.language import Program
from meshforge.preparation import RECORD
from meshforge.project.answering import answers
from meshforge.project.json_files import JsonFile, read_json, write_json
from meshforge.project.settings import Settings
from meshforge.synthesis import Ambiguous, Found

if TYPE_CHECKING:
    from meshforge.project.project import Project


class _Learned(JsonFile):
    """What a program was learned from, and what the lesson came to; question: the id of the one that stayed open."""

    program: str
    lesson: str
    status: str = "found"
    question: str | None = None


@dataclass(frozen=True, slots=True)
class Standing:
    """How a program stands to what it was learned from.

    outdated: whether that changed since; question: the id of the one that was open when it was learned;
    by_hand: whether a person wrote or changed the program, which then was learned from nothing.
    """

    outdated: bool = False
    question: str | None = None
    by_hand: bool = False


def accept(project: Project, program: Program) -> None:
    """Keep a program as the project's; one that it takes the place of stays as `program.previous.mf`."""
    path, text = project.layout.program, str(program)
    with project.lock():
        old = path.read_text(encoding="utf-8") if path.exists() else text
        if old != text:
            write_atomically(path.with_name("program.previous.mf"), old)
        write_atomically(path, text)


def keep(project: Project, outcome: Found | Ambiguous, lesson: str) -> None:
    """Keep a learned program, and what it was learned from."""
    accept(project, outcome.program)
    question = outcome.question.id if outcome.question else None
    learned = _Learned(program=program_digest(outcome.program), lesson=lesson, status=outcome.status, question=question)
    with project.lock():
        write_json(project.layout.learned, learned)


def present_standing(project: Project) -> Standing:
    """How the project's program stands; one that does not parse is nothing that was learned."""
    try:
        return standing(project, project.program())
    except ProgramError:
        return Standing(by_hand=True)


def standing(project: Project, program: Program | None) -> Standing:
    """How a program stands to what it was learned from; one that a person wrote or changed is never outdated."""
    if program is None:
        return Standing()
    learned = read_json(project.layout.learned, _Learned)
    if not learned or learned.program != program_digest(program):
        return Standing(by_hand=True)
    outdated = learned.lesson != lesson_digest(project)
    return Standing(outdated, None if outdated else learned.question)


def replace_renamed(project: Project, old: Program, new: Program, lesson: str, settings: Settings) -> None:
    """Keep a program in which a label was renamed, standing as it stood; under the lock that the caller holds.

    lesson: the digest of what was learned from, before anything was renamed; settings: what they are going to be.
    What it was learned from is written first: killed in between, it is that of the new program already.
    """
    learned = read_json(project.layout.learned, _Learned)
    if learned and learned.program in (program_digest(old), program_digest(new)):
        now = lesson_digest(project, settings) if learned.lesson == lesson else learned.lesson
        write_json(project.layout.learned, learned.model_copy(update={"program": program_digest(new), "lesson": now}))
    if new != old:
        write_atomically(project.layout.program, str(new))


def lesson_digest(project: Project, settings: Settings | None = None) -> str:
    """The digest of all that is learned from: settings, what a person said, and all about the assets of which they said
    something: steps, labels and files. settings: in place of those that are written.
    """
    layout, settings = project.layout, settings or project.settings
    words = [settings.orient, str(settings.vocabulary), str(settings.thresholds)]
    words += [file_digest(layout.answers)] if layout.answers.exists() else []
    answered = {line.asset for line in answers(project).answers}
    for asset, path in project.found.ids.items():
        if asset in answered or layout.demonstration(asset).exists():
            files = [layout.demonstration(asset), layout.labels(asset), layout.preparation(asset) / RECORD, path]
            words += [asset, *(file_digest(file) for file in files if file.is_file())]
    return text_digest("\n".join(words))
