"""How a family stands before any question of the queue: taught as it was before there was one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from benchmark.signoff.client import Client, FamilyStatus
from benchmark.signoff.judge import Judge
from benchmark.signoff.project import name_by_files, open_project, take_labels
from benchmark.study.condition import Condition
from benchmark.study.course import Course
from benchmark.study.desk import Bench
from meshforge.common import MeshForgeError
from meshforge.project import Project


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
    bench: Bench,
    condition: Condition,
    seed: int,
    client: Callable[[Project], Client] = Client,
    tells_looks: bool = True,
) -> FirstLook:
    """Teach a task as before, on labels as the product takes them now, and look how the family stands then in a project
    that is told of it.

    client: what it is told with. tells_looks: whether the person tells which results they found right in the end.
    """
    bench = name_by_files(bench)
    judge, course = Judge(bench), Course(bench, condition, seed)
    course.desk = take_labels(course.desk)
    course.session(())
    with open_project(course.desk) as project:
        person = client(project)
        status = _tell(course, person, sorted(course.found_right) if tells_looks else [])
        right = {name for name in bench.samples if judge.is_right(name, person.read_output(name))}
        looked_at = {name for name, some in project.feedback().verdicts.items() if some[-1].verdict == "accepted"}
    known = {*course.log.shown, *looked_at}
    rest = [name for name in bench.samples if name in judge.possible and name not in known]
    shares = status.probabilities if status and status.has_program else {}
    pairs = tuple((round(shares[name], 4), name in right) for name in rest if name in shares)
    return FirstLook(bench.task.name, condition.name, seed, len(judge.possible), len(right), pairs)


def _tell(course: Course, client: Client, found_right: list[str]) -> FamilyStatus | None:
    """Tell a project all that was shown, answered and accepted, and look at it; None where it refuses that.

    found_right: results that are accepted now, besides those that were before and are as they were.
    """
    client.take_labels()
    for name, rules in course.given.items():
        client.demonstrate(name, course.person.shows(course.desk, name, rules).steps)
    for answer in course.answers:
        client.project.add_answer(answer)
    try:
        status = client.review()
        outputs = {name: client.read_output(name) for name in course.accepted}
        same = [name for name, one in outputs.items() if one and one.selections == course.accepted[name]]
        for name in dict.fromkeys([*same, *found_right]):
            client.accept(name)
        return client.review() if same or found_right else status
    except MeshForgeError:
        return None
