"""How long it takes until a command or a script can begin."""

from __future__ import annotations

import statistics
import subprocess
import sys
import tempfile
from functools import partial
from pathlib import Path

from benchmark.clock import once
from benchmark.report import Goal, Result, Table, Tell
from benchmark.speed.watch import compile_aside

_COMMANDS = {
    "python -c pass": [sys.executable, "-c", "pass"],
    "import meshforge": [sys.executable, "-c", "import meshforge"],
    "meshforge --help": [str(Path(sys.executable).with_name("meshforge")), "--help"],
    "meshforge.load is there": [sys.executable, "-c", "import meshforge; meshforge.load"],
    "import numpy": [sys.executable, "-c", "import numpy"],
    "import trimesh": [sys.executable, "-c", "import trimesh"],
    "trimesh.load is there": [sys.executable, "-c", "import trimesh; trimesh.load; trimesh.load_mesh"],
}
_ROUNDS = 9


def measure(tell: Tell, quick: bool) -> Result:
    """Time whole processes, in turns."""
    times: dict[str, list[float]] = {name: [] for name in _COMMANDS}
    rounds = 1 if quick else _ROUNDS
    with tempfile.TemporaryDirectory() as folder:
        compiled = compile_aside(Path(folder))
        for turn in range(rounds + 1):
            tell(f"start: round {turn} of {rounds}")
            for name, command in _COMMANDS.items():
                seconds = once(partial(subprocess.run, command, check=True, stdout=subprocess.DEVNULL, env=compiled))
                times[name] += [seconds] if turn else []
    median = {name: 1e3 * statistics.median(seconds) for name, seconds in times.items()}
    rows = tuple((name, median[name], 1e3 * min(times[name])) for name in _COMMANDS)
    ratio = median["import meshforge"] / median["import trimesh"]
    return Result(
        "start",
        "Starting",
        (Table("Whole processes, ms", ("", "median", "quickest"), rows),),
        (Goal("`import meshforge`, times `import trimesh`", "at most", 1.0, ratio),),
    )
