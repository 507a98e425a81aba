"""Runs an engine in a process of its own: it can be stopped at once, and a crash in C++ becomes an error here."""

from __future__ import annotations

import contextlib
import json
import os
import re
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry.decomposition import worker
from meshforge.geometry.decomposition.cache import EnginePiece, unpack_pieces
from meshforge.geometry.decomposition.settings import DecomposeSettings
from meshforge.geometry.decomposition.triangles import TriangleMesh

DecompositionProgress = Callable[[str], None]
"""Told in a few words how far a decomposition is."""
_TICK = 0.05  # seconds between two looks at the clock and at `cancel`
_ROUND = re.compile(r"iter (\d+) -+ waiting pool: (\d+)")


class DecompositionCancelledError(GeometryError):
    """The caller asked to stop."""


def run_engine(
    mesh: TriangleMesh,
    settings: DecomposeSettings,
    progress: DecompositionProgress | None = None,
    cancel: Callable[[], bool] | None = None,
    timeout: float | None = None,
) -> list[EnginePiece]:
    """The pieces that the engine makes of the mesh.

    timeout: [s]. Raises GeometryError: the engine crashed or took too long; DecompositionCancelledError.
    """
    with tempfile.TemporaryDirectory(prefix="meshforge-") as folder:
        source, target = Path(folder, "mesh.npz"), Path(folder, "pieces.npz")
        np.savez(source, vertices=mesh.vertices, faces=mesh.faces)
        job = json.dumps({"engine": settings.engine, **settings.as_dict()})
        command = [sys.executable, "-P", worker.__file__, str(source), str(target), job]
        log = Path(folder, "errors.txt")
        with log.open("wb") as errors:
            code = _supervise(command, errors.fileno(), progress or _ignore_progress, cancel or _never_cancel, timeout)
        if code != 0 or not target.exists():
            raise GeometryError(
                f"{settings.engine} crashed ({_last_message(log, code)})",
                remedy="Try other settings (preprocess_mode, threshold), the other engine, or fix the mesh.",
            )
        return unpack_pieces(target.read_bytes())


def _supervise(
    command: list[str], errors: int, progress: DecompositionProgress, cancel: Callable[[], bool], timeout: float | None
) -> int:
    """The exit code of a command, which is killed when `cancel` says so or time is up."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path)), "PYTHONWARNINGS": "ignore"}
    process = subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=errors, text=True, env=environment
    )
    heard: list[str] = []
    reader = threading.Thread(target=_read_progress, args=(process, heard), daemon=True)
    reader.start()
    try:
        started = time.monotonic()
        while _is_running(process):
            _report(heard, progress)
            if cancel():
                raise DecompositionCancelledError("the decomposition was stopped")
            if timeout is not None and time.monotonic() - started > timeout:
                raise GeometryError(
                    f"no decomposition within {timeout:g} s", remedy="Allow more time, or set a coarser threshold."
                )
        reader.join()
        _report(heard, progress)
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


def _read_progress(process: subprocess.Popen[str], heard: list[str]) -> None:
    """Turns CoACD's log into progress; V-HACD is silent."""
    found = (_ROUND.search(line) for line in process.stdout or ())
    heard.extend(f"round {int(f[1]) + 1}: {f[2]} parts still to be split" for f in found if f)


def _report(heard: list[str], progress: DecompositionProgress) -> None:
    while heard:
        progress(heard.pop(0))


def _last_message(log: Path, code: int) -> str:
    lines = [line for line in log.read_text(errors="replace").splitlines() if line.strip()]
    told = lines[-1].strip() if lines else "no message"
    return f"exit code {code}: {told[-200:]}"


def _ignore_progress(_: str) -> None: ...


def _never_cancel() -> bool:
    return False
