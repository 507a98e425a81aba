"""Runs an engine in a process of its own: it can be stopped at once, and a crash in C++ becomes an error here."""

from __future__ import annotations

import contextlib
import io
import json
import os
import re
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.decomposition import worker
from meshforge.geometry.decomposition.settings import DecomposeSettings
from meshforge.geometry.decomposition.triangles import TriangleMesh

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


def run_engine(mesh: TriangleMesh, settings: DecomposeSettings, control: EngineControl) -> list[EnginePiece]:
    """The pieces that the engine makes of the mesh.

    Raises GeometryError: the engine crashed or took too long; DecompositionCancelledError.
    """
    with tempfile.TemporaryDirectory(prefix="meshforge-") as folder:
        source, target = Path(folder, "mesh.npz"), Path(folder, "pieces.npz")
        np.savez(source, vertices=mesh.vertices, faces=mesh.faces)
        job = json.dumps({"engine": settings.engine, **settings.as_dict()})
        command = [sys.executable, "-P", worker.__file__, str(source), str(target), job]
        log = Path(folder, "errors.txt")
        with log.open("wb") as errors:
            code = _supervise(command, errors.fileno(), control)
        if code != 0 or not target.exists():
            raise GeometryError(
                f"{settings.engine} crashed ({_last_message(log, code)})",
                remedy="Try other settings (preprocess_mode, threshold), the other engine, or fix the mesh.",
            )
        return unpack_pieces(target.read_bytes())


def _supervise(command: list[str], errors: int, control: EngineControl) -> int:
    """The exit code of a command, which is killed when it is cancelled or time is up."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path)), "PYTHONWARNINGS": "ignore"}
    process = subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=errors, text=True, env=environment
    )
    lines: list[str] = []
    reader = threading.Thread(target=_read_progress, args=(process, lines), daemon=True)
    reader.start()
    try:
        started = time.monotonic()
        while _is_running(process):
            _report(lines, control)
            if control.cancel():
                raise DecompositionCancelledError("the decomposition was stopped")
            if control.timeout is not None and time.monotonic() - started > control.timeout:
                problem = f"no decomposition within {control.timeout:g} s"
                raise GeometryError(problem, remedy="Allow more time, or set a coarser threshold.")
        reader.join()
        _report(lines, control)
        return process.returncode
    finally:
        process.kill()
        process.wait()
        reader.join()
        if process.stdout:
            process.stdout.close()


def _is_running(process: subprocess.Popen[str]) -> bool:
    with contextlib.suppress(subprocess.TimeoutExpired):
        process.wait(_TICK)
        return False
    return True


def _read_progress(process: subprocess.Popen[str], lines: list[str]) -> None:
    """Turns CoACD's log into progress; V-HACD is silent."""
    found = (_ROUND.search(line) for line in process.stdout or ())
    lines.extend(f"round {int(f[1]) + 1}: {f[2]} parts still to be split" for f in found if f)


def _report(lines: list[str], control: EngineControl) -> None:
    while lines:
        control.progress(lines.pop(0))


def _last_message(log: Path, code: int) -> str:
    lines = [line for line in log.read_text(errors="replace").splitlines() if line.strip()]
    message = lines[-1].strip() if lines else "no message"
    return f"exit code {code}: {message[-200:]}"


def pack_pieces(pieces: list[EnginePiece]) -> bytes:
    """The pieces as the content of an `.npz`."""
    buffer = io.BytesIO()
    np.savez_compressed(
        buffer,
        vertices=np.concatenate([v for v, _ in pieces] or [np.zeros((0, 3))]),
        faces=np.concatenate([f for _, f in pieces] or [np.zeros((0, 3), np.int64)]),
        counts=np.array([[len(v), len(f)] for v, f in pieces], dtype=np.int64).reshape(-1, 2),
    )
    return buffer.getvalue()


def unpack_pieces(content: bytes) -> list[EnginePiece]:
    """The pieces of `pack_pieces`. Raises ValueError, KeyError, EOFError or BadZipFile for anything else."""
    with np.load(io.BytesIO(content), allow_pickle=False) as arrays:
        vertices, faces, counts = (arrays[name] for name in ("vertices", "faces", "counts"))
    ends = np.cumsum(counts.reshape(-1, 2), axis=0)
    if (len(vertices), len(faces)) != tuple(ends[-1] if len(ends) else (0, 0)):
        raise ValueError("counts do not add up")
    starts = ends - counts
    return [
        (vertices[v0:v1].astype(np.float64), faces[f0:f1].astype(np.int64))
        for (v0, f0), (v1, f1) in zip(starts, ends, strict=True)
    ]
