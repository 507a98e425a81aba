"""The accepted program of a project, and whether what it was learned from has changed since."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from meshforge.batch import RECORD_FILE, file_digest, program_digest, text_digest
from meshforge.common import ProgramError, write_atomically
from meshforge.language import Program
from meshforge.store import ProgramRecord, Settings, read_answers, read_json, write_json, write_program
from meshforge.synthesis import Ambiguous, Found

if TYPE_CHECKING:
    from meshforge.project.project import Project


@dataclass(frozen=True, slots=True)
class ProgramState:
    """How a program stands to what it was learned from.

    outdated: whether that changed since; question: the id of the one that was open when it was learned;
    by_hand: whether a person wrote or changed the program, which then was learned from nothing.
    """

    outdated: bool = False
    question: str | None = None
    by_hand: bool = False


def accept_outcome(project: Project, outcome: Found | Ambiguous, lesson: str) -> None:
    """Keep a learned program, and what it was learned from."""
    write_program(project, outcome.program)
    question = outcome.question.id if outcome.question else None
    learned = ProgramRecord(
        program=program_digest(outcome.program), lesson=lesson, status=outcome.status, question=question
    )
    with project.lock():
        write_json(project.layout.learned, learned)


def read_program_state(project: Project) -> ProgramState:
    """How the project's program stands; one that does not parse is nothing that was learned."""
    try:
        return program_state_of(project, project.program())
    except ProgramError:
        return ProgramState(by_hand=True)


def program_state_of(project: Project, program: Program | None) -> ProgramState:
    """How a program stands to what it was learned from; one that a person wrote or changed is never outdated."""
    if program is None:
        return ProgramState()
    learned = read_json(project.layout.learned, ProgramRecord)
    if not learned or learned.program != program_digest(program):
        return ProgramState(by_hand=True)
    outdated = learned.lesson != digest_learning_inputs(project)
    return ProgramState(outdated, None if outdated else learned.question)


def replace_program(project: Project, old: Program, new: Program, lesson: str, settings: Settings) -> None:
    """Keep a program in which a label was renamed, standing as it stood; under the lock that the caller holds.

    lesson: the digest of what was learned from, before anything was renamed; settings: what they are going to be.
    What it was learned from is written first: killed in between, it is that of the new program already.
    """
    learned = read_json(project.layout.learned, ProgramRecord)
    if learned and learned.program in (program_digest(old), program_digest(new)):
        now = digest_learning_inputs(project, settings) if learned.lesson == lesson else learned.lesson
        write_json(project.layout.learned, learned.model_copy(update={"program": program_digest(new), "lesson": now}))
    if new != old:
        write_atomically(project.layout.program, str(new))


def digest_learning_inputs(project: Project, settings: Settings | None = None) -> str:
    """The digest of all that is learned from: settings, what a person said, and all about the assets of which they said
    something: steps, labels and files. settings: in place of those that are written.
    """
    layout, settings = project.layout, settings or project.settings
    words = [settings.orient, str(settings.vocabulary), str(settings.thresholds)]
    words += [file_digest(layout.answers)] if layout.answers.exists() else []
    answered = {line.asset for line in read_answers(project).answers}
    for asset, path in project.found.ids.items():
        if asset in answered or layout.demonstration(asset).exists():
            files = [layout.demonstration(asset), layout.labels(asset), layout.preparation(asset) / RECORD_FILE, path]
            words += [asset, *(file_digest(file) for file in files if file.is_file())]
    return text_digest("\n".join(words))
