"""`meshforge apply` and `label` on very many assets: their rate, their memory, and what `apply` adds to the work."""

from __future__ import annotations

import json
import shutil
import tempfile
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from benchmark.batch.crowd import STOOLS, crowd, stools, tables
from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.speed.watch import watch_command
from meshforge.formats import labels_beside
from meshforge.project import Project
from meshforge.samples import TABLES
from meshforge.symbolic import read_labels

_WORKERS = 2
_STOOLS = (1_000, 10_000, 100_000)
_TABLES = (1_400, 7_000)
_LABELLED = (("names", 10_000), ("propagate", 1_000))
_QUICK = (20,), (14,)
_MIB, _GIB = 1 << 20, 1 << 30
_OVERHEAD, _FLAT = 0.05, 0.9


@dataclass(frozen=True, slots=True)
class Run:
    """One run. seconds: of the whole command; work: that workers spent on assets; main, worker: peaks [bytes]."""

    kind: str
    round: str
    assets: int
    seconds: float
    work: float
    main: int
    worker: int
    outcomes: dict[str, int]

    @property
    def rate(self) -> float:
        """Assets a second."""
        return self.assets / self.seconds

    @property
    def overhead(self) -> float:
        """What is not work on an asset, as a share of the work, if workers could have been at it all the time."""
        return (_WORKERS * self.seconds - self.work) / self.work if self.work else 0.0


def measure(tell: Tell, quick: bool) -> Result:
    """Run the command on crowds of both kinds, twice each: from nothing, and when all is there already."""
    runs: list[Run] = []
    with tempfile.TemporaryDirectory(dir=".") as name:
        folder = Path(name)
        (folder / "models").mkdir()
        program = folder / "stools.mf"
        program.write_text(STOOLS, "utf-8")
        few, some = _QUICK if quick else (_STOOLS, _TABLES)
        for count in few:
            runs += _runs("six boxes", stools(folder / "models"), program, count, folder, tell)
        for count in some:
            runs += _runs("bundled tables", tables(), TABLES / "tables.mf", count, folder, tell)
        labelled = [
            run
            for way, count in _LABELLED
            for run in _label(way, stools(folder / "models"), 20 if quick else count, folder, tell)
        ]
    return Result(
        "many",
        "A thousand assets, and a hundred thousand",
        (
            Table(f"`meshforge apply`, {_WORKERS} workers", _COLUMNS, tuple(map(_row, runs))),
            Table(f"`meshforge label`, six boxes, {_WORKERS} workers", _COLUMNS, tuple(map(_row, labelled))),
        ),
        () if quick else _goals(runs),
        _NOTES,
        tuple(asdict(run) for run in (*runs, *labelled)),
    )


def _runs(kind: str, models: Sequence[Path], program: Path, count: int, folder: Path, tell: Tell) -> list[Run]:
    assets, out = folder / "assets", folder / "out"
    tell(f"{kind}: writing {count:,}")
    crowd(models, count, assets)
    found = []
    for part in ("from nothing", "again"):
        tell(f"{kind}, {count:,} {part}")
        seen = watch_command(
            ["apply", str(program), str(assets), "--out", str(out), "--workers", str(_WORKERS), "--json"]
        )
        outcomes: dict[str, int] = {}
        work = 0.0
        for line in seen.output.splitlines():
            row = json.loads(line)
            outcomes[row["status"]] = outcomes.get(row["status"], 0) + 1
            work += row["seconds"]
        found.append(Run(kind, part, count, seen.seconds, work, seen.main, seen.worker, outcomes))
    shutil.rmtree(assets)
    shutil.rmtree(out)
    return found


def _label(way: str, models: Sequence[Path], count: int, folder: Path, tell: Tell) -> list[Run]:
    """`label` in one way, on a project in which two assets are labelled, and again."""
    assets, place = folder / "assets", folder / "project"
    tell(f"labels by {way}: writing {count:,}")
    crowd(models, count, assets)
    project = Project.create(place, [assets], vocabulary=("panel", "leg", "misc"))
    for asset in project.assets()[:2]:
        true = read_labels(labels_beside(assets / asset)).labels
        project.set_labels(asset, {name: label.name for name, label in true.items()})
    found = []
    for part in ("from nothing", "again"):
        tell(f"labels by {way}, {count:,} {part}")
        seen = watch_command(["label", str(place), "--with", way, "--workers", str(_WORKERS), "--json"])
        rows = [json.loads(line) for line in seen.output.splitlines()]
        taken = sum(row.get("taken", 0) for row in rows)
        found.append(Run(way, part, count, seen.seconds, 0.0, seen.main, seen.worker, {"labels taken": taken}))
    shutil.rmtree(assets)
    shutil.rmtree(place)
    return found


_COLUMNS = ("", "", "assets", "s", "assets a second", "added to the work, %", "MiB, main", "MiB, largest worker", "")
_NOTES = (
    "Assets are variants of another size each of two stools of six boxes, or of the 14 bundled tables (26 to 66 "
    "hulls), each variant there 50 times as hard links. The command starts from nothing, then again with all outputs "
    "there.",
    "*Added to the work*: the time that the workers could have worked and did not (start of Python, finding the "
    "assets, putting outputs in place, waiting for the disk), as a share of what they worked. Memory: largest "
    "resident size.",
    "`label` works on a project of the six boxes in which two assets were labelled by hand; in the end it draws a "
    "sheet of some of them.",
)


def _row(run: Run) -> tuple[Cell, ...]:
    told = ", ".join(f"{count:,} {status}" for status, count in sorted(run.outcomes.items()))
    added = 100 * run.overhead if run.work else "–"
    return run.kind, run.round, run.assets, run.seconds, run.rate, added, run.main / _MIB, run.worker / _MIB, told


def _goals(runs: Sequence[Run]) -> tuple[Goal, ...]:
    fresh = [run for run in runs if run.round == "from nothing"]
    stool, table = ([run for run in fresh if run.kind == kind] for kind in ("six boxes", "bundled tables"))
    flat = stool[-1].rate / stool[0].rate
    peak = max(max(run.main, run.worker) for run in runs)
    return (
        Goal("peak memory of any process, MiB", "at most", _GIB / _MIB, peak / _MIB),
        Goal("added to the work, bundled tables, %", "at most", 100 * _OVERHEAD, 100 * table[-1].overhead),
        Goal(f"rate at {stool[-1].assets:,}, of that at {stool[0].assets:,}", "at least", _FLAT, flat),
    )
