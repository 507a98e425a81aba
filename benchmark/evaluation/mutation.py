"""The criteria tried on mutants: programs that are nearly the reference, and whether a criterion tells their edits."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from benchmark.assets.pictures import upright
from benchmark.evaluation.sessions import QUICK
from benchmark.journal import run_units
from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.tasks import task, tasks
from benchmark.tasks.mutants import judge_mutants, mutants
from meshforge.rendering import make_contact_sheet, render
from meshforge.rendering.comparison import joint_bounds

if TYPE_CHECKING:
    from PIL.Image import Image

MOST = 0.1
"""Of the meshes that a mutant edits otherwise than the reference, so many may pass at most."""
_WORST = 12
_SIZE = (170, 150)


def measure(tell: Tell, quick: bool) -> Result:
    """Judge the edits of all mutants of all tasks."""
    names = [one.name for one in tasks() if not quick or one.category == QUICK]
    found = dict(zip(names, run_units("mutation", judge_mutants, [(name,) for name in names], tell), strict=True))
    every = [{"task": name, **row} for name, rows in found.items() for row in rows]
    other = [row for row in every if row["differs"]]
    alike = [row for row in other if row["reason"]]
    passing = [row for row in other if not row["reason"] and share(row) > MOST]
    return Result(
        "mutation",
        "The criteria tried on mutants",
        (
            Table("Task by task", _COLUMNS, tuple(_row(name, rows) for name, rows in found.items())),
            Table("The worst mutants", ("task", "mutant", *_COUNTS), tuple(_worst(every))),
            Table("Mutants that do the same job", ("task", "mutant", *_COUNTS, "why"), tuple(_list_equivalents(alike))),
        ),
        (
            Goal("mutants that pass on more than a tenth of the meshes", "at most", 0.0, float(len(passing))),
            Goal("mutants that do the same job, %", "at most", 10.0, 100 * len(alike) / max(len(other), 1)),
        ),
        (
            "A mutant is the reference program with one rule dropped, with another action of it (`Delete`, `Merge`, "
            "`Replace(box)`, `Scale(all, 0.8)`, `Each` of these), or with one of three seeded extractors of the same "
            "size that select other hulls on a fifth of the calibration meshes or more; and `All => Delete`. "
            "*Differs*: meshes on which the mutant's edit has other shapes than the reference's. *Pass*: those of them "
            "whose edit meets the criterion all the same.",
        ),
        tuple(every),
    )


def share(row: Mapping[str, Any]) -> float:
    """Of the meshes that a mutant edits otherwise, the share that pass."""
    return float(len(row["pass"]) / max(row["differs"], 1))


_COUNTS = ("differs", "pass", "pass, %")
_COLUMNS = ("task", "mutants", "that differ", "do the same job", "pass on more than a tenth", "worst", "pass, %")


def _row(name: str, rows: Sequence[Mapping[str, Any]]) -> tuple[Cell, ...]:
    other = [row for row in rows if row["differs"] and not row["reason"]]
    worst = max(other, key=share)
    return (
        name,
        len(rows),
        sum(bool(row["differs"]) for row in rows),
        sum(bool(row["reason"]) for row in rows),
        sum(share(row) > MOST for row in other),
        f"`{worst['mutant']}`" if worst["pass"] else "–",
        100 * share(worst),
    )


def _worst(every: Sequence[Mapping[str, Any]]) -> Iterator[tuple[Cell, ...]]:
    rows = [row for row in every if row["pass"] and not row["reason"]]
    for row in sorted(rows, key=lambda row: (-share(row), row["task"], row["mutant"]))[:_WORST]:
        yield row["task"], f"`{row['mutant']}`", row["differs"], len(row["pass"]), 100 * share(row)


def _list_equivalents(alike: Sequence[Mapping[str, Any]]) -> Iterator[tuple[Cell, ...]]:
    for row in alike:
        yield row["task"], f"`{row['mutant']}`", row["differs"], len(row["pass"]), 100 * share(row), row["reason"]


def pictures(rows: Sequence[Mapping[str, Any]]) -> Iterator[tuple[str, Image]]:
    """Of each mutant that does the same job a caption, and a mesh before, by the reference and by the mutant."""
    for row in rows:
        if row["reason"] and row["pass"]:
            one = task(row["task"])
            (mutant,) = [found for found in mutants(one) if found.name == row["mutant"]]
            sample = next(sample for sample in one.samples() if sample.name == row["pass"][0])
            edits = [one.run(program, sample.mesh).mesh for program in (one.program, mutant.program)]
            meshes = [upright(sample), *(upright(sample, mesh) for mesh in edits if mesh)]
            box, words = joint_bounds(*meshes), one.program.labels
            images = [
                render(mesh, color_by="label", size=_SIZE, legend=False, bounds=box, vocabulary=words)
                for mesh in meshes
            ]
            told = f"{one.name}, {mutant.name}, {sample.name}"
            yield told, make_contact_sheet(images, 3, ["before", "by the reference", "by the mutant"])
