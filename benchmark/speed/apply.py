"""Running a program over whole families: assets a second, and the memory of each process, from outside."""

from __future__ import annotations

import json
import shutil
import statistics
import tempfile
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from benchmark.report import Cell, Result, Table, Tell
from benchmark.speed.assets import corpus
from benchmark.speed.watch import Usage, watch_command
from meshforge.batch.discovery import common_folder
from meshforge.common import MeshForgeError
from meshforge.formats import load
from meshforge.samples import TABLES

_PROGRAM = """\
labels low, middle, high

Is(low)                              => Each(Merge)
Attach(Is(middle), Is(low))          => Each(Replace(box))
Diff(Is(high), Geo(Is(high), +Z))    => Each(Merge)
"""
_WORKERS = (1, 2)
_ROUNDS = 3


@dataclass(frozen=True, slots=True)
class Family:
    """Folders below the corpus, the assets in them, and how many times each is taken."""

    name: str
    folders: tuple[str, ...]
    pattern: str
    copies: int


_FAMILIES = (
    Family(
        "URDF, pybullet-URDF-models",
        tuple(f"{kind}/pybullet-URDF-models" for kind in ("cups_mugs", "soap_bottles", "kettles_teapots")),
        "*/model.urdf",
        4,
    ),
    Family(
        "MJCF, clvrai-furniture",
        ("tables_desks/clvrai-furniture", "doors_cabinets/clvrai-furniture"),
        "objects/*.xml",
        2,
    ),
    Family("MJCF, furniture_sim kettles", ("kettles_teapots/furniture_sim",), "kettle.xml", 8),
)


def measure(tell: Tell, quick: bool) -> Result:
    """Run `meshforge apply` on each family."""
    rows: list[dict[str, object]] = []
    with tempfile.TemporaryDirectory() as name:
        for number, (family, assets) in enumerate(_quick(Path(name)) if quick else _gather(Path(name))):
            folder = Path(name) / f"run{number}"
            folder.mkdir()
            _label(assets, folder / "labels")
            for workers in (1,) if quick else _WORKERS:
                tell(f"apply: {family}, {workers} workers")
                runs = [_run(assets, folder, workers) for _ in range(1 if quick else _ROUNDS)]
                rows.append(_row(family, workers, runs, name))
    return Result(
        "apply",
        "Running a program over a family",
        (
            Table(
                "`meshforge apply`, the whole command",
                ("", "workers", "assets", "s", "assets a second", "MB, main", "MB, largest worker", "outcomes"),
                tuple(_line(row) for row in rows),
            ),
        ),
        (),
        (
            "Median of three runs from nothing, start of Python included; memory: largest resident size of a process.",
            "Hulls are labelled by the third of the asset's height that their middle is in, for want of labels:",
            *(f"`{line}`" for line in _PROGRAM.splitlines() if line),
            "Small families are taken several times, as so many assets of their own.",
        ),
        tuple(rows),
    )


def _quick(folder: Path) -> list[tuple[str, list[Path]]]:
    place = folder / "tables"
    place.mkdir()
    return [("OBJ, bundled tables", [Path(shutil.copy(p, place)) for p in sorted(TABLES.glob("*.obj"))[:2]])]


def _gather(folder: Path) -> list[tuple[str, list[Path]]]:
    """The families that are here, copied into a folder of their own."""
    root = corpus()
    found = []
    for number, family in enumerate(_FAMILIES if root else ()):
        assert root is not None
        assets: list[Path] = []
        for copy in range(family.copies):
            for source in family.folders:
                place = folder / f"family{number}" / f"copy{copy}" / source
                if (root / source).is_dir():
                    shutil.copytree(root / source, place)
                    assets += sorted(place.glob(family.pattern))
        if assets:
            found.append((family.name, assets))
    return found


def _label(assets: list[Path], labels: Path) -> None:
    """Write a labels file for each asset that can be read, in a folder that mirrors theirs."""
    base = common_folder(assets)
    for asset in assets:
        try:
            mesh = load(asset)
        except MeshForgeError:
            continue
        if mesh.aabb is None:
            continue
        low, size = mesh.aabb.min[2], max(mesh.aabb.size[2], 1e-12)
        thirds = {h.name: min(int(3 * (h.aabb.center[2] - low) / size), 2) for h in mesh.hulls}
        named = {name: ("low", "middle", "high")[third] for name, third in thirds.items()}
        target = labels / asset.relative_to(base)
        target = target.with_name(f"{target.name}.json")
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(json.dumps({"hulls": named}), "utf-8")


def _run(assets: list[Path], folder: Path, workers: int) -> Usage:
    program, out = folder / "program.mf", folder / "out"
    program.write_text(_PROGRAM, "utf-8")
    shutil.rmtree(out, ignore_errors=True)
    paths = [str(asset) for asset in assets]
    options = ["--out", str(out), "--labels", str(folder / "labels"), "--workers", str(workers), "--again", "--json"]
    return watch_command(["apply", str(program), *paths, *options])


def _row(family: str, workers: int, runs: list[Usage], base: str) -> dict[str, object]:
    outcomes = [json.loads(line) for line in runs[0].output.splitlines() if line.startswith("{")]
    return {
        "family": family,
        "workers": workers,
        "assets": len(outcomes),
        "seconds": statistics.median(run.seconds for run in runs),
        "main": max(run.main for run in runs),
        "worker": max(run.worker for run in runs),
        "outcomes": dict(sorted(Counter(outcome["status"] for outcome in outcomes).items())),
        "errors": [str(outcome["error"]).replace(base, "") for outcome in outcomes if outcome.get("error")],
        "work": sum(float(outcome.get("seconds") or 0.0) for outcome in outcomes),
    }


def _line(row: dict[str, object]) -> tuple[Cell, ...]:
    outcomes, assets, seconds = row["outcomes"], row["assets"], row["seconds"]
    assert isinstance(outcomes, dict) and isinstance(assets, int) and isinstance(seconds, float)
    told = ", ".join(f"{count} {status}" for status, count in outcomes.items())
    main, worker = (float(str(row[who])) / 2**20 for who in ("main", "worker"))
    return str(row["family"]), str(row["workers"]), assets, seconds, assets / seconds, main, worker, told
