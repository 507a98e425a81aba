"""How a family stands before any question of the queue: taught as it was before there was one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from benchmark.signoff.client import Client, FamilyStatus
from benchmark.signoff.judge import Judge
from benchmark.study import Bench, Condition, open_course
from benchmark.study.project import name_by_files
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
    """Teach a task as before, on labels as the product takes them now, and look how the family stands then in the
    project.

    client: what it is told with. tells_looks: whether the person tells which results they found right in the end.
    """
    bench = name_by_files(bench)
    judge = Judge(bench)
    with open_course(bench, condition, seed, takes_labels=True) as course:
        course.session(())
        person = client(course.client.project)
        status = _look(person, sorted(course.found_right) if tells_looks else [])
        right = {name for name in bench.samples if judge.is_right(name, person.read_output(name))}
        verdicts = person.project.feedback().verdicts
        looked_at = {name for name, some in verdicts.items() if some[-1].verdict == "accepted"}
    known = {*course.log.shown, *looked_at}
    rest = [name for name in bench.samples if name in judge.possible and name not in known]
    shares = status.probabilities if status and status.has_program else {}
    pairs = tuple((round(shares[name], 4), name in right) for name in rest if name in shares)
    return FirstLook(bench.task.name, condition.name, seed, len(judge.possible), len(right), pairs)


def _look(client: Client, found_right: list[str]) -> FamilyStatus | None:
    """How the family stands when the person has told which results are right; None where the project refuses that."""
    client.take_labels()
    try:
        status = client.review()
        for name in found_right:
            client.accept(name)
        return client.review() if found_right else status
    except MeshForgeError:
        return None
