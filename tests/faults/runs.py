"""Runs of the command line that end badly, and what they leave."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from random import Random

from benchmark.batch.crowd import STOOLS, crowd, stools, tables
from meshforge.batch import STATE

_RUN = "from meshforge.cli import main; main()"


def begun(words: Sequence[str | Path], cwd: Path) -> subprocess.Popen[str]:
    """A `meshforge` command that was started, the head of a group of processes."""
    command = [sys.executable, "-c", _RUN, *map(str, words)]
    pipe = subprocess.PIPE
    return subprocess.Popen(command, cwd=cwd, stdout=pipe, stderr=pipe, text=True, start_new_session=True)


def ended(process: subprocess.Popen[str]) -> tuple[int, str]:
    """The exit code of a command, and all that it said; it may not have fallen over."""
    out, err = process.communicate(timeout=300)
    assert "Traceback" not in err, err
    assert "fault of MeshForge" not in out + err, out + err
    return process.returncode, out + err


def wait_until(process: subprocess.Popen[str], holds: Callable[[], bool]) -> None:
    """Return when something holds, or the command has ended."""
    while process.poll() is None and not holds():
        time.sleep(0.002)


def wait_for(process: subprocess.Popen[str], out: Path, count: int) -> None:
    """Return when so many assets in an output folder are new, or the command has ended."""
    since = time.time()
    wait_until(process, lambda: _made(out, since) >= count)


def _made(out: Path, since: float) -> int:
    folders = (Path(at) for at, _, _ in os.walk(out) if STATE not in Path(at).parts)
    return sum(path.stat().st_mtime >= since for folder in folders for path in folder.glob("*.obj"))


def killed(process: subprocess.Popen[str], after: float, draw: Random) -> bool:
    """Kill a command after some seconds, alone or with its workers; whether it was still running."""
    time.sleep(after)
    was_running = process.poll() is None
    if draw.random() < 0.5:
        process.kill()
    else:
        with suppress(ProcessLookupError):  # it has just ended
            os.killpg(process.pid, signal.SIGKILL)
    process.communicate()
    return was_running


def stool_family(folder: Path, count: int) -> None:
    """A program `p.mf` and so many small assets with labels."""
    (folder / "models").mkdir(parents=True)
    crowd(stools(folder / "models"), count, folder / "assets")
    (folder / "p.mf").write_text(STOOLS)


def table_family(folder: Path, count: int) -> None:
    """Some of the bundled tables, with labels beside them."""
    crowd(tables()[:count], count, folder / "assets")


def outputs(out: Path) -> dict[str, bytes]:
    """The files that a user finds in an output folder."""
    files = (path for path in out.rglob("*") if path.is_file()) if out.exists() else ()
    return {p.relative_to(out).as_posix(): p.read_bytes() for p in files if STATE not in p.relative_to(out).parts}


def is_part_of(found: dict[str, bytes], whole: dict[str, bytes]) -> bool:
    """Whether each file that is there is as it should be in the end."""
    return all(whole.get(name) == data for name, data in found.items())
