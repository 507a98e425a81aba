"""How a family stands before any question of the queue: taught as it was before there was one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from benchmark.signoff.judge import Judge
from benchmark.signoff.tool import Tool, program_of
from benchmark.study.condition import Condition
from benchmark.study.course import Course
from benchmark.study.desk import Bench
from meshforge.common import MeshForgeError


@dataclass(frozen=True, slots=True)
class FirstLook:
    """One family. right: of the possible assets; pairs: of each of them that was neither demonstrated nor looked
    at, the probability that the tool gives it, and whether it is right."""

    task: str
    condition: str
    seed: int
    possible: int
    right: int
    pairs: tuple[tuple[float, bool], ...]

    @staticmethod
    def of_json(row: dict[str, Any]) -> FirstLook:
        return FirstLook(**{**row, "pairs": tuple((share, right) for share, right in row["pairs"])})


def open_review(
    bench: Bench, condition: Condition, seed: int, tool: Tool | None = None, tells_looks: bool = True
) -> FirstLook:
    """Teach a task as before, on labels as the tool takes them now, and look how the family stands then.

    tool: another than the product. tells_looks: whether the person tells which results they found right in the end.
    """
    judge, tool = Judge(bench), tool or Tool(bench, condition)
    course = Course(bench, condition, seed)
    course.desk = tool.take_labels(course.desk)
    course.session(())
    desk = tool.take_labels(course.desk)
    outcome = None if isinstance(course.outcome, MeshForgeError) else course.outcome
    demos = {name: course.person.shows(desk, name, rules) for name, rules in course.given.items()}
    program = program_of(outcome)
    told = sorted(course.found_right) if tells_looks else ()
    seen = {name: course.desk.select(program, name) for name in told if program}
    accepted = {name: done for name, done in seen.items() if done is not None}
    state = tool.begin(desk, demos, course.answers, {**course.accepted, **accepted})
    assessment = tool.review(desk, state, outcome)
    right = {name for name in bench.samples if judge.is_right(desk, program, name)}
    known = {*course.log.shown, *state.accepted}
    rest = [name for name in bench.samples if name in judge.possible and name not in known]
    pairs = tuple((round(assessment.assets[name].probability, 4), name in right) for name in rest if program)
    return FirstLook(bench.task.name, condition.name, seed, len(judge.possible), len(right), pairs)
