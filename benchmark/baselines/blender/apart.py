"""How Blender is started: in which Python, in namespaces of its own where these are allowed, without our variables."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
from collections.abc import Mapping
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
_ALONE = ("unshare", "--user", "--map-root-user", "--net", "--pid", "--fork", "--kill-child")
_FOLDERS = ("HOME", "TMPDIR", "XDG_CACHE_HOME", "XDG_CONFIG_HOME", "BLENDER_USER_RESOURCES")
_ONES = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MALLOC_ARENA_MAX", "PYTHONDONTWRITEBYTECODE")
_OWN = Path(".bench") / "blender" / "bin" / "python"


def find_python(variables: Mapping[str, str] = os.environ) -> Path | None:
    """A Python with Blender: that of BENCH_BLENDER, `.bench/blender` if it is there, or this one; None where none has.

    Whether the first two have it shows when it is started.
    """
    if own := variables.get("BENCH_BLENDER"):
        return Path(own)
    if (ROOT / _OWN).exists():
        return ROOT / _OWN
    return Path(sys.executable) if importlib.util.find_spec("bpy") else None


@cache
def alone() -> tuple[str, ...]:
    """The command that starts another one without network and other processes, empty where that is not allowed."""
    for command in ((*_ALONE, "--mount-proc"), _ALONE):
        try:
            tried = subprocess.run([*command, "true"], capture_output=True, timeout=10, check=False)
        except (OSError, subprocess.TimeoutExpired):
            continue
        if tried.returncode == 0:
            return command
    return ()


def environment(scratch: str) -> dict[str, str]:
    """All variables that Blender finds: nothing of ours, so no key."""
    plain = {"PATH": "/usr/bin:/bin", "LANG": "C.UTF-8", "PYTHONPATH": str(ROOT), "PYTHONHASHSEED": "0"}
    return plain | dict.fromkeys(_FOLDERS, scratch) | dict.fromkeys(_ONES, "1")
