"""The tool as it was, before there was a queue; and the person who then glances at every asset and mends by hand.

As the tool has changed since, its figures are kept in `before.json`.
"""

from __future__ import annotations

import json
import random
import subprocess
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from typing import Any

from benchmark.journal import ROOT, run_units
from benchmark.report import Tell
from benchmark.signoff.conditions import ASKED, ON_REAL, list_benches, list_real_tasks, list_tasks
from benchmark.signoff.judge import Judge, run_on_desk
from benchmark.signoff.ledger import price_of_hand, price_of_mend
from benchmark.signoff.point import Point
from benchmark.study import CONDITIONS, Bench, Condition, Desk, open_course
from benchmark.study.course import Course
from benchmark.study.keystrokes import GLANCE, model_seconds
from benchmark.study.project import name_by_files
from meshforge.common import write_atomically
from meshforge.language import Program

FROZEN = Path(__file__).resolve().parent / "before.json"
_COMMAND = "python -m benchmark.signoff before"


@dataclass(frozen=True, slots=True)
class Before:
    """One session. assets, possible: of the family, and those that the reference gets right under true labels;
    reference: those that it gets right under the labels that the person got in the end;
    points: after each round of learning, and at the end; settled: whether the tool said so, and the person accepted;
    brute: the end of the person who goes on by hand, and mends what differs; anew: seconds of one who makes each wrong
    edit anew."""

    task: str
    condition: str
    seed: int
    setting: str
    assets: int
    possible: int
    reference: int
    settled: bool
    points: tuple[Point, ...]
    brute: Point
    anew: float

    @staticmethod
    def of_json(row: dict[str, Any]) -> Before:
        points = tuple(Point(*point) for point in row["points"])
        return Before(**{**row, "points": points, "brute": Point(*row["brute"])})


def teach_before(bench: Bench, condition: Condition, seed: int) -> Before:
    """A task taught without a queue, then finished by hand."""
    bench = name_by_files(bench)
    judge, points, programs = Judge(bench), list[Point](), list[Program | None]()

    def watch(program: Program | None) -> None:
        programs.append(program)
        points.append(Point(_count_seconds(course), judge.count_right(course.desk, program)))

    with open_course(bench, condition, seed, watch) as course:
        log = course.session(())
    program = programs[-1]
    right = judge.count_right(course.desk, program)
    settled = log.accepted and log.settled
    assets, possible = len(bench.samples), len(judge.possible)
    wrong = (possible - right) * settled
    points.append(Point(_count_seconds(course), right, assets * settled, wrong, assets * (not settled)))
    reference = judge.count_right(course.desk, bench.task.program)
    draw = random.Random(f"brute {seed} {bench.task.name}")
    seconds, anew, done = _mend_all(judge, course.desk, program, draw, condition.errs)
    brute = Point(round(points[-1].seconds + seconds, 2), done, assets, possible - done)
    family = (bench.task.name, condition.name, seed, log.setting)
    return Before(
        *family, assets, possible, reference, settled, tuple(points), brute, round(points[-1].seconds + anew, 2)
    )


def _count_seconds(course: Course) -> float:
    return round(sum(model_seconds(course.log).values()), 2)


def _mend_all(
    judge: Judge, desk: Desk, program: Program | None, draw: random.Random, errs: float
) -> tuple[float, float, int]:
    """Seconds of a person who glances at every asset and mends what differs where a result looks wrong; of one who
    makes the edit anew there; and assets that are right then."""
    seconds, anew, right = 0.0, 0.0, 0
    for name in judge.bench.samples:
        seconds, anew = seconds + GLANCE, anew + GLANCE
        output = run_on_desk(desk, program, name)
        as_seen = judge.looks_right(name, output) != (draw.random() < errs)
        wanted = judge.bench.truth.reference[name]
        if as_seen or wanted is None:
            right += judge.is_right(name, output)
            continue
        done = output.selections if output else None
        seconds += price_of_mend(None if done == wanted else done, wanted)
        anew += price_of_hand(wanted)
        right += name in judge.possible and not any(draw.random() < errs for _ in range(sum(map(len, wanted))))
    return seconds, anew, right


def teach(name: str, condition: str) -> list[dict[str, Any]]:
    """One task under one condition, by each person."""
    one = CONDITIONS[condition]
    return [asdict(teach_before(bench, one, seed)) for seed, bench in list_benches(name, one)]


def freeze(tell: Tell, path: Path = FROZEN) -> None:
    """Write the figures of the tool as it is, with the commit that it is at."""
    units = [(name, one.name) for name in list_tasks() for one in ASKED]
    units += [(name, one.name) for name in list_real_tasks() for one in ON_REAL]
    rows = [row for unit in run_units("before", teach, units, tell) for row in unit]
    commit = subprocess.run(["git", "rev-parse", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    lines = ",\n".join(json.dumps(row, separators=(",", ":")) for row in rows)
    head = f'"command": {json.dumps(_COMMAND)},\n"commit": {json.dumps(commit.strip())}'
    write_atomically(path, f'{{\n{head},\n"sessions": [\n{lines}\n]\n}}\n')


@cache
def read_before(path: Path = FROZEN) -> tuple[Before, ...]:
    """What `freeze` wrote."""
    return tuple(map(Before.of_json, json.loads(path.read_text("utf-8"))["sessions"]))
