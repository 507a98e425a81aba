"""The orientation withheld: tasks that need one are taught without it, and the tool has to find that out."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache
from time import process_time
from typing import Any

from benchmark.assets import SEPARATE
from benchmark.assets.pictures import upright
from benchmark.journal import run_units
from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.study import REPORTED, TRUE, Bench, Desk, open_bench
from benchmark.study.person import Person
from benchmark.tasks import tasks
from meshforge.common import MeshForgeError
from meshforge.language import Is, Orient, select_mask, show
from meshforge.synthesis import Answer, LearningOutcome, Options, synthesize

COUNTS = (1, 2, 3)
"""Demonstrations of a lesson."""
_QUICK = ("chair-medium", "chair-easy")
SEEDS = len(REPORTED)
_MOST_ANSWERS = 8


def measure(tell: Tell, quick: bool) -> Result:
    """Lessons on every task: with its orientation, and without it."""
    names = _QUICK if quick else tuple(one.name for one in tasks())
    units = [
        (name, seed, count)
        for name in names
        for seed in (REPORTED if needs_orientation(name) else REPORTED[: len(SEPARATE)])
        for count in COUNTS
    ]
    rows = run_units("orientation", teach_three_ways, units, tell)
    withheld = [row for row in rows if row["needs"]]
    able = [row for row in withheld if row["given"]["right"]]
    return Result(
        "orientation",
        "Orientation withheld",
        (_withheld_table(withheld), _needless_table(rows)),
        (
            Goal("lessons right, or made right by a suggestion", "at least", 0.9, _share(withheld, _is_right)),
            Goal("… of those that the reference's orientation makes right", "at least", 0.9, _share(able, _is_right)),
        ),
        (
            f"A lesson: {COUNTS[0]} to {COUNTS[-1]} demonstrations on a family at one decomposition, true labels, the "
            "first on a mesh that shows most of what is meant, the rest at random; the tool's questions are answered. "
            "Right: on all other meshes every rule selects what the reference selects.",
            f"Needed on the {len({row['task'] for row in withheld})} tasks whose reference selects something else "
            "without its orientation on some mesh. A suggested orientation is taken, and learning goes on in its "
            "frame.",
            "*With the reference's orientation*: the same lessons with it; what is wrong there has other reasons. "
            "*Frame right*: the reference's rules select the same in the frame that was learned in.",
            "Lessons on tasks that need none, and on assets that stand upright, are three of the five seeds, one for "
            "each decomposition. *Needless*: something was suggested where the program without it is right. *Harmful*: "
            "with it, it is not.",
        ),
        tuple(rows),
    )


def _share(rows: Sequence[dict[str, Any]], test: Callable[[dict[str, Any]], bool]) -> float:
    return sum(map(test, rows)) / len(rows) if rows else 0.0


def _is_right(row: dict[str, Any]) -> bool:
    return bool(row["withheld"]["right"])


def _withheld_table(rows: Sequence[dict[str, Any]]) -> Table:
    lines: list[tuple[Cell, ...]] = []
    for count in COUNTS:
        mine = [row for row in rows if row["count"] == count]
        plain = sum(not row["withheld"]["suggested"] and row["withheld"]["right"] for row in mine)
        lines.append(
            (
                count,
                len(mine),
                plain,
                sum(bool(row["withheld"]["suggested"]) for row in mine),
                sum(map(_is_right, mine)),
                sum(row["given"]["right"] for row in mine),
                sum(row["given"]["right"] and _is_right(row) for row in mine),
                sum(row["withheld"]["frame"] for row in mine),
            )
        )
    columns = ("k", "lessons", "right as learned", "suggested", "right, suggestions taken",
               "right with the reference's orientation", "right both ways", "frame right")  # fmt: skip
    return Table("Withheld, lessons", columns, tuple(lines))


def _needless_table(rows: Sequence[dict[str, Any]]) -> Table:
    lines: list[tuple[Cell, ...]] = []
    groups: tuple[tuple[str, list[dict[str, Any]]], ...] = (
        ("withheld where it is needed", [row["withheld"] for row in rows if row["needs"]]),
        ("withheld where it is not needed", [row["withheld"] for row in rows if not row["needs"]]),
        ("as the task has it", [row["given"] for row in rows]),
        ("withheld, all assets upright and the same way round", [row["upright"] for row in rows if row["upright"]]),
    )
    for what, mine in groups:
        right = [row for row in mine if row["plain_right"]]
        needless = [row for row in right if row["suggested"]]
        lines.append((what, len(mine), len(right), len(needless), sum(not row["taken_right"] for row in needless)))
    columns = ("", "lessons", "right without a suggestion taken", "of these needless", "of these harmful")
    return Table("Suggestions where nothing was wrong", columns, tuple(lines))


def teach_three_ways(name: str, seed: int, count: int, calibration: bool = False) -> dict[str, Any]:
    """One lesson with the task's own orientation, without it, and without it on assets that all stand upright."""
    bench = open_bench(name, SEPARATE[seed % len(SEPARATE)], calibration)
    shown = _draw_shown(bench.truth, seed)[:count]
    lesson = Lesson(bench.truth, seed, shown)
    return {
        "task": name,
        "seed": seed,
        "count": count,
        "needs": needs_orientation(name, calibration),
        "given": lesson.teach(bench.task.program.orient, take=False),
        "withheld": lesson.teach(None, take=True),
        "upright": _teach_upright(bench, seed, shown) if seed % SEEDS < len(SEPARATE) else None,
    }


def _teach_upright(bench: Bench, seed: int, shown: Sequence[str]) -> dict[str, Any]:
    """The lesson without orientation, each asset of the family turned to the frame that its generator made it in."""
    standing = Bench(bench.task, [replace(one, mesh=upright(one)) for one in bench.samples.values()])
    return Lesson(standing.truth, seed, shown).teach(None, take=True)


@cache
def needs_orientation(name: str, calibration: bool = False) -> bool:
    """Whether the reference selects something else without its orientation on some mesh."""
    for setting in SEPARATE:
        desk = open_bench(name, setting, calibration).truth
        able = [mesh for mesh, done in desk.reference.items() if done is not None]
        if desk.find_differences(replace(desk.bench.task.program, orient=None), able):
            return True
    return False


def _draw_shown(desk: Desk, seed: int) -> list[str]:
    """All meshes that can be demonstrated, in any order but for the first, which shows most of what is meant."""
    able = sorted(mesh for mesh, done in desk.reference.items() if done is not None)
    order = random.Random(f"{seed} {desk.bench.task.name} orientation").sample(able, len(able))
    first = max(order, key=lambda mesh: _count_shown_rules(desk, mesh))
    return [first, *(mesh for mesh in order if mesh != first)]


def _count_shown_rules(desk: Desk, name: str) -> int:
    """How many rules select something on a mesh that no label alone does, unless they are no more than a label."""
    count = 0
    for place, rule in enumerate(desk.bench.task.program.rules):
        mesh = desk.mesh_before(name, place)
        chosen = select_mask(rule.extractor, mesh)
        plain = {select_mask(Is(label), mesh) for label in desk.bench.task.program.labels}
        count += bool(chosen) and (isinstance(rule.extractor, Is) or chosen not in plain)
    return count


class Lesson:
    """Some meshes, demonstrated by a person who then answers what is asked."""

    def __init__(self, desk: Desk, seed: int, shown: Sequence[str]) -> None:
        self._desk, self._seed = desk, seed
        self._demos = [Person(desk, seed, TRUE).shows(desk, mesh) for mesh in shown]
        self._rest = [mesh for mesh, done in desk.reference.items() if done is not None and mesh not in shown]

    def teach(self, orient: Orient | None, take: bool) -> dict[str, Any]:
        """What comes of it in a frame. take: whether what is suggested is taken, for what counts in the end."""
        plain, suggested, answers = self._learn(orient)
        done: dict[str, Any] = {
            "program": str(plain.program) if plain and plain.program else None,
            "plain_right": self._is_right(plain),
            "suggested": show(suggested) if suggested else None,
            "answers": answers,
        }
        taken = self._learn(suggested)[0] if suggested else plain
        done["taken_program"] = str(taken.program) if suggested and taken and taken.program else None
        done["taken_right"] = self._is_right(taken)
        done["right"] = done["taken_right"] if take else done["plain_right"]
        done["frame"] = self._is_frame_right(suggested if take and suggested else orient)
        return done

    def _learn(self, orient: Orient | None) -> tuple[LearningOutcome | None, Orient | None, int]:
        """The outcome once nothing is asked, the first orientation that was suggested on the way, and the answers."""
        person, answers, suggested = Person(self._desk, self._seed, TRUE), list[Answer](), None
        while True:
            outcome = self._synthesize(orient, answers)
            if outcome and outcome.suggested and not suggested:
                suggested = outcome.suggested.orient
            if not outcome or not outcome.open_rule or not outcome.program or len(answers) == _MOST_ANSWERS:
                return outcome, suggested, len(answers)
            answers.append(person.answers(self._desk, outcome.open_rule, outcome.program))

    def _synthesize(self, orient: Orient | None, answers: Sequence[Answer]) -> LearningOutcome | None:
        """None where it cannot be done; proposals to correct labels are refused, as all are right."""
        one = self._desk.bench.task
        options = Options(
            contact=one.program.contact,
            extremity=one.program.extremity,
            clock=process_time,  # the budget ends no search because the machine has other work
        )
        try:
            return synthesize(
                self._demos, self._desk.meshes, orient, one.templates, one.program.labels, options,
                lambda repair: False, answers,
            )  # fmt: skip
        except MeshForgeError:
            return None

    def _is_right(self, outcome: LearningOutcome | None) -> bool:
        return outcome is not None and not self._desk.find_differences(outcome.program, self._rest)

    def _is_frame_right(self, orient: Orient | None) -> bool:
        """Whether the reference's rules do the same in a frame as in that of the reference."""
        return not self._desk.find_differences(replace(self._desk.bench.task.program, orient=orient), self._rest)
