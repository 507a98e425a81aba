"""Planted defects: what `meshforge check` finds of them on assets of the corpus, by the plan in `defects.toml`."""

from __future__ import annotations

import csv
import json
import shutil
import subprocess
import sys
import tomllib
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from hashlib import blake2b
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from xml.etree import ElementTree

from benchmark.checks import defect_kinds, files
from benchmark.checks.defect_kinds import Defect, Subject
from benchmark.journal import ROOT, run_units
from benchmark.report import Cell, Goal, Result, Table, Tell
from meshforge.common import AssetError, MeshForgeError
from meshforge.formats import load, save
from script.corpus_table import corpus

PLAN = tomllib.loads(Path(__file__).with_name("defects.toml").read_text("utf-8"))
_CHECK = ("check", "--strict", "--fit", "--clearance", "--physics", "--json", "--workers", "1", "--timeout", "120")
_A_FOLDER, _OF_A_KIND, _MOST_LISTED = 3, 40, 12
Row = dict[str, Any]
Finding = tuple[str, str, tuple[str, ...], str]
"""Rule, severity, hulls, message."""


def measure(tell: Tell, quick: bool) -> Result:
    """Plant every kind on assets that it fits, and every harmless change, and check them beside what they were."""
    if not corpus().is_dir():
        raise AssetError("not run: no corpus is here", where="defects", remedy="Set MESHFORGE_CORPUS to its folder.")
    assets = list_assets()[:: 20 if quick else 1]
    fits = dict(zip(assets, run_units("defect-fits", find_fits, [(one,) for one in assets], tell), strict=True))
    chosen = {one: [kind for kind in kinds if one in _choose(kind, fits)] for one, kinds in fits.items()}
    units = [(one, tuple(kinds)) for one, kinds in chosen.items() if kinds]
    rows = [row for found in run_units("defects", try_asset, units, tell) for row in found]
    defects, harmless = ([row for row in rows if row["kind"] in _names(what)] for what in ("defect", "harmless"))
    found = 100 * sum(bool(row["found"]) for row in defects) / max(len(defects), 1)
    alarms = 100 * sum(bool(row["found"]) for row in harmless) / max(len(harmless), 1)
    own = {row["asset"]: row["own"] for row in rows}
    return Result(
        "defects",
        "Planted defects",
        (
            Table("Found", _COLUMNS, tuple(_count(name, defects) for name in _names("defect"))),
            Table("Alarms on harmless changes", _COLUMNS, tuple(_count(name, harmless) for name in _names("harmless"))),
            Table("Missed, one of each kind", ("kind", "asset"), tuple(_list_missed(defects))),
            Table("Errors that assets have as they are", ("rule", "assets"), tuple(_count_rules(own))),
        ),
        (
            Goal("planted defects found, %", "at least", 95.0, found),
            Goal("harmless changes with an alarm, %", "at most", 2.0, alarms),
        ),
        (
            f"{len(assets)} assets of the corpus with two hulls or more, at most {_A_FOLDER} of a folder and all with "
            "joints, each written as a URDF first. The plan, `benchmark/checks/defects.toml`, was committed before the "
            "checks of joints, of shapes of engines and of primitives were written.",
            "Found: a finding that the same asset without the defect has not, and that names what was changed, or no "
            "hull. As `--strict` counts; *as errors* without it. The same for alarms.",
            "A kind that no check finds stays in the figure. What would make it fall: defects smaller than planned, "
            "bodies that hide a change. Kinds that need something shown are planted only where something is.",
        ),
        tuple(rows),
    )


def _names(what: str) -> list[str]:
    return [one["name"] for one in PLAN[what]]


def list_assets() -> list[str]:
    """The assets, as paths from the corpus."""
    with (ROOT / "docs" / "corpus.tsv").open(encoding="utf-8") as table:
        rows = [
            row for row in csv.DictReader(table, delimiter="\t") if row["hulls"].isdigit() and int(row["hulls"]) >= 2
        ]
    sound = [row for row in rows if not row["path"].startswith("weird") and (corpus() / row["path"]).exists()]
    folders = dict[str, list[str]]()
    for name in sorted((row["path"] for row in sound), key=_digest):
        folders.setdefault(str(Path(name).parent), []).append(name)
    some = {name for names in folders.values() for name in names[:_A_FOLDER]}
    return sorted(some | {row["path"] for row in sound if int(row["bodies"]) > 1})


def _digest(text: str) -> str:
    return blake2b(text.encode(), digest_size=8).hexdigest()


def _choose(kind: str, fits: Mapping[str, Sequence[str]]) -> list[str]:
    """The assets on which a kind is planted."""
    some = [asset for asset, kinds in fits.items() if kind in kinds]
    return sorted(some, key=lambda asset: _digest(f"{kind}|{asset}"))[:_OF_A_KIND]


def find_fits(asset: str) -> list[str]:
    """The kinds that fit an asset; none where it cannot be written as a URDF."""
    with TemporaryDirectory() as folder:
        file = _write_base(asset, Path(folder))
        return [kind for kind in _list_kinds() if file and _plant(kind, asset, file, Path(folder) / "planted")]


def _list_kinds() -> list[str]:
    return [*_names("defect"), *_names("harmless")]


def _write_base(asset: str, folder: Path) -> Path | None:
    try:
        return save(load(corpus() / asset), folder / "base" / "asset.urdf").path
    except MeshForgeError:
        return None


def _plant(kind: str, asset: str, base: Path, folder: Path) -> tuple[Path, Defect] | None:
    """The file of the asset with a defect, and what was changed; None where it does not fit."""
    subject = Subject(load(base), f"{kind}|{asset}")
    target = folder / _digest(kind) / base.name
    shutil.rmtree(target.parent, ignore_errors=True)
    if rewrite := {**files.DEFECTS, **files.HARMLESS}.get(kind):
        shutil.copytree(base.parent, target.parent)
        tree = ElementTree.parse(target)
        planted = rewrite(subject, target, tree.getroot())
        tree.write(target, encoding="utf-8")
        return (target, planted) if planted else None
    planted = {**defect_kinds.DEFECTS, **defect_kinds.HARMLESS}[kind](subject)
    if planted is None:
        return None
    try:
        saved = save(planted.mesh, target)
    except MeshForgeError:
        return None
    names = frozenset(saved.names.get(name, name) for name in planted.hulls)
    return saved.path, Defect(planted.mesh, names | planted.hulls, planted.bodies)


def try_asset(asset: str, kinds: Sequence[str]) -> list[Row]:
    """What is found of each kind on an asset."""
    engines = {one["name"]: one.get("engine") for one in PLAN["defect"]}
    with TemporaryDirectory() as name:
        folder = Path(name)
        base = _write_base(asset, folder)
        assert base
        planted = {kind: made for kind in kinds if (made := _plant(kind, asset, base, folder / "planted"))}
        rows = list[Row]()
        for engine in dict.fromkeys(engines.get(kind) for kind in planted):
            some = {kind: made for kind, made in planted.items() if engines.get(kind) == engine}
            found = _check([base, *(file for file, _ in some.values())], engine)
            own = found[base]
            for kind, (file, what) in some.items():
                new = [one for one in found[file] if _is_new(one, own, what)]
                rows.append(
                    {
                        "kind": kind,
                        "asset": asset,
                        "found": [one[0] for one in new],
                        "errors": [one[0] for one in new if one[1] == "error"],
                        "own": sorted({one[0] for one in own if one[1] == "error"}),
                    }
                )
        return rows


def _check(paths: Sequence[Path], engine: str | None) -> dict[Path, list[Finding]]:
    command = [sys.executable, "-m", "meshforge", *_CHECK, *(["--engine", engine] if engine else []), *map(str, paths)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    found = dict[Path, list[Finding]]()
    for line in map(json.loads, done.stdout.splitlines()):
        rows = [(one["rule"], one["severity"], tuple(one["hulls"]), one["message"]) for one in line["findings"]]
        found[Path(line["asset"])] = rows
    assert len(found) == len(paths), done.stderr
    return found


def _is_new(finding: Finding, own: Sequence[Finding], what: Defect) -> bool:
    """Whether an asset without the defect has no such finding, and it is about the defect; of changes that give hulls
    other names, whether it has none by that rule."""
    rule, _, hulls, message = finding
    if not (what.hulls or what.bodies):
        return all(one[0] != rule for one in own)
    is_about = not hulls or bool(what.hulls & {*hulls}) or any(body and body in message for body in what.bodies)
    return is_about and all(one[:3:2] != (rule, hulls) for one in own)


_COLUMNS = ("kind", "planted", "found, %", "as errors, %", "by")


def _count(name: str, rows: Sequence[Row]) -> tuple[Cell, ...]:
    some = [row for row in rows if row["kind"] == name]
    by = Counter(rule for row in some for rule in set(row["found"])).most_common(3)
    shares = [100 * sum(bool(row[key]) for row in some) / len(some) if some else "" for key in ("found", "errors")]
    return name, len(some), *shares, ", ".join(f"{rule} {count}" for rule, count in by)


def _list_missed(rows: Sequence[Row]) -> Iterator[tuple[Cell, ...]]:
    missed = {row["kind"]: row["asset"] for row in reversed(rows) if not row["found"]}
    yield from sorted(missed.items())


def _count_rules(own: Mapping[str, Sequence[str]]) -> Iterator[tuple[Cell, ...]]:
    yield from Counter(rule for rules in own.values() for rule in rules).most_common(_MOST_LISTED)
    yield "none", sum(not rules for rules in own.values())
