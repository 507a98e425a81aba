"""Learning without a person at the terminal: answers come from a file, repairs are taken or refused as told."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from meshforge.cli.lessons import Lessons

if TYPE_CHECKING:
    from meshforge.cli.given_answers import Given
    from meshforge.project import Project
    from meshforge.synthesis import Outcome, Question, Repair


def scripted(lessons: Lessons, given: Given | None, verdict: bool | None) -> Outcome:
    """The outcome after all answers that were given; verdict: what is said to each repair, None leaves it open."""
    from meshforge.synthesis import Ambiguous

    for answer in given.direct if given else ():
        lessons.answer(answer)
    waiting = given.choices if given else {}
    confirm = None if verdict is None else _always(verdict)
    outcome = lessons.learn(confirm)
    while isinstance(outcome, Ambiguous) and outcome.question.id in waiting:
        lessons.answer(outcome.question.answer_with(_place(outcome.question, waiting.pop(outcome.question.id))))
        outcome = lessons.learn(confirm)
    return outcome


def check_all_asked(project: Project, given: Given | None, outcome: Outcome) -> None:
    """Raise UsageError where a choice is left over, whose question did not come up now or earlier."""
    from meshforge.errors import UsageError

    known = set(project.answers().ids)
    odd = [question for question in (given.choices if given else {}) if question not in known]
    if odd:
        asked = f"The open question is {outcome.question.id}." if outcome.question else "No question is open."
        raise UsageError(f"the question {odd[0]} did not come up", remedy=asked)


def _place(question: Question, choice: int | None) -> int | None:
    from meshforge.errors import UsageError

    if choice is not None and choice > len(question.choices):
        count = len(question.choices)
        raise UsageError(f"the question {question.id} has {count} choices, there is no choice {choice}")
    return None if choice is None else choice - 1


def _always(verdict: bool) -> Callable[[Repair], bool]:
    from meshforge.cli.cards import change
    from meshforge.cli.output import remark

    def said(repair: Repair) -> bool:
        remark(f"{'mended' if verdict else 'left as it is'}: {change(repair)}")
        return verdict

    return said
