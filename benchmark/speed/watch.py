"""A command watched from outside: how long it takes, and how much memory each of its processes needs at most."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

_PAUSE = 0.1  # seconds between looks, which cost time themselves


@dataclass(frozen=True, slots=True)
class Usage:
    """output: of the command; main, worker: the largest resident size [bytes] of it, and of any process below it."""

    seconds: float
    output: str
    main: int
    worker: int


def compile_aside(folder: Path) -> dict[str, str]:
    """The environment of processes that find their modules compiled in a folder, from the second on."""
    return {**os.environ, "PYTHONDONTWRITEBYTECODE": "", "PYTHONPYCACHEPREFIX": str(folder)}


def watch_command(arguments: list[str]) -> Usage:
    """Run `meshforge` with arguments and watch it; memory is 0 where the system does not tell (not Linux)."""
    command = [str(Path(sys.executable).with_name("meshforge")), *arguments]
    largest: dict[int, int] = {}
    with tempfile.TemporaryFile() as output:
        began = time.perf_counter()
        process = subprocess.Popen(command, stdout=output, stderr=subprocess.DEVNULL)
        while process.poll() is None:
            look(process.pid, largest)
            with suppress(subprocess.TimeoutExpired):
                process.wait(_PAUSE)
        seconds = time.perf_counter() - began
        output.seek(0)
        text = output.read().decode("utf-8")
    main = largest.pop(process.pid, 0)
    return Usage(seconds, text, main, max(largest.values(), default=0))


def look(pid: int, largest: dict[int, int]) -> None:
    """Note the peak [bytes] of a process and of all below it; where one has become another program, of that one.

    A process that has just been started still has the memory of the one that started it.
    """
    for each in [pid, *_below(pid)]:
        largest[each] = _peak(each) or largest.get(each, 0)


def _below(pid: int) -> list[int]:
    """All processes that a process has started, and those have."""
    found: list[int] = []
    for task in Path(f"/proc/{pid}/task").glob("*/children"):
        try:
            children = [int(word) for word in task.read_text().split()]
        except OSError:
            continue
        for child in children:
            found += [child, *_below(child)]
    return found


def _peak(pid: int) -> int:
    try:
        status = Path(f"/proc/{pid}/status").read_text()
    except OSError:
        return 0
    lines = [line.split() for line in status.splitlines() if line.startswith("VmHWM:")]
    return int(lines[0][1]) * 1024 if lines else 0
