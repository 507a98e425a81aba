"""Learning with a person who knows what is wanted: answers questions by the truth, refuses to correct right labels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from benchmark.learning.programs import TargetProgram
from meshforge.synthesis import Ambiguous, Answer, Demonstration, LearningOutcome, Options, Repair, synthesize

_MOST = 30  # answers, should it never end


@dataclass(frozen=True, eq=False)
class Talk:
    """How it went; first: the outcome before any answer, last: after all; refused: proposals to correct a label."""

    first: LearningOutcome
    last: LearningOutcome
    answers: tuple[Answer, ...]
    refused: int

    @property
    def neither(self) -> int:
        """How many answers were that no choice is right."""
        return sum(answer.select is None for answer in self.answers)


def talk(task: TargetProgram, demos: Sequence[Demonstration], options: Options) -> Talk:
    """Learn from demonstrations, and answer until nothing is asked any more."""
    answers: list[Answer] = []
    refused: list[Repair] = []

    def refuse(repair: Repair) -> bool:
        refused.append(repair)
        return False

    def learn() -> LearningOutcome:
        labels, meshes = task.program.labels, task.meshes
        return synthesize(demos, meshes, vocabulary=labels, options=options, confirm=refuse, answers=answers)

    last = first = learn()
    while isinstance(last, Ambiguous) and len(answers) < _MOST:
        answers.append(_answer(task, last))
        last = learn()
    return Talk(first, last, tuple(answers), len({repair.fix for repair in refused}))


def _answer(task: TargetProgram, outcome: Ambiguous) -> Answer:
    """The selection that is wanted, or none of them."""
    one = outcome.open_rule
    meant = task.intend(one.asset, one.rule, outcome)
    return (
        Answer(one.rule, one.asset, meant)
        if meant in one.selections
        else Answer(one.rule, one.asset, None, one.selections)
    )
