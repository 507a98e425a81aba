"""The unit that a Collada file tells, which Gazebo obeys."""

from __future__ import annotations

import re
from pathlib import Path

_UNIT = re.compile(rb"<unit\b[^>]*?\bmeter\s*=\s*[\"']\s*([0-9.eE+-]+)\s*[\"']")
_HEAD = 100_000  # bytes within which a file tells its unit


def unit_of(mesh: Path) -> float:
    """The metres of the unit that a mesh file is in: as a Collada file says, 1 for all others."""
    if mesh.suffix.lower() != ".dae":
        return 1.0
    try:
        with mesh.open("rb") as stream:
            found = _UNIT.search(stream.read(_HEAD))
        unit = float(found[1]) if found else 1.0
    except (OSError, ValueError):
        return 1.0
    return unit if 0 < unit < float("inf") else 1.0
