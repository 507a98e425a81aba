"""The tasks themselves, before anything is learned: that each criterion refuses unedited meshes and wrong edits, and
that the reference program on true labels meets it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any

from benchmark.evaluation.sessions import QUICK
from benchmark.journal import run_units
from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.tasks import EditResult, task, tasks

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


def measure(tell: Tell, quick: bool) -> Result:
    """Judge all meshes of all tasks three times."""
    names = [one.name for one in tasks() if not quick or one.category == QUICK]
    found = dict(zip(names, run_units("ceiling", judge_meshes, [(name,) for name in names], tell), strict=True))
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
        ),
        (
            Goal("reference on true labels, pure meshes: pass, %", "at least", 99.0, passed),
            Goal("unedited assets that fail, %, least of all tasks", "at least", 50.0, least),
            Goal("wrong edits that fail, %, least of all tasks", "at least", 50.0, wrong),
        ),
        (
            "*Pure*: no hull that the rules are about belongs to several parts (purity at least 0.9). An asset "
            "counts as failing unedited if at least one of its three meshes fails; the other column counts meshes.",
        ),
        tuple({"task": name, **row} for name, rows in found.items() for row in rows),
    )


def judge_meshes(name: str) -> list[dict[str, Any]]:
    """Every mesh of a task: why it fails unedited, by the reference and by the wrong program; None: it does not."""
    one = task(name)
    rows = []
    for sample in one.samples():
        edits = {
            "unedited": EditResult(sample.mesh),
            "reference": one.run(one.program, sample.mesh),
            "wrong": one.run(one.wrong, sample.mesh),
        }
        why = {about: one.failure(sample, edited) for about, edited in edits.items()}
        rows.append({"mesh": sample.name, "asset": sample.asset.name, "impure": len(one.impure(sample)), **why})
    return rows


def _share(rows: Sequence[dict[str, Any]], about: str, by_asset: bool = False) -> float:
    """The share of meshes, or of assets with at least one mesh, that fail, %."""
    failing = {row["asset" if by_asset else "mesh"] for row in rows if row[about] is not None}
    return 100 * len(failing) / max(len({row["asset" if by_asset else "mesh"] for row in rows}), 1)


def _row(name: str, rows: Sequence[dict[str, Any]]) -> tuple[Cell, ...]:
    pure, mixed = [row for row in rows if not row["impure"]], [row for row in rows if row["impure"]]
    return (
        name,
        len(rows),
        _share(rows, "unedited"),
        _share(rows, "unedited", by_asset=True),
        _share(rows, "wrong"),
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
