"""Start without names: how many results are right where a person shows the steps on one to three assets and names no
part, before any question; beside the same with all hulls of these assets named, and the rules that the task has."""

from __future__ import annotations

import random
from collections.abc import Sequence
from typing import Any

from benchmark.assets import SEPARATE
from benchmark.journal import run_units
from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.study.condition import REPORTED, TRUE
from benchmark.study.desk import Bench, open_bench
from benchmark.study.person import Person
from benchmark.study.project import name_by_files, open_project
from benchmark.tasks import tasks
from meshforge.batch import IN_PROCESS
from meshforge.common import MeshForgeError
from meshforge.language import Program
from meshforge.project import Project

COUNTS = (1, 3)
TO_REACH = {1: 0.55, 3: 0.75}
_PEOPLE = REPORTED[: len(SEPARATE)]


def measure(tell: Tell, quick: bool) -> Result:
    """Show the steps of the tasks of medium difficulty on a few assets of each family."""
    names = [one.name for one in tasks() if one.difficulty == "medium"][: 1 if quick else None]
    units = [(name, seed, count) for name in names for seed in _PEOPLE[: 1 if quick else None] for count in COUNTS]
    rows = list(run_units("transfer", show_steps, units, tell))
    shares = {count: [row for row in rows if row["shown"] == count] for count in COUNTS}
    lines: list[tuple[Cell, ...]] = []
    for name in names:
        mine = [[row for row in shares[count] if row["task"] == name] for count in COUNTS]
        lines.append((name, *(_mean(some, what) for some in mine for what in ("unnamed", "named"))))
    lines.append(("all", *(_mean(shares[count], what) for count in COUNTS for what in ("unnamed", "named"))))
    columns = ("task", *(f"{count} shown: {what}" for count in COUNTS for what in ("without names", "named")))
    goals = [
        Goal(
            f"exact results on the other assets after {k}, without names",
            "at least",
            least,
            _mean(shares[k], "unnamed"),
        )
        for k, least in TO_REACH.items()
    ]
    table = Table("Exact results", columns, tuple(lines))
    return Result("transfer", "Start without names", (table,), tuple(goals), _NOTES, tuple(rows))


def show_steps(name: str, seed: int, count: int) -> dict[str, Any]:
    """The share of the other assets on which each rule selects what it should, without names and with them."""
    bench = name_by_files(open_bench(name, SEPARATE[seed % len(SEPARATE)]))
    shown = _choose_shown(bench, seed, count)
    others = [asset for asset, wanted in bench.truth.reference.items() if wanted is not None and asset not in shown]
    return {
        "task": name,
        "seed": seed,
        "shown": count,
        "unnamed": _share_right(bench, seed, shown, others, unnamed=True),
        "named": _share_right(bench, seed, shown, others, unnamed=False),
    }


def _choose_shown(bench: Bench, seed: int, count: int) -> list[str]:
    """Assets on which most rules have something to do, drawn at random."""
    busy = {asset: sum(map(bool, wanted)) for asset, wanted in bench.truth.reference.items() if wanted is not None}
    draw = random.Random(f"{seed} {bench.task.name}")
    order = draw.sample(list(busy), len(busy))
    return sorted(order, key=lambda asset: -busy[asset])[:count]


def _share_right(bench: Bench, seed: int, shown: Sequence[str], others: Sequence[str], *, unnamed: bool) -> float:
    desk, person = bench.desk("propagated", seed), Person(bench.truth, seed, TRUE)
    with open_project(desk, unnamed=unnamed) as project:
        if not unnamed:
            for asset in shown:
                project.set_labels(asset, {hull.name: hull.label for hull in bench.truth.meshes[asset].hulls})
            project.label("propagate", execution=IN_PROCESS)
            project.accept(bench.task.program)
            program: Program | None = bench.task.program
        else:
            for asset in shown:
                project.demonstrate(asset, person.shows(desk, asset).steps)
            program = project.synthesize().program
        right = [_selects_right(bench, project, asset, program) for asset in others]
    return sum(right) / max(len(right), 1)


def _selects_right(bench: Bench, project: Project, asset: str, program: Program | None) -> bool:
    if program is None:
        return False
    try:
        done = program.run(project.mesh(asset), project.templates(program.templates))
    except MeshForgeError:
        return False
    return tuple(frozenset(line.selected) for line in done.trace) == bench.truth.reference[asset]


def _mean(rows: Sequence[dict[str, Any]], what: str) -> float:
    return float(sum(row[what] for row in rows)) / len(rows)


_NOTES = (
    "The eight tasks of medium difficulty, families of 25 different assets, one for each decomposition. A result is "
    "*exact* if each rule selects the hulls that the reference selects under true labels.",
    "*Without names*: the project has no vocabulary, no label and no orientation; the steps are shown on assets on "
    "which most rules have something to do, drawn at random; then the program is learned, and nothing is asked.",
    "*Named*: all hulls of the same assets are labelled by hand, the labels propagated, and the reference program is "
    "a gift, with its orientation.",
    "It would fail where what a step takes does not look alike: a shelf that looks like a seat and stays.",
)
