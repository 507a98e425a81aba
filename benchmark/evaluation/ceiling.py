"""The tasks themselves, before anything is learned: that each criterion refuses unedited meshes and wrong edits, and
that the reference program on true labels meets it; the latter also where an asset was decomposed as a whole."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any

from benchmark.assets import MERGED, SETS
from benchmark.evaluation.purity import count_impure, tell_different, tell_purity
from benchmark.evaluation.sessions import QUICK
from benchmark.journal import run_units
from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.tasks import DIFFICULTIES, EditResult, task, tasks

_COLUMNS = (
    "task",
    "meshes",
    "unedited: fail, %",
    "of assets, %",
    "wrong edit: fail, %",
    "pure meshes, %",
    "reference: pass, pure, %",
    "the others, %",
    "all, %",
)


_BY_SET = (
    "set",
    "tasks",
    "meshes",
    "pure meshes, %",
    "reference: pass, pure, %",
    "the others, %",
    "all, %",
)
Found = dict[str, list[dict[str, Any]]]
"""What was found on the meshes of each task."""


def measure(tell: Tell, quick: bool) -> Result:
    """Judge all separate meshes of all tasks three times, the merged ones once."""
    names = [one.name for one in tasks() if not quick or one.category == QUICK]
    categories = list(dict.fromkeys(task(name).category for name in names))
    units = [(name, group) for group in SETS for name in names]
    judged = dict(zip(units, run_units("ceiling", judge_meshes, units, tell), strict=True))
    sets: dict[str, Found] = {group: {name: judged[name, group] for name in names} for group in SETS}
    found = sets["separate"]
    pure = [row for rows in found.values() for row in rows if not row["impure"]]
    passed = 100 * sum(row["reference"] is None for row in pure) / max(len(pure), 1)
    least = min((_share(rows, "unedited", by_asset=True) for rows in found.values()), default=0.0)
    wrong = min((_share(rows, "wrong") for rows in found.values()), default=0.0)
    return Result(
        "ceiling",
        "The tasks and their criteria",
        (
            Table("Each criterion tested both ways", _COLUMNS, tuple(_row(name, rows) for name, rows in found.items())),
            Table(
                "What fails under the reference program", ("task", "mesh", "pure", "why"), tuple(_list_failures(found))
            ),
            tell_different(categories),
            tell_purity(categories),
            Table("The reference on true labels, set by set", _BY_SET, tuple(_compare_sets(sets))),
        ),
        (
            Goal("reference on true labels, pure meshes: pass, %", "at least", 99.0, passed),
            Goal("unedited assets that fail, %, least of all tasks", "at least", 50.0, least),
            Goal("wrong edits that fail, %, least of all tasks", "at least", 50.0, wrong),
            *(
                Goal(f"{group}: hulls that span parts, %", "at least", 20.0, count_impure(categories, group).share)
                for group in MERGED
            ),
        ),
        (
            "*Pure*: no hull that the rules are about belongs to several parts (purity at least 0.9). An asset "
            "counts as failing unedited if at least one of its three meshes fails; the other column counts meshes.",
            "*Separate*: each connected solid of an asset decomposed by itself, coarse, medium and fine; the first two "
            "tables and the goals that name no set are about these. *Union*: one call of CoACD on all of an asset. "
            "*Welded*: likewise, its joints welded shut before. A hull spans parts if its purity is below 0.9. The "
            "thresholds were chosen on the calibration set, category by category.",
            "*kettle-easy*: its wrong program, `Replace(cylinder)`, was wrong on every mesh until a cylinder came to "
            "lie along the axis where it encloses least; that is right for half of the lids. The tasks are frozen, so "
            "it stays as it is.",
        ),
        tuple(
            {"task": name, "set": group, **row}
            for group, by_task in sets.items()
            for name, rows in by_task.items()
            for row in rows
        ),
    )


def judge_meshes(name: str, group: str) -> list[dict[str, Any]]:
    """Every mesh of a task in a set: why it fails by the reference; None: it does not.

    Of separate meshes also why they fail unedited, and by the wrong program.
    """
    one = task(name)
    rows = []
    for sample in one.samples(settings=SETS[group]):
        edits = {"reference": one.run(one.program, sample.mesh)}
        if group == "separate":
            edits |= {"unedited": EditResult(sample.mesh), "wrong": one.run(one.wrong, sample.mesh)}
        why = {about: one.failure(sample, edited) for about, edited in edits.items()}
        rows.append({"mesh": sample.name, "asset": sample.asset.name, "impure": len(one.impure(sample)), **why})
    return rows


def _share(rows: Sequence[dict[str, Any]], about: str, by_asset: bool = False) -> float:
    """The share of meshes, or of assets with at least one mesh, that fail, %."""
    failing = {row["asset" if by_asset else "mesh"] for row in rows if row[about] is not None}
    return 100 * len(failing) / max(len({row["asset" if by_asset else "mesh"] for row in rows}), 1)


def _row(name: str, rows: Sequence[dict[str, Any]]) -> tuple[Cell, ...]:
    failing = (_share(rows, "unedited"), _share(rows, "unedited", by_asset=True), _share(rows, "wrong"))
    return (name, len(rows), *failing, *_compare_purities(rows))


def _compare_sets(sets: dict[str, Found]) -> Iterator[tuple[Cell, ...]]:
    """How the reference fares in each set, by difficulty."""
    for group, found in sets.items():
        for difficulty in (*DIFFICULTIES, "all"):
            names = [name for name in found if difficulty in ("all", task(name).difficulty)]
            rows = [{**row, "mesh": f"{name} {row['mesh']}"} for name in names for row in found[name]]
            yield group, difficulty, len(rows), *_compare_purities(rows)


def _compare_purities(rows: Sequence[dict[str, Any]]) -> tuple[Cell, ...]:
    """The share of pure meshes; how many of these, of the others and of all the reference mends, %."""
    pure, mixed = [row for row in rows if not row["impure"]], [row for row in rows if row["impure"]]
    return (
        100 * len(pure) / max(len(rows), 1),
        *(100 - _share(part, "reference") if part else "–" for part in (pure, mixed, rows)),
    )


def _list_failures(found: dict[str, list[dict[str, Any]]]) -> Iterator[tuple[Cell, ...]]:
    """Meshes that the reference does not mend; of impure ones only how many, by what fails."""
    for name, rows in found.items():
        for row in rows:
            if row["reference"] is not None and not row["impure"]:
                yield name, row["mesh"], "yes", row["reference"]
        mixed = Counter(row["reference"].split(":")[0] for row in rows if row["reference"] and row["impure"])
        for kind, count in sorted(mixed.items()):
            yield name, f"{count} meshes", "no", kind
