"""Single rules: what their readings are, and what questions make of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from statistics import mean
from typing import Any

from benchmark.learning.cases import Case, learn, name_of
from benchmark.learning.programs import TargetProgram
from benchmark.learning.talk import talk
from benchmark.report import Cell, Table
from meshforge.language import Delete, Program, Rule, select_mask, show, size_of
from meshforge.synthesis import LearningOutcome, Options


@dataclass(frozen=True, slots=True)
class RuleCourse:
    """How one rule was learned.

    near: whether readings as large as the hidden extractor are looked for; among: whether one does what it does;
    smallest, believed, taken: whether the first in the order, the most believed one, and the one that the program has
    do so before any answer; right: the last one after all answers; wrong: share of the meshes it edits wrongly then.
    """

    rule: str
    count: int
    readings: int
    near: bool
    among: bool
    smallest: bool
    believed: bool
    taken: bool
    answers: int
    neither: int
    right: bool
    wrong: float
    settled: bool

    def to_json(self) -> dict[str, Any]:
        return asdict(self)


def learn_rule(case: Case, count: int) -> RuleCourse:
    """Learn a rule, and answer until nothing is asked any more."""
    weighed, task = learn(case.search()), _task(case)
    done = talk(task, [task.demonstration(name_of(k)) for k in case.shown], Options(repair=False))
    smallest, truth = weighed.consistent.terms[0], weighed.field.bits(case.hidden)
    believed = max(range(len(weighed.terms)), key=weighed.beliefs.__getitem__)
    wrong = _wrong(case, done.last)
    return RuleCourse(
        f"{case.family}: {show(case.hidden)}",
        count,
        len(weighed.terms),
        size_of(case.hidden) <= smallest.size + Options().above,
        any(term.bits == truth for term in weighed.terms),
        smallest.bits == truth,
        weighed.terms[believed].bits == truth,
        weighed.terms[0].bits == truth,
        len(done.answers),
        done.neither,
        not wrong,
        wrong,
        done.last.unambiguous,
    )


def _task(case: Case) -> TargetProgram:
    """The rule as a program of its own."""
    program = Program(case.vocabulary, None, (Rule(case.hidden, Delete()),))
    return TargetProgram(case.family, program, {name_of(k): mesh for k, mesh in enumerate(case.meshes)}, {})


def _wrong(case: Case, outcome: LearningOutcome) -> float:
    """The share of the meshes on which what was learned selects something else than the hidden extractor."""
    extractor = outcome.rules[0].extractor
    return mean(select_mask(extractor, mesh) != mask for mesh, mask in zip(case.meshes, case.masks, strict=True))


def rules_tables(rows: Sequence[RuleCourse]) -> tuple[Table, ...]:
    """What is open at first, and after all answers."""
    counts = sorted({row.count for row in rows})
    by_count = [(count, [row for row in rows if row.count == count]) for count in counts]
    return (
        Table(
            "Rules, before any question: share right on every mesh, %",
            ("demonstrations", "rules", "smallest", "most believed", "taken", "among readings", "near", "among, near"),
            tuple(_open(count, few) for count, few in by_count),
        ),
        Table(
            "Rules, with questions answered by the truth",
            (
                "demonstrations",
                "answers a rule",
                "no answer needed, %",
                "most",
                "neither, % of answers",
                "right, %",
                "meshes edited wrongly, %",
                "settled, %",
                "settled but wrong",
            ),
            tuple(_count_answers(count, few) for count, few in by_count),
        ),
    )


def percent(some: Sequence[bool] | Sequence[float]) -> float:
    """The mean of shares or of yes and no, in percent."""
    return 100 * mean(map(float, some)) if some else 0.0


def _open(count: int, rows: Sequence[RuleCourse]) -> tuple[Cell, ...]:
    near = [row.among for row in rows if row.near]
    return (
        count,
        len(rows),
        percent([row.smallest for row in rows]),
        percent([row.believed for row in rows]),
        percent([row.taken for row in rows]),
        percent([row.among for row in rows]),
        len(near),
        percent(near),
    )


def _count_answers(count: int, rows: Sequence[RuleCourse]) -> tuple[Cell, ...]:
    answers = sum(row.answers for row in rows)
    return (
        count,
        answers / len(rows),
        percent([not row.answers for row in rows]),
        max(row.answers for row in rows),
        100 * sum(row.neither for row in rows) / max(answers, 1),
        percent([row.right for row in rows]),
        percent([row.wrong for row in rows]),
        percent([row.settled for row in rows]),
        sum(row.settled and not row.right for row in rows),
    )
