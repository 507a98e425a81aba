"""Reading mesh files: MeshForge against trimesh, on the same files."""

from __future__ import annotations

import contextlib
import logging
import math
import tempfile
import warnings
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from benchmark.clock import in_turns, medians, once
from benchmark.report import Goal, Result, Table, Tell
from benchmark.speed.assets import corpus_files, name_of
from meshforge.formats import read
from meshforge.formats.mesh_reader import read_triangles
from meshforge.samples import TABLES

OURS, HULLS, THEIRS, RAW = "MeshForge", "MeshForge, hulls too", "trimesh", "trimesh, process=False"
_ROUNDS = 5
_ASCII = 60  # files made for ASCII STL, which is rare among real ones
_LONGEST_ASCII = 400_000  # bytes of the binary file


def measure(tell: Tell, quick: bool) -> Result:
    """Time both on every file that both read."""
    with tempfile.TemporaryDirectory() as folder, _quiet():
        found = _quick_files(Path(folder)) if quick else _files(Path(folder))
        kinds = {kind: _kind(kind, files, tell, 1 if quick else _ROUNDS) for kind, files in found.items()}
    return _result({kind: rows for kind, rows in kinds.items() if rows})


def _files(folder: Path) -> dict[str, list[Path]]:
    binary = corpus_files(".stl")
    return {
        "OBJ": corpus_files(".obj"),
        "STL, binary": binary,
        "STL, ASCII": list(_ascii([p for p in binary if p.stat().st_size < _LONGEST_ASCII][::8], folder)),
        "GLB, glTF": corpus_files(".glb") + corpus_files(".gltf"),
    }


def _quick_files(folder: Path) -> dict[str, list[Path]]:

    tables = sorted(TABLES.glob("*.obj"))[:2]
    made = {".stl": [], ".glb": []}  # type: dict[str, list[Path]]
    for table in tables:
        for suffix, files in made.items():
            files.append(folder / f"{table.stem}{suffix}")
            _load(table).export(files[-1])
    ascii_ = list(_ascii(made[".stl"], folder))
    return {"OBJ": tables, "STL, binary": made[".stl"], "STL, ASCII": ascii_, "GLB, glTF": made[".glb"]}


def _ascii(files: list[Path], folder: Path) -> Iterator[Path]:
    """The triangles of binary files in ASCII, as trimesh writes them."""

    for k, path in enumerate(files[:_ASCII]):
        target = folder / f"{k}_{path.name}"
        target.write_text(_load(path).export(file_type="stl_ascii"))
        yield target


def _load(path: Path) -> Any:
    import trimesh

    return trimesh.load(path, force="mesh", process=False)


def _kind(kind: str, files: list[Path], tell: Tell, rounds: int) -> list[dict[str, Any]]:
    rows = []
    for k, path in enumerate(files):
        tell(f"load {kind}: {k + 1} of {len(files)}")
        row = one_file(path, rounds)
        if row:
            rows.append(row)
    return rows


def one_file(path: Path, rounds: int) -> dict[str, Any] | None:
    """Median seconds of each on one file, and whether they find the same box; None where one of them refuses it."""
    import trimesh

    theirs, raw = partial(trimesh.load, path), partial(trimesh.load, path, process=False)
    try:
        mine, other = read_triangles(path), raw()
        box = np.asarray(other.bounds, dtype=np.float64)
        hulls = once(partial(read, path))  # only the first counts: pieces of the same triangles are remembered
    except Exception:  # trimesh raises anything
        return None
    used = np.concatenate([surface.vertices[np.unique(surface.faces)] for surface in mine])
    size = float(np.linalg.norm(np.ptp(used, axis=0)))
    return {
        "file": name_of(path),
        "bytes": path.stat().st_size,
        "triangles": sum(len(surface.faces) for surface in mine),
        "same": bool(np.abs(box - [used.min(axis=0), used.max(axis=0)]).max() <= 1e-6 * size),
        "seconds": {
            **medians(
                in_turns({OURS: _run(partial(read_triangles, path)), THEIRS: _run(theirs), RAW: _run(raw)}, rounds)
            ),
            HULLS: hulls,
        },
    }


def _run(work: Callable[[], object]) -> Callable[[], Callable[[], object]]:
    return lambda: work


def _result(kinds: dict[str, list[dict[str, Any]]]) -> Result:
    table = Table(
        "Time of all files of a kind, ms",
        ("", "files", "MB", OURS, THEIRS, RAW, "ratio", "worst file", HULLS),
        tuple(_line(kind, rows) for kind, rows in kinds.items()),
    )
    return Result(
        "load",
        "Reading mesh files",
        (table,),
        tuple(Goal(f"times trimesh's time, {kind}", "at most", 1.5, _ratio(rows)) for kind, rows in kinds.items()),
        (
            "Like work: from a file to vertices and triangles. MeshForge also keeps groups and names, applies node "
            "transforms, checks every index and coordinate; trimesh's default merges equal vertices, reads materials.",
            "The ratio is that of MeshForge to trimesh's default; *worst file* is the largest ratio of one file.",
            "*Hulls too*: pieces are told apart, their convex hulls made and verified. trimesh does nothing like it in "
            "loading; the figure is shown so that nobody takes the other for the time to open an asset.",
            "ASCII STL is the same triangles as those of binary files, written by trimesh.",
            f"Files with another bounding box in trimesh: {_odd(kinds)}.",
        ),
        tuple({"kind": kind, **row} for kind, rows in kinds.items() for row in rows),
    )


def _line(kind: str, rows: list[dict[str, Any]]) -> tuple[str | int | float, ...]:
    total = {who: 1e3 * math.fsum(row["seconds"][who] for row in rows) for who in rows[0]["seconds"]}
    worst = max(row["seconds"][OURS] / row["seconds"][THEIRS] for row in rows)
    size = sum(row["bytes"] for row in rows) / 1e6
    return kind, len(rows), size, total[OURS], total[THEIRS], total[RAW], _ratio(rows), worst, total[HULLS]


def _ratio(rows: list[dict[str, Any]]) -> float:
    ours, theirs = (math.fsum(row["seconds"][who] for row in rows) for who in (OURS, THEIRS))
    return ours / theirs


def _odd(kinds: dict[str, list[dict[str, Any]]]) -> str:
    odd = [row["file"] for rows in kinds.values() for row in rows if not row["same"]]
    return ", ".join(odd) or "none"


@contextlib.contextmanager
def _quiet() -> Iterator[None]:
    """What trimesh has to say about odd files is not shown."""
    logging.disable(logging.CRITICAL)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    finally:
        logging.disable(logging.NOTSET)
