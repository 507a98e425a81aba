"""Whether MuJoCo and PyBullet collide where our hulls are, as a small ball finds; and whether `meshforge check` says so
where they do not."""

from __future__ import annotations

import csv
import json
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from hashlib import blake2b
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from benchmark.journal import ROOT, run_units
from benchmark.report import Cell, Goal, Result, Table, Tell
from meshforge.common import AssetError, MeshForgeError
from meshforge.formats import load
from meshforge.geometry import Floats
from script.corpus_table import corpus

_FORMATS = {"mujoco": ("mjcf", "urdf"), "bullet": ("urdf", "sdf", "obj", "stl")}
_A_FOLDER, _POINTS, _FEWEST, _NEAR, _SECONDS = 3, 1500, 50, 0.005, 120.0
_PROBE = Path(__file__).with_name("probe_engine.py")
Row = dict[str, Any]


def measure(tell: Tell, quick: bool) -> Result:
    """Compare on every asset of the corpus that an engine reads itself."""
    if not corpus().is_dir():
        raise AssetError("no corpus is here", where="engine_shapes", remedy="Set MESHFORGE_CORPUS to its folder.")
    units = list_units()[:: 20 if quick else 1]
    rows = run_units("engine-shapes", try_asset, units, tell)
    unsaid = [row for row in rows if row["differs"] and not row["said"]]
    return Result(
        "engine_shapes",
        "Shapes of engines",
        (
            Table("By engine and format", _COLUMNS, tuple(_count(rows))),
            Table("Not tried", ("engine", "why", "assets"), tuple(_count_untried(rows))),
            Table("What says so", ("engine", "rule", "assets"), tuple(_count_rules(rows))),
            Table(
                "Differs, and nothing says so",
                ("engine", "asset", "points"),
                tuple((row["engine"], row["asset"], row["differs"]) for row in unsaid),
            ),
        ),
        (Goal("assets that an engine makes another solid of, and no error says so", "at most", 0, len(unsaid)),),
        (
            f"Assets of the corpus that the engine reads itself, at most {_A_FOLDER} STL and OBJ files of a folder, "
            "the rest all. A ball is put at up to "
            f"{_POINTS} points in hulls, between points of two hulls, and anywhere in the box; it touches where a hull "
            f"is read here, and nowhere else. Points nearer to a surface than {100 * _NEAR:g}% of the diagonal and the "
            "engine's margin do not count. The ball knows nothing of how `check` compares shapes.",
            "*Differs*: at one point or more. *Said*: an error of `meshforge check --engine`, or that a piece is not "
            "convex. *Said, same*: an error, and the ball found no difference, as where a gap is narrow. What "
            "would make it fail: a scale, pose or file that an engine takes for another one; a hull of several pieces.",
        ),
        tuple(rows),
    )


def list_units() -> list[tuple[str, str]]:
    """Engines and assets, as paths from the corpus."""
    with (ROOT / "docs" / "corpus.tsv").open(encoding="utf-8") as table:
        rows = [
            row for row in csv.DictReader(table, delimiter="\t") if row["hulls"].isdigit() and int(row["hulls"]) >= 1
        ]
    chosen, folders = list[tuple[str, str]](), Counter[str]()
    for row in sorted(rows, key=lambda row: blake2b(row["path"].encode(), digest_size=8).hexdigest()):
        folder = f"{Path(row['path']).parent}{row['format']}"
        folders[folder] += row["format"] in ("obj", "stl")
        if folders[folder] <= _A_FOLDER and (corpus() / row["path"]).exists():
            chosen += [(engine, row["path"]) for engine, formats in _FORMATS.items() if row["format"] in formats]
    return sorted(chosen)


def try_asset(engine: str, asset: str) -> Row:
    """What an engine makes of an asset beside our hulls, and what is said of it."""
    row: Row = {"engine": engine, "asset": asset, "format": Path(asset).suffix[1:], "differs": 0, "points": 0}
    errors = _check(engine, corpus() / asset)
    row["said"] = [one for one in errors if one.startswith(f"{engine}-") or one == "non_convex"]
    try:
        mesh = load(corpus() / asset)
    except MeshForgeError as error:
        return row | {"untried": f"not read here: {error.message}"}
    rng = np.random.default_rng(int.from_bytes(blake2b(asset.encode(), digest_size=8).digest()))
    corners = [hull.shape.tessellate().vertices for hull in mesh.hulls]
    points = np.concatenate(list(_sample(corners, rng)))
    depths, near = _measure_depths(corners, points), _NEAR * mesh.diagonal
    with TemporaryDirectory() as name:
        given, out = Path(name) / "points.json", Path(name) / "touched.json"
        given.write_text(json.dumps({"points": points.tolist(), "radius": near / 10}), encoding="utf-8")
        command = [sys.executable, str(_PROBE), engine, str(corpus() / asset), str(given), str(out)]
        try:
            done = subprocess.run(command, capture_output=True, timeout=_SECONDS, check=False)
        except subprocess.TimeoutExpired:
            return row | {"untried": f"takes longer than {_SECONDS:g} s"}
        if done.returncode:
            return row | {"untried": "the engine refuses it" if done.returncode == 3 else "the engine crashes"}
        found = json.loads(out.read_text("utf-8"))
    touched, far = np.array(found["touched"]), np.abs(depths) > near + 2 * found["margin"]
    if far.sum() < _FEWEST:
        return row | {"untried": "as thin as the margins of the engine"}
    return row | {"points": int(far.sum()), "differs": int((touched != (depths > 0))[far].sum()), "untried": ""}


def _check(engine: str, path: Path) -> list[str]:
    """The rules of errors."""
    command = [sys.executable, "-m", "meshforge", "check", "--engine", engine, "--json", "--workers", "1", str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    (line,) = map(json.loads, done.stdout.splitlines())
    return sorted(
        {one["rule"] for one in line["findings"] if one["severity"] == "error" or one["rule"] == "non_convex"}
    )


def _sample(corners: Sequence[Floats], rng: np.random.Generator) -> Iterator[Floats]:
    """Points (n, 3): within hulls, on the way from one to another, and anywhere in the box around all."""
    third = _POINTS // 3
    own = rng.integers(len(corners), size=third)
    yield np.array([rng.dirichlet(np.full(len(corners[k]), 0.5)) @ corners[k] for k in own])
    pairs = rng.integers(len(corners), size=(third, 2))
    ends = np.array([[corners[k][rng.integers(len(corners[k]))] for k in pair] for pair in pairs])
    share = rng.uniform(size=(third, 1))
    yield share * ends[:, 0] + (1 - share) * ends[:, 1]
    every = np.concatenate(corners)
    yield rng.uniform(every.min(axis=0), every.max(axis=0), (third, 3))


def _measure_depths(corners: Sequence[Floats], points: Floats) -> Floats:
    """How deep each point is in a hull at most [m], (n,); outside all of them at most minus its distance."""
    depths = np.full(len(points), -np.inf)
    for one in corners:
        try:
            equations = ConvexHull(one).equations
        except QhullError:  # a flat one, which nothing is inside of
            continue
        depths = np.maximum(depths, -(points @ equations[:, :3].T + equations[:, 3]).max(axis=1))
    return depths


_COLUMNS = ("engine", "format", "assets", "not tried", "same", "differs, said", "said, same", "differs, not said")


def _count(rows: Sequence[Row]) -> Iterator[tuple[Cell, ...]]:
    for engine, form in sorted({(row["engine"], row["format"]) for row in rows}):
        some = [row for row in rows if (row["engine"], row["format"]) == (engine, form)]
        kinds = Counter("untried" if row["untried"] else (bool(row["differs"]), bool(row["said"])) for row in some)
        states = ("untried", (False, False), (True, True), (False, True), (True, False))
        yield engine, form, len(some), *(kinds[state] for state in states)


def _count_rules(rows: Sequence[Row]) -> Iterator[tuple[Cell, ...]]:
    kinds = Counter((row["engine"], rule) for row in rows for rule in row["said"])
    yield from ((*kind, count) for kind, count in sorted(kinds.items()))


def _count_untried(rows: Sequence[Row]) -> Iterator[tuple[Cell, ...]]:
    kinds = Counter((row["engine"], row["untried"]) for row in rows if row["untried"])
    yield from ((*kind, count) for kind, count in sorted(kinds.items()))
