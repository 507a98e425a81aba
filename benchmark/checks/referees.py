"""Second opinions on what the walk-throughs write: simcheck on all sample families, and on the same as USD SimReady."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from pxr import Usd, UsdGeom, UsdPhysics

from benchmark.journal import ROOT, run_units
from benchmark.report import Cell, Goal, Result, Table, Tell
from meshforge.common import MeshForgeError
from meshforge.formats import labels_beside
from meshforge.samples import FAMILIES, TABLES, family_of, write_family

_PRINTED = ("bottles", "cups", "chairs")  # whose programs the README prints, in that order
_LABELS = ("FET_011_STANDARD", "FET_011_RTX", "FET_046_STANDARD")
_WORDS = re.compile(r"^\S+ [\d.]+, (?:[\w-]+: )?([\w.]+)")
Row = dict[str, Any]


def measure(tell: Tell, quick: bool) -> Result:
    """Ask both of what every family becomes."""
    units = [(family.name, 2 if quick else 1000) for family in FAMILIES]
    rows = [row for found in run_units("referees", try_family, units, tell) for row in found]
    errors = sum(row["errors"] for row in rows)
    untried = sum(not row["simcheck"] or not row["after"] for row in rows)
    passed = sum(row["purposes"] and all(row["after"].get(name) == "passed" for name in _LABELS) for row in rows)
    return Result(
        "referees",
        "Second opinions",
        (
            Table("simcheck", ("family", "assets", "errors", "warnings"), tuple(_count_families(rows))),
            Table("SimReady Robotics-Prop, assets that pass", _COLUMNS, tuple(_count_features(rows))),
            Table("SimReady, requirements that are not met", ("requirement", "assets"), tuple(_count_unmet(rows))),
        ),
        (
            Goal("simcheck on what walk-throughs write: all families, errors", "at most", 0, errors),
            Goal(
                "SimReady Robotics-Prop: labels and purposes pass, % of assets",
                "at least",
                100,
                100 * passed / len(rows),
            ),
            Goal("assets of which one of the two said nothing", "at most", 0, untried),
        ),
        (
            "Every sample family by the program that its walk-through learns, each asset in its own format; GLB and "
            "glTF are given to simcheck as MJCF. For SimReady the same is written as USD; *before*: without labels.",
            "*Purposes*: SimReady looks at those of invisible colliders only, so they are counted here: each collider "
            "`guide` where something else is shown, all that is shown `default` or `render`.",
        ),
        tuple(rows),
    )


_COLUMNS = ("feature", "before", "after", "of")


def try_family(family: str, most: int) -> list[Row]:
    """What both say of each asset of a family."""
    with TemporaryDirectory() as name:
        folder = Path(name)
        written = _write_outputs(family, folder)[:most]
        found = _check(folder, written, "simcheck")
        stages = [_convert(folder, path, "after") for path in written]
        for path in written:
            labels_beside(path).unlink()
        bare = [_convert(folder, path, "before") for path in written]
        after, before = (_check(folder, paths, "simready") for paths in (stages, bare))
        return [
            {"family": family, "asset": str(path.relative_to(folder / "edited"))}
            | _describe_simcheck(one)
            | {"before": _list_features(was), "after": _list_features(now), "purposes": has_purposes(stage)}
            | {"unmet": sorted(_WORDS.sub(r"\1 ", f["message"]).split()[0] for f in now["findings"])}
            for path, stage, one, was, now in zip(written, stages, found, before, after, strict=True)
        ]


def _write_outputs(family: str, folder: Path) -> list[Path]:
    """The assets of a family as the program of its walk-through leaves them."""
    own = family_of(family)
    write_family(own, folder / "assets")
    program = TABLES / "tables.mf"
    if family in _PRINTED:
        printed = re.findall(r"^```\n(Is\(.*?)^```$", (ROOT / "README.md").read_text("utf-8"), re.DOTALL | re.MULTILINE)
        program = folder / "program.mf"
        program.write_text(f"labels {', '.join(own.vocabulary)}\n\n{printed[_PRINTED.index(family)]}", "utf-8")
    _run(folder, "apply", str(program), f"assets/{own.pattern}", "--out", "edited")
    return sorted((folder / "edited").glob(own.pattern))


def _run(folder: Path, *words: str) -> str:
    command = [sys.executable, "-m", "meshforge", *words]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):
        raise MeshForgeError(f"meshforge {' '.join(words)}: {done.stderr}")
    return done.stdout


def _check(folder: Path, paths: Sequence[Path], name: str) -> list[Row]:
    words = ("check", *map(str, paths), "--second-opinion", name, "--json", "--workers", "1")
    return [json.loads(line) for line in _run(folder, *words).splitlines()]


def _convert(folder: Path, path: Path, kind: str) -> Path:
    out = folder / kind / path.relative_to(folder / "edited").with_suffix(".usda")
    _run(folder, "convert", str(path), str(out))
    return out


def _describe_simcheck(line: Row) -> Row:
    own = [one for one in line["findings"] if one["rule"] == "simcheck"]
    words = (_WORDS.match(one["message"]) for one in own if one["severity"] == "warning")
    found = Counter(match[1] for match in words if match)
    return {
        "simcheck": "simcheck" in line,
        "errors": sum(one["severity"] == "error" for one in own),
        "warnings": sorted(found),
    }


def _list_features(line: Row) -> dict[str, str]:
    rows = line.get("simready", {}).get("features_summary", {})
    unmet = {name: "failed" if row["blocking_failure"] else "not met" for name, row in rows.items()}
    return {name: "passed" if rows[name]["passed"] else unmet[name] for name in sorted(rows)}


def has_purposes(path: Path) -> bool:
    """Whether colliders of a stage are guides where something else is shown, and all that is shown renders."""
    stage = Usd.Stage.Open(str(path))
    prims = [prim for prim in stage.Traverse() if prim.IsA(UsdGeom.Gprim)]
    kinds = {prim: UsdGeom.Imageable(prim).ComputePurpose() for prim in prims}
    colliders = [prim for prim in prims if prim.HasAPI(UsdPhysics.CollisionAPI)]
    shown = [prim for prim in prims if prim not in colliders]
    wanted = "guide" if shown else "default"
    return all(kinds[one] == wanted for one in colliders) and all(kinds[one] in ("default", "render") for one in shown)


def _count_families(rows: Sequence[Row]) -> Iterator[tuple[Cell, ...]]:
    for family in (one.name for one in FAMILIES):
        own = [row for row in rows if row["family"] == family]
        found = Counter(name for row in own for name in row["warnings"])
        warnings = ", ".join(f"{name} {count}" for name, count in sorted(found.items()))
        yield family, len(own), sum(row["errors"] for row in own), warnings or "none"


def _count_features(rows: Sequence[Row]) -> Iterator[tuple[Cell, ...]]:
    def count(name: str, when: str) -> int:
        return sum(row[when].get(name) == "passed" for row in rows)

    for name in sorted({name for row in rows for name in row["after"]}):
        yield name, count(name, "before"), count(name, "after"), len(rows)


def _count_unmet(rows: Sequence[Mapping[str, Any]]) -> Iterator[tuple[Cell, ...]]:
    found = Counter(name for row in rows for name in row["unmet"])
    yield from sorted(found.items(), key=lambda item: (-item[1], item[0]))
