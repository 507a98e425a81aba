"""Whole programs: how many demonstrations and answers it takes until nothing is asked any more."""

from __future__ import annotations

import random
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from statistics import mean
from typing import Any

from benchmark.learning.families import FAMILIES
from benchmark.learning.programs import TargetProgram, target_programs
from benchmark.learning.rule_courses import percent
from benchmark.learning.talk import talk
from benchmark.report import Cell, Table, Tell
from meshforge.language import Program
from meshforge.synthesis import Demonstration, Options


@dataclass(frozen=True, slots=True)
class ProgramCourse:
    """How one program was learned; at_once: right before any answer; wrong: share of the meshes edited wrongly."""

    program: str
    seed: int
    count: int
    rules: int
    status: str
    at_once: bool
    answers: int
    neither: int
    refused: int
    wrong: float
    settled: bool


def programs_tables(
    tell: Tell, seeds: Iterable[int], counts: Sequence[int], only: Sequence[str] | None
) -> tuple[tuple[Table, ...], list[dict[str, Any]]]:
    """Teach the programs of all families from so many demonstrations each."""
    rows: list[ProgramCourse] = []
    for seed in seeds:
        for task in target_programs(seed, only or tuple(FAMILIES)):
            for count in counts:
                rows += teach_program(task, seed, count)
            tell(f"programs: {len(rows)} learned")
    columns = (
        "demonstrations",
        "programs",
        "rules",
        "right at once, %",
        "answers",
        "demonstrations plus answers",
        "neither",
        "repairs refused",
        "right, %",
        "meshes edited wrongly, %",
        "settled, %",
        "settled but wrong",
    )
    table = Table("Programs, a program", columns, tuple(_row(c, [r for r in rows if r.count == c]) for c in counts))
    return (table,), [asdict(row) for row in rows]


def teach_program(task: TargetProgram, seed: int, count: int) -> list[ProgramCourse]:
    """Teach one program; nothing where no mesh has all that it is about."""
    draw = random.Random(f"{seed}{task.name}")
    telling = task.find_examples()
    if not telling:
        return []
    first = draw.choice(telling)
    shown = [first, *draw.sample([name for name in task.meshes if name != first], count - 1)]
    return [_teach(task, seed, [task.demonstration(name) for name in shown])]


def _teach(task: TargetProgram, seed: int, demos: Sequence[Demonstration]) -> ProgramCourse:
    done = talk(task, demos, Options())
    return ProgramCourse(
        task.name,
        seed,
        len(demos),
        len(task.program.rules),
        done.last.status,
        not _wrong(task, done.first.program),
        len(done.answers),
        done.neither,
        done.refused,
        _wrong(task, done.last.program),
        done.last.unambiguous,
    )


def _wrong(task: TargetProgram, program: Program | None) -> float:
    """The share of the meshes on which a rule of a program selects something else than is wanted."""
    if program is None:
        return 1.0
    return mean(task.select(program, asset) != right for asset, right in task.right.items())


def _row(count: int, rows: Sequence[ProgramCourse]) -> tuple[Cell, ...]:
    many = max(len(rows), 1)
    answers = sum(row.answers for row in rows) / many
    return (
        count,
        len(rows),
        sum(row.rules for row in rows) / many,
        percent([row.at_once for row in rows]),
        answers,
        count + answers,
        sum(row.neither for row in rows) / many,
        sum(row.refused for row in rows) / many,
        percent([not row.wrong for row in rows]),
        percent([row.wrong for row in rows]),
        percent([row.settled for row in rows]),
        sum(row.settled and row.wrong > 0 for row in rows),
    )
