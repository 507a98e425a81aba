"""Opening robots of raw meshes: MeshForge against MuJoCo's compiler, on the same URDF."""

from __future__ import annotations

import logging
import math
import tempfile
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from benchmark.clock import in_turns, medians
from benchmark.report import Goal, Result, Table, Tell
from benchmark.speed.assets import corpus_files, name_of
from meshforge.formats import read, read_triangles
from meshforge.formats.libraries import mujoco
from meshforge.geometry import Floats

OURS, THEIRS = "MeshForge", "MuJoCo"
_ROUNDS = 5
_LEAST = 100_000  # bytes of a mesh of the corpus that counts
_MOST = 200_000  # faces, more than which MuJoCo refuses
_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def measure(tell: Tell, quick: bool) -> Result:
    """Time both on robots of one mesh, other bytes in each round, since both keep what they have read."""
    found = {f"ring of {segments} x {around}": _make_ring(segments, around) for segments, around in _list_rings(quick)}
    for path in [] if quick else [p for p in corpus_files(".stl") if "scenes_robots" in p.parts]:
        corners = np.concatenate([surface.vertices[surface.faces] for surface in read_triangles(path)])
        if path.stat().st_size >= _LEAST and len(corners) <= _MOST:
            found[name_of(path)] = corners
    rows = []
    for name, corners in found.items():
        tell(f"robots: {name}")
        with tempfile.TemporaryDirectory() as folder:
            rows.append({"file": name, "triangles": len(corners), "seconds": _time(corners, Path(folder), quick)})
    return _result(rows)


def _list_rings(quick: bool) -> list[tuple[int, int]]:
    return [(24, 12)] if quick else [(60, 40), (120, 60), (240, 90)]


def _make_ring(segments: int, around: int) -> Floats:
    """The triangles (m, 3, 3) of a closed ring with teeth, which fills two thirds of its hull."""
    turn, roll = (np.arange(count) * (2 * np.pi / count) for count in (segments, around))
    radius = 0.02 * (1 + 0.1 * np.cos(12 * turn))[:, None]
    reach = 0.05 + radius * np.cos(roll)
    high = radius * np.sin(roll)
    a = np.stack([reach * np.cos(turn)[:, None], reach * np.sin(turn)[:, None], high], axis=-1)
    b, d = np.roll(a, -1, axis=0), np.roll(a, -1, axis=1)
    c = np.roll(b, -1, axis=1)
    return np.concatenate([np.stack([a, b, c], axis=2), np.stack([a, c, d], axis=2)]).reshape(-1, 3, 3)


def _time(corners: Floats, folder: Path, quick: bool) -> dict[str, float]:
    """Median seconds of each; the mesh grows a little from run to run, so that nothing of it is known."""
    runs = iter(range(10_000))

    def prepare(who: str) -> Any:
        number = next(runs)
        path = _write_robot(corners * (1 + 1e-3 * number), folder / f"{number}.urdf")
        return partial(read, path) if who == OURS else partial(mujoco.MjModel.from_xml_path, str(path))

    logging.disable(logging.CRITICAL)
    try:
        return medians(in_turns({who: partial(prepare, who) for who in (OURS, THEIRS)}, 1 if quick else _ROUNDS))
    finally:
        logging.disable(logging.NOTSET)


def _write_robot(corners: Floats, path: Path) -> Path:
    """A URDF of one link that collides with triangles (m, 3, 3), in a binary STL beside it."""
    rows = np.zeros(len(corners), dtype=_RECORD)
    rows["corners"] = corners
    path.with_suffix(".stl").write_bytes(b" " * 80 + np.uint32(len(rows)).tobytes() + rows.tobytes())
    shape = f'<geometry><mesh filename="{path.stem}.stl"/></geometry>'
    path.write_text(f'<robot name="robot"><link name="base"><collision>{shape}</collision></link></robot>')
    return path


def _result(rows: list[dict[str, Any]]) -> Result:
    ours, theirs = (math.fsum(row["seconds"][who] for row in rows) for who in (OURS, THEIRS))
    lines = [(row["file"], row["triangles"], *_columns(*row["seconds"].values())) for row in rows]
    table = Table(
        "Time to open a URDF of one raw mesh, ms",
        ("", "triangles", OURS, THEIRS, "ratio"),
        (*lines, ("all", sum(row["triangles"] for row in rows), *_columns(ours, theirs))),
    )
    return Result(
        "robots",
        "Opening raw robots",
        (table,),
        (Goal("times MuJoCo's time, raw robots", "at most", 3.0, ours / theirs),),
        (
            "MeshForge reads, tells pieces apart, and says of each whether it is a hull; MuJoCo reads, welds, makes "
            "the convex hull and the inertia. Both in one run, in turns.",
        ),
        tuple(rows),
    )


def _columns(ours: float, theirs: float) -> tuple[float, float, float]:
    return 1e3 * ours, 1e3 * theirs, ours / theirs
