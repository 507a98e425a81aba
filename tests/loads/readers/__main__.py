"""Tells as JSON lines what a reader finds: first its version, then of each file the shapes, or the error.

python -m tests.loads.readers NAME < FILES, in a Python that needs nothing but the reader and NumPy
"""

from __future__ import annotations

import json
import os
import sys
from importlib.metadata import version
from pathlib import Path
from typing import Any

from tests.loads.readers import READERS
from tests.loads.readers.base import Reader


def main() -> None:
    """Read the files that standard input names, one a line."""
    reader = READERS[sys.argv[1]]
    out = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what a reader prints is no answer
    _tell(out, {"version": version(reader.package.partition("[")[0])})
    for line in sys.stdin:
        _tell(out, _found(reader, Path(line.rstrip("\n"))))


def _found(reader: Reader, path: Path) -> dict[str, Any]:
    files = sorted(path.iterdir()) if path.is_dir() else [path]
    try:
        return {"shapes": [[seen.kind, seen.reach] for file in files for seen in reader.shapes(file)]}
    except Exception as error:  # whatever another program does is its answer
        return {"error": f"{type(error).__name__}: {error}"[:2000]}


def _tell(out: Any, row: dict[str, Any]) -> None:
    print(json.dumps(row), file=out, flush=True)


if __name__ == "__main__":
    main()
