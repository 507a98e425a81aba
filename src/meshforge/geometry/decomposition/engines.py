"""Decomposition engines: the settings of each, one field an option, and each run in a process of its own: it can be
stopped at once, and a crash in C++ becomes an error."""

import contextlib
import io
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field, fields
from multiprocessing import parent_process
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from meshforge.common import GeometryError, UsageError
from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.decomposition import worker
from meshforge.geometry.decomposition.triangles import TriangleMesh
from meshforge.geometry.decomposition.worker import JOBS, MESH, PIECES

_LEAST_LIMITS = {"max_ch_vertex": 256, "max_hull_vertices": 64}
"""The least limits of vertices that are given to engines: their defaults, at which hulls lose hardly anything."""


def _option(default: Any, help: str, low: float | None = None, high: float | None = None, *choices: str) -> Any:
    return field(default=default, metadata={"help": help, "low": low, "high": high, "choices": choices})


class _Settings:
    """Checks every field against the limits in its metadata."""

    __slots__ = ()
    engine: ClassVar[str]
    package: ClassVar[str]

    def __post_init__(self) -> None:
        for option in fields(self):  # type: ignore[arg-type]  # subclasses are dataclasses
            value, (help, low, high, choices) = getattr(self, option.name), option.metadata.values()
            where = f"{self.engine} {option.name}"
            if choices and value not in choices:
                raise UsageError(f"{value!r} is none of {', '.join(choices)}", where=where, remedy=help)
            if (low is not None and not value >= low) or (high is not None and not value <= high):
                bounds = f"at least {low:g}" if high is None else f"between {low:g} and {high:g}"
                raise UsageError(f"{value!r} is not {bounds}", where=where, remedy=help)

    @property
    def max_vertices(self) -> int | None:
        """The most vertices of a hull, None without a limit."""
        return self.as_dict()["max_hull_vertices"] or None

    @staticmethod
    def limit_vertices(most: int) -> dict[str, int]:
        """Return the fields that say how many vertices a hull may have."""
        return {"max_hull_vertices": most}

    def as_dict(self) -> dict[str, Any]:
        return asdict(self)  # type: ignore[call-overload,no-any-return]  # as above

    def as_engine_options(self) -> dict[str, Any]:
        """The fields that the engine gets: it reduces hulls by leaving corners out, which may cost a third of their
        volume, so it may keep many; what is over the limit is reduced to a hull around it."""
        options = self.as_dict()
        return options | {name: max(most, options[name]) for name, most in _LEAST_LIMITS.items() if name in options}


@dataclass(frozen=True, slots=True)
class CoacdSettings(_Settings):
    """Options of CoACD (Wei et al. 2022), with the defaults of its authors; limits are those of its own program."""

    engine: ClassVar[str] = "coacd"
    package: ClassVar[str] = "coacd"
    threshold: float = _option(0.05, "Concavity at which splitting stops: lower gives more, closer hulls.", 0.01, 1)
    max_convex_hull: int = _option(-1, "Most hulls to make, by merging; -1 sets no limit.", -1)
    preprocess_mode: str = _option(
        "auto", "Remesh by voxels first: always, never, or when not watertight.", None, None, "auto", "on", "off"
    )
    preprocess_resolution: int = _option(50, "Voxels along the longest side when remeshing.", 20, 200)
    resolution: int = _option(2000, "Points sampled to measure concavity.", 100, 10000)
    mcts_nodes: int = _option(20, "Cutting planes tried in each direction.", 5, 40)
    mcts_iterations: int = _option(150, "Steps of the search for each cut.", 10, 2000)
    mcts_max_depth: int = _option(3, "Cuts that the search looks ahead.", 2, 7)
    pca: bool = _option(False, "Cut along the principal axes instead of the coordinate axes.")
    merge: bool = _option(True, "Merge hulls again where that costs no accuracy.")
    decimate: bool = _option(False, "Put a hull of max_ch_vertex vertices at most around each hull.")
    max_ch_vertex: int = _option(256, "Most vertices of a hull when decimating.", 4, 4096)
    extrude: bool = _option(False, "Extend neighbouring hulls into each other along their cuts.")
    extrude_margin: float = _option(0.01, "How far to extend hulls.", 0, 1)
    apx_mode: str = _option("ch", "Approximate by convex hulls or by boxes.", None, None, "ch", "box")
    real_metric: bool = _option(False, "Read threshold in metres instead of relative to the size.")
    seed: int = _option(0, "Seed of the search; the same seed gives the same hulls.", 0, 2**31 - 1)

    @property
    def max_vertices(self) -> int | None:
        return self.max_ch_vertex if self.decimate else None

    @staticmethod
    def limit_vertices(most: int) -> dict[str, int]:
        return {"decimate": True, "max_ch_vertex": most}


@dataclass(frozen=True, slots=True)
class VhacdSettings(_Settings):
    """Options of V-HACD 4 (Mamou, Ratcliff), with the defaults of its authors. It has no seed: it is deterministic."""

    engine: ClassVar[str] = "vhacd"
    package: ClassVar[str] = "vhacdx"
    max_convex_hulls: int = _option(64, "Most hulls to make.", 1, 4096)
    resolution: int = _option(400_000, "Voxels in all: more is closer and slower.", 1000, 64_000_000)
    volume_error: float = _option(1.0, "Stop splitting where voxels and hull differ by this percentage.", 0.001, 10)
    max_recursion_depth: int = _option(10, "Most cuts on top of each other.", 1, 64)
    shrink_wrap: bool = _option(True, "Pull the hulls' vertices from the voxels onto the mesh.")
    fill_mode: str = _option(
        "flood", "How the inside is found: flood and raycast need a closed mesh, surface keeps a shell.",
        None, None, "flood", "surface", "raycast",
    )  # fmt: skip
    max_hull_vertices: int = _option(64, "Most vertices of a hull.", 4, 2048)
    min_edge_length: int = _option(2, "Parts of fewer voxels than this along every side are not split.", 1, 64)
    find_best_plane: bool = _option(False, "Search the best cut instead of the middle (slow).")


@dataclass(frozen=True, slots=True)
class HullSettings(_Settings):
    """One convex hull of all there is, by Qhull: what MuJoCo and Bullet make of a mesh."""

    engine: ClassVar[str] = "hull"
    package: ClassVar[str] = "scipy"
    max_hull_vertices: int = _option(0, "Most vertices of the hull; 0 sets no limit.", 0)


DecomposeSettings = CoacdSettings | VhacdSettings | HullSettings


EnginePiece = tuple[Floats, Ints]
"""Vertices (n, 3) and triangles (m, 3) of one piece, as the engine gave them."""
_TICK = 0.05  # seconds between two looks at the clock and at `cancel`
_ROUND = re.compile(r"iter (\d+) -+ waiting pool: (\d+)")


class DecompositionCancelledError(GeometryError):
    """The caller asked to stop."""


@dataclass(frozen=True, slots=True)
class EngineControl:
    """How an engine is followed and stopped.

    progress: called with a few words on how far it is; cancel: asked whether to stop; timeout: [s], None for no end.
    """

    progress: Callable[[str], None] = lambda _: None
    cancel: Callable[[], bool] = lambda: False
    timeout: float | None = None


EngineJob = tuple[TriangleMesh, DecomposeSettings]
"""A mesh, and how to decompose it."""


def run_engines(jobs: Sequence[EngineJob], control: EngineControl) -> list[list[EnginePiece] | GeometryError]:
    """Return the pieces that engines make of meshes, one after the other in one process, or why there are none: an
    engine crashed. After a crash another process goes on with the next mesh, so each result is what it is alone.

    Raises GeometryError: the engines took too long; DecompositionCancelledError.
    """
    with tempfile.TemporaryDirectory(prefix="meshforge-") as name:
        folder, found = Path(name), list[list[EnginePiece] | GeometryError]()
        for number, (mesh, _) in enumerate(jobs):
            np.savez(folder / MESH.format(number), vertices=mesh.vertices, faces=mesh.faces)
        rows = [{"engine": settings.engine, **settings.as_engine_options()} for _, settings in jobs]
        (folder / JOBS).write_text(json.dumps(rows))
        log, started = folder / "errors.txt", time.monotonic()
        while len(found) < len(jobs):
            command = [sys.executable, "-P", worker.__file__, name, str(len(found))]
            code = _supervise(command, log, control, started)
            while (result := folder / PIECES.format(len(found))).exists():
                found.append(unpack_pieces(result.read_bytes()))
            if len(found) < len(jobs):
                lines = [line for line in log.read_text(errors="replace").splitlines() if line.strip()]
                message = lines[-1].strip()[-200:] if lines else "no message"
                problem = f"{jobs[len(found)][1].engine} crashed (exit code {code}: {message})"
                remedy = "Try other settings (preprocess_mode, threshold), the other engine, or fix the mesh."
                found.append(GeometryError(problem, remedy=remedy))
    return found


def _supervise(command: list[str], log: Path, control: EngineControl, started: float) -> int:
    """The exit code of a command, killed when cancelled or out of time since `started`; log: a file for its errors."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path)), "PYTHONWARNINGS": "ignore"}
    if parent_process() is not None:  # one of several workers, which share the processors; results are the same
        environment.setdefault("OMP_NUM_THREADS", "1")
    progress = log.with_name("progress.txt")
    with progress.open("wb") as lines, log.open("wb") as errors:
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=lines, stderr=errors, env=environment)
    shown, end = 0, math.inf if control.timeout is None else started + control.timeout
    try:
        while True:
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(min(_TICK, max(0.0, end - time.monotonic())))
            rounds = _ROUND.findall(progress.read_text(errors="replace"))  # of CoACD's log; V-HACD is silent
            for number, waiting in rounds[shown:]:
                control.progress(f"round {int(number) + 1}: {waiting} parts still to be split")
            shown = len(rounds)
            if process.returncode is not None:
                return process.returncode
            if control.cancel():
                raise DecompositionCancelledError("the decomposition was stopped")
            if time.monotonic() > end:
                problem = f"no decomposition within {control.timeout:g} s"
                raise GeometryError(problem, remedy="Allow more time, or set a coarser threshold.")
    finally:
        process.kill()
        process.wait()


def unpack_pieces(content: bytes) -> list[EnginePiece]:
    """Return the pieces of `pack_pieces`. Raises ValueError, KeyError, EOFError or BadZipFile for anything else."""
    vertices, faces, counts = unpack_arrays(content, "vertices", "faces", "counts")
    ends = np.cumsum(counts.reshape(-1, 2), axis=0)
    if (len(vertices), len(faces)) != tuple(ends[-1] if len(ends) else (0, 0)):
        raise ValueError("counts do not add up")
    return [
        (vertices[v0:v1].astype(np.float64), faces[f0:f1].astype(np.int64))
        for (v0, f0), (v1, f1) in zip(ends - counts, ends, strict=True)
    ]


def unpack_arrays(content: bytes, *names: str) -> list[Any]:
    """Return arrays of `pack_pieces` by name. Raises as `unpack_pieces` does."""
    with np.load(io.BytesIO(content), allow_pickle=False) as arrays:
        return [arrays[name] for name in names]
