"""Learning again after each thing that a person said, with pictures of what is asked; and without a person at the
terminal, with answers from a file.
"""

from __future__ import annotations

import json
import shlex
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from types import NoneType
from typing import Any

from meshforge import symbolic, synthesis
from meshforge.cli.console import progress
from meshforge.cli.synthesize_text import describe_change
from meshforge.cli.terminal import catch_interrupt, remark
from meshforge.common import UsageError
from meshforge.project import Project, select_assets


@dataclass
class LearningSession:
    """Learns as often as it is asked to.

    keep: whether programs, answers and repairs are kept in the project. stopped: whether a person ended the last
    search; given: answers that are not kept.
    """

    project: Project
    options: synthesis.Options
    keep: bool = True
    stopped: bool = False
    given: dict[tuple[int, str], synthesis.Answer] = field(default_factory=dict)

    def learn(self, confirm: Callable[[synthesis.Repair], bool] | None = None) -> synthesis.LearningOutcome:
        """What is learned from all that is known by now."""
        with progress(None, "learning") as shown, catch_interrupt() as stop:

            def ask(repair: synthesis.Repair) -> bool:
                shown.clear()
                return confirm is not None and confirm(repair)

            outcome = self.project.synthesize(
                accept=self.keep,
                options=self.options,
                confirm=ask if confirm else None,
                stop=stop,
                answers=tuple(self.given.values()),
                meshes=self.meshes(),
            )
            self.stopped = stop()
        return outcome

    def answer(self, answer: synthesis.Answer) -> None:
        """Take an answer into account from now on. Raises ProjectError: no such asset or rule."""
        if self.keep:
            self.project.add_answer(answer)
        else:
            self.given[answer.rule, answer.asset] = answer

    def meshes(self) -> dict[str, symbolic.SymbolicMesh]:
        """The assets that can be read."""
        return dict(self.project.meshes_by_id(select_assets(self.project)))


ANSWERS_FORM = (
    'The file holds a list of {"question": "RULE:ASSET", "choice": 1} (null for neither) '
    'or {"rule": 1, "asset": "ASSET", "select": ["HULL", ...]} (null for neither).'
)


@dataclass(frozen=True, slots=True)
class ScriptAnswers:
    """What a file answers. direct: whether asked or not; choices: by the question's id, counted from 1."""

    direct: tuple[synthesis.Answer, ...]
    choices: dict[str, int | None]


def read_answers(path: Path, project: Project) -> ScriptAnswers:
    """Read the file. Raises UsageError naming the entry: not of that form, or a question that cannot be."""
    entries = _read_entries(path)
    direct, choices = [], {}
    for number, entry in enumerate(entries, 1):
        match entry:
            case {"question": str(question), "choice": int() | None as choice, **rest} if not rest:
                if isinstance(choice, bool) or (choice is not None and choice < 1):
                    raise _entry_error(path, number, f"the choice {choice!r} is no number from 1")
                _check_question(question, path, number, project)
                choices[question] = choice
            case {"rule": int(rule), "asset": str(asset), "select": list() | None as select, **rest} if rest.keys() <= {
                "id",
                "action",
                "refused",
            } and all(isinstance(name, str) for name in select or ()):
                project.path(asset)
                direct.append(synthesis.Answer(rule, asset, select))
            case _:
                raise _entry_error(path, number, _describe_misfit(entry))
    return ScriptAnswers(tuple(direct), choices)


def _describe_misfit(entry: Any) -> str:
    if not isinstance(entry, dict):
        return "it is no object {...}"
    direct = "question" not in entry
    fields: dict[str, type | tuple[type, ...]] = (
        {"rule": int, "asset": str, "select": (list, NoneType)}
        if direct
        else {"question": str, "choice": (int, NoneType)}
    )
    for name, kind in fields.items():
        if name not in entry:
            return f"it has no field {name!r}"
        if not isinstance(entry[name], kind):
            return f"the field {name!r} cannot be {entry[name]!r}"
    if odd := entry.keys() - fields.keys() - ({"id", "action", "refused"} if direct else set()):
        return f"it has a field {min(odd)!r}, which is none of an answer"
    return "its hulls are not all names"


def _read_entries(path: Path) -> list[Any]:
    try:
        entries = json.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise UsageError(f"cannot be read: {error.strerror}", where=str(path)) from error
    except ValueError as error:
        raise UsageError(f"this is no JSON: {error}", where=str(path), remedy=ANSWERS_FORM) from error
    if not isinstance(entries, list):
        raise UsageError("this is no list of answers", where=str(path), remedy=ANSWERS_FORM)
    return entries


def _check_question(question: str, path: Path, number: int, project: Project) -> None:
    """Whether there can be such a question: of a rule, and an asset of the project."""
    rule, _, asset = question.partition(":")
    if not rule.isdecimal() or not asset:
        raise _entry_error(path, number, f"{question!r} is no question; one is called RULE:ASSET")
    project.path(asset)


def _entry_error(path: Path, number: int, problem: str) -> Exception:
    return UsageError(f"answer {number}: {problem}", where=str(path), remedy=ANSWERS_FORM)


def run_script(
    session: LearningSession, given: ScriptAnswers | None, verdict: bool | None
) -> synthesis.LearningOutcome:
    """The outcome after all answers that were given; verdict: what is said to each repair, None leaves it open."""
    for answer in given.direct if given else ():
        session.answer(answer)
    waiting = given.choices if given else {}
    confirm = None if verdict is None else _confirm_always(verdict)
    outcome = session.learn(confirm)
    while isinstance(outcome, synthesis.Ambiguous) and outcome.question.id in waiting:
        session.answer(outcome.question.answer_with(_choice_index(outcome.question, waiting.pop(outcome.question.id))))
        outcome = session.learn(confirm)
    return outcome


def check_all_asked(project: Project, given: ScriptAnswers | None, outcome: synthesis.LearningOutcome) -> None:
    """Say which choices are left over since their questions were answered earlier. Raises UsageError for one whose
    question never came up."""
    known = project.feedback().answers_and_fixes
    left = given.choices if given else {}
    for question in (question for question in left if question in known):
        remark(f"{question} was answered before, which stays; --forget {shlex.quote(question)} takes that back")
    if odd := [question for question in left if question not in known]:
        asked = f"The open question is {outcome.question.id}." if outcome.question else "No question is open."
        raise UsageError(f"the question {odd[0]} did not come up", remedy=asked)


def _choice_index(question: synthesis.Question, choice: int | None) -> int | None:
    if choice is not None and choice > len(question.choices):
        count = len(question.choices)
        raise UsageError(f"the question {question.id} has {count} choices, there is no choice {choice}")
    return None if choice is None else choice - 1


def _confirm_always(verdict: bool) -> Callable[[synthesis.Repair], bool]:
    """Answers every repair alike, and reports it."""

    def confirm(repair: synthesis.Repair) -> bool:
        remark(f"{'repaired' if verdict else 'left as it is'}: {describe_change(repair)}")
        return verdict

    return confirm
