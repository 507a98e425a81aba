"""Runs in Blender's Python, confined: takes a script and a scene a line, answers with the objects that are left.

    python -m benchmark.baselines.blender.inside SCRATCH MEMORY FILE SECONDS

Of the standard library, numpy and bpy only. SCRATCH: the only folder to write to; the others as of `guard.limit`.
"""

from __future__ import annotations

import importlib.util
import json
import os
import sys
from pathlib import Path
from typing import Any

from benchmark.baselines.blender import guard, landlock, objects

_SYSTEM = ("/usr", "/lib", "/lib64", "/etc/ld.so.cache", "/dev/urandom", "/sys/devices/system/cpu", "/proc/cpuinfo")


def main() -> None:
    """Answer until there is nothing more to read."""
    scratch, *limits = sys.argv[1:]
    requests, replies = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    _hush(0, 1)  # scripts have nothing to read, and what they print goes nowhere
    spec = importlib.util.find_spec("bpy")
    if spec is None or spec.origin is None:
        sys.exit("this Python has no module bpy")
    read = [sys.prefix, sys.base_prefix, str(Path(spec.origin).parent), *_SYSTEM]
    guard.limit(*map(int, limits))
    locked = landlock.version() if landlock.restrict(read, [scratch, os.devnull]) else 0
    sys.path[:] = [path for path in sys.path if path != os.environ.get("PYTHONPATH")]
    import bpy

    guard.watch(read, [scratch])
    _send(replies, {"blender": bpy.app.version_string, "landlock": locked})
    _hush(2)
    for line in requests:
        job = json.loads(line)
        os.chdir(scratch)  # from wherever the last script went
        _send(replies, {"number": job["number"], **objects.edit_scene(job["script"], job["scene"])})


def _hush(*numbers: int) -> None:
    nothing = os.open(os.devnull, os.O_RDWR)
    for number in numbers:
        os.dup2(nothing, number)
    os.close(nothing)


def _send(stream: Any, answer: Any) -> None:
    stream.write(json.dumps(answer).encode() + b"\n")
    stream.flush()


if __name__ == "__main__":
    main()
