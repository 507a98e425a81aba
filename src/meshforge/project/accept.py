"""The accepted program of a project, and whether what it was learned from has changed since."""

from __future__ import annotations

from dataclasses import dataclass

from meshforge.batch import RECORD_FILE, file_digest, program_digest, text_digest
from meshforge.common import ProgramError, write_atomically
from meshforge.language import Program
from meshforge.store import ProgramRecord, Settings, Store
from meshforge.synthesis import Ambiguous, Found


@dataclass(frozen=True, slots=True)
class ProgramState:
    """Whether a program is up to date with what it was learned from.

    outdated: whether that changed since; question: the id of the one that was open when it was learned;
    by_hand: whether a person wrote or changed the program, which then was learned from nothing.
    """

    outdated: bool = False
    question: str | None = None
    by_hand: bool = False


def accept_outcome(store: Store, outcome: Found | Ambiguous, inputs: str) -> None:
    """Keep a learned program, and what it was learned from."""
    store.write_program(outcome.program)
    question = outcome.question.id if outcome.question else None
    record = ProgramRecord(
        program=program_digest(outcome.program), lesson=inputs, status=outcome.status, question=question
    )
    store.write_program_record(record)


def read_program_state(store: Store) -> ProgramState:
    """The state of the project's program; one that does not parse was written by a person."""
    try:
        return program_state_of(store, store.program())
    except ProgramError:
        return ProgramState(by_hand=True)


def program_state_of(store: Store, program: Program | None) -> ProgramState:
    """The state of a program; one that a person wrote or changed is never outdated."""
    if program is None:
        return ProgramState()
    record = store.program_record()
    if not record or record.program != program_digest(program):
        return ProgramState(by_hand=True)
    outdated = record.lesson != digest_learning_inputs(store)
    return ProgramState(outdated, None if outdated else record.question)


def replace_program(store: Store, old: Program, new: Program, inputs: str, settings: Settings) -> None:
    """Keep a program in which a label was renamed, in the same state; under the lock that the caller holds.

    inputs: the digest of what was learned from, before anything was renamed; settings: what they are going to be.
    What it was learned from is written first: killed in between, it is that of the new program already.
    """
    record = store.program_record()
    if record and record.program in (program_digest(old), program_digest(new)):
        now = digest_learning_inputs(store, settings) if record.lesson == inputs else record.lesson
        store.write_program_record(record.model_copy(update={"program": program_digest(new), "lesson": now}))
    if new != old:
        write_atomically(store.layout.program, str(new))


def digest_learning_inputs(store: Store, settings: Settings | None = None) -> str:
    """The digest of all that is learned from: settings, what a person said, and all about the assets of which they said
    something: steps, labels and files. settings: in place of those that are written.
    """
    layout, settings = store.layout, settings or store.settings
    words = [settings.orient, str(settings.vocabulary), str(settings.thresholds)]
    words += [file_digest(layout.answers)] if layout.answers.exists() else []
    concerned = {line.asset for line in store.answers().answers} | set(store.demonstration_ids())
    for asset, path in store.found.ids.items():
        if asset in concerned:
            files = [layout.demonstration(asset), layout.labels(asset), layout.preparation(asset) / RECORD_FILE, path]
            words += [asset, *(file_digest(file) for file in files if file.is_file())]
    return text_digest("\n".join(words))
