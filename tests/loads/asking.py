"""Asking a reader about files, in a process of its own, in a Python that has it."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tests.loads.readers import READERS, Seen

_ROOT = Path(__file__).parents[2]
_START, _EACH = 120.0, 20.0  # seconds


@dataclass(frozen=True)
class Answers:
    """The version of a reader, and of each file its shapes, or its error as a text."""

    version: str
    found: tuple[tuple[Seen, ...] | str, ...]


def ask(name: str, python: str, paths: Sequence[Path]) -> Answers | None:
    """What a reader finds in each of the files; None where that Python has not got it.

    A file at which its process dies is told as its error, and another process goes on with the next one.
    """
    module = READERS[name].module
    if subprocess.run([python, "-c", f"import {module}"], capture_output=True, check=False).returncode:
        return None
    version, found = "", list[tuple[Seen, ...] | str]()
    while not version or len(found) < len(paths):
        rows, died = _process([python, "-m", "tests.loads.readers", name], paths[len(found) :])
        version = rows[0]["version"] if rows else "unknown"
        found += [_answer(row) for row in rows[1:]]
        if len(found) < len(paths):
            found.append(died)
    return Answers(version, tuple(found))


def _answer(row: Any) -> tuple[Seen, ...] | str:
    return str(row["error"]) if "error" in row else tuple(Seen(kind, tuple(reach)) for kind, reach in row["shapes"])


def _process(words: list[str], paths: Sequence[Path]) -> tuple[list[Any], str]:
    """The lines that a process tells about files, and how it ended."""
    given = "".join(f"{path.resolve()}\n" for path in paths)
    timeout = _START + _EACH * len(paths)
    try:
        done = subprocess.run(
            words, input=given, capture_output=True, text=True, cwd=_ROOT, timeout=timeout, check=False
        )
        out, said = done.stdout, (done.stderr.strip().splitlines() or [""])[-1]
        end = f"its process ended with {done.returncode}: {said}"
    except subprocess.TimeoutExpired as late:
        out, end = late.stdout.decode() if isinstance(late.stdout, bytes) else "", f"not done after {timeout:g} s"
    return [json.loads(line) for line in out.splitlines()], end
