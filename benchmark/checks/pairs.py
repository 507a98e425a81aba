"""Contacts that nobody wants between bodies of articulated assets, before and after all proposed pairs are excluded, as
MuJoCo finds them in what is written."""

from __future__ import annotations

import csv
import json
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import mujoco
import numpy as np

from benchmark.journal import ROOT, run_units
from benchmark.report import Cell, Goal, Result, Table, Tell
from meshforge.common import AssetError
from script.corpus_table import corpus

_DEEP, _STEPS = 0.005, 25
_KINDS = (int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE))
_STILL = "no joint of it turns or slides"
Row = dict[str, Any]
Pair = tuple[str, str]


def measure(tell: Tell, quick: bool) -> Result:
    """Propose, confirm and write for every articulated asset, and ask MuJoCo before and after."""
    if not corpus().is_dir():
        raise AssetError("no corpus is here", where="pairs", remedy="Set MESHFORGE_CORPUS to its folder.")
    units = [(name,) for name in list_assets()[:: 6 if quick else 1]]
    rows = run_units("pairs", try_asset, units, tell)
    tried = [row for row in rows if not row["untried"]]
    return Result(
        "pairs",
        "Pairs that do not collide",
        (
            Table("Articulated assets", _COLUMNS, tuple(_list_assets(tried))),
            Table(
                "Not tried",
                ("asset", "why"),
                tuple((row["asset"], row["untried"]) for row in rows if row["untried"] not in ("", _STILL)),
            ),
        ),
        (
            Goal("unwanted contacts left, pairs of bodies", "at most", 0, sum(len(row["left"]) for row in tried)),
            Goal("wanted pairs that were lost", "at most", 0, sum(len(row["lost"]) for row in tried)),
        ),
        (
            "Assets of the corpus with several bodies and a joint that turns or slides, written as MJCF, opaque pieces "
            "as hulls. `check --pairs` proposes, each proposal is confirmed by name (`convert --exclude`), and MuJoCo "
            "opens what is written, with its own filter of parents.",
            f"*Unwanted*: two bodies deeper than {100 * _DEEP:g}% of the diagonal in each other at rest or at one of "
            f"{_STEPS} places of a joint's range, the others at rest. *Lost*: bodies that touched before, however "
            "deep, were not confirmed, and do not touch any more. The proposals have no part in either. What would "
            "make it fail: a pair that the sweep passes over, names that are others in the file, an exclusion of more.",
            "*Doubtful* proposals are not in `--exclude all`, after which their contacts are left: bodies that stop a "
            "joint, whose overlap `--physics` calls an error, or that are no neighbours, whose contact may be meant. "
            "Joints without limits are moved neither here nor there.",
        ),
        tuple(rows),
    )


def list_assets() -> list[str]:
    """The assets of several bodies, as paths from the corpus."""
    with (ROOT / "docs" / "corpus.tsv").open(encoding="utf-8") as table:
        rows = [row for row in csv.DictReader(table, delimiter="\t") if row["bodies"].isdigit()]
    some = [row["path"] for row in rows if int(row["bodies"]) > 1 and not row["path"].startswith("weird")]
    return sorted(name for name in some if (corpus() / name).exists())


def try_asset(asset: str) -> Row:
    """What MuJoCo says of an asset before and after."""
    empty: Row = {
        "asset": asset,
        "untried": "",
        "proposed": 0,
        "doubtful": 0,
        "before": [],
        "left": [],
        "lost": [],
        "left_by_all": [],
    }
    with TemporaryDirectory() as name:
        before, after = Path(name) / "before" / "asset.xml", Path(name) / "after" / "asset.xml"
        done = _run("convert", str(corpus() / asset), str(before), "--concave", "hull")
        if done.returncode:
            return empty | {"untried": next(line for line in done.stderr.splitlines() if line.startswith("error"))}
        line = json.loads(_run("check", "--pairs", "--json", "--workers", "1", str(before)).stdout)
        if "pairs" not in line:
            return empty | {"untried": "; ".join(line.get("notes", ())) or str(line["error"])}
        found = line["pairs"]["proposed"]
        chosen = [":".join(pair["bodies"]) for pair in found]
        words = [word for pair in chosen for word in ("--exclude", pair)]
        done = _run("convert", str(before), str(after), *words)
        if done.returncode:
            return empty | {"untried": next(line for line in done.stderr.splitlines() if line.startswith("error"))}
        usual = Path(name) / "usual" / "asset.xml"
        _run("convert", str(before), str(usual), "--exclude", "all")
        try:
            if not has_joints(before):
                return empty | {"untried": _STILL}
            (deep, touching), (left, still) = list_contacts(before), list_contacts(after)
        except ValueError as error:
            return empty | {"untried": f"MuJoCo refuses it: {str(error).splitlines()[0]}"}
        confirmed = {tuple(sorted(pair["bodies"])) for pair in found}
        return empty | {
            "proposed": len(found),
            "doubtful": sum(bool(pair["fault"]) for pair in found),
            "before": sorted(deep),
            "left": sorted(left),
            "left_by_all": sorted(list_contacts(usual)[0]),
            "lost": sorted(touching - confirmed - still),
        }


def _run(*words: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-m", "meshforge", *words], capture_output=True, text=True, check=False)


def has_joints(path: Path) -> bool:
    """Whether a hinge or a slide is in a model."""
    return bool({*mujoco.MjModel.from_xml_path(str(path)).jnt_type.tolist()} & {*_KINDS})


def list_contacts(path: Path) -> tuple[set[Pair], set[Pair]]:
    """The pairs of bodies that are deep in each other at rest or as one joint moves, and those that touch at all."""
    model = mujoco.MjModel.from_xml_path(str(path))
    data, deep, touching = mujoco.MjData(model), set[Pair](), set[Pair]()
    places = [data.qpos.copy()]
    for joint in np.flatnonzero(model.jnt_limited):
        if model.jnt_type[joint] in _KINDS:
            low, high = model.jnt_range[joint].tolist()
            for at in np.linspace(low, high, _STEPS):
                places.append(data.qpos.copy())
                places[-1][model.jnt_qposadr[joint]] = at
    size = 0.0
    for place in places:
        data.qpos[:] = place
        mujoco.mj_fwdPosition(model, data)
        if place is places[0]:
            size = _measure_diagonal(model, data)
        for contact in data.contact[: data.ncon]:
            numbers = (int(model.geom_bodyid[geom]) for geom in contact.geom)
            first, second = (model.body(k).name or f"body{k}" for k in numbers)  # as those without a name are read
            pair = (min(first, second), max(first, second))
            touching |= {pair}
            deep |= {pair} if contact.dist < -_DEEP * size else set()
    return deep, touching


def _measure_diagonal(model: Any, data: Any) -> float:
    """Of the box around all geoms that collide [m]."""
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for geom in np.flatnonzero(model.geom_contype):
        if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_PLANE:
            continue
        turn = np.abs(data.geom_xmat[geom].reshape(3, 3))
        centre = data.geom_xpos[geom] + data.geom_xmat[geom].reshape(3, 3) @ model.geom_aabb[geom, :3]
        half = turn @ model.geom_aabb[geom, 3:]
        low, high = np.minimum(low, centre - half), np.maximum(high, centre + half)
    return float(np.linalg.norm(high - low))


_COLUMNS = ("asset", "proposed", "of these doubtful", "unwanted before", "after", "after `all`", "wanted lost")


def _list_assets(rows: Sequence[Row]) -> Iterator[tuple[Cell, ...]]:
    for row in rows:
        counts = (len(row[key]) for key in ("before", "left", "left_by_all", "lost"))
        yield row["asset"], row["proposed"], row["doubtful"], *counts
    yield (
        "all",
        *(sum(row[key] for row in rows) for key in ("proposed", "doubtful")),
        *(sum(len(row[key]) for row in rows) for key in ("before", "left", "left_by_all", "lost")),
    )
