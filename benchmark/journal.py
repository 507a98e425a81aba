"""Work that is done in units, by several processes, and kept as it comes: what was interrupted goes on where it was."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from pathlib import Path
from typing import Any

from benchmark.report import Tell

ROOT = Path(__file__).resolve().parents[1]
JOURNALS = ROOT / ".bench"
_SOURCES = ("src/meshforge/**/*.py", "src/meshforge/**/*.lark", "benchmark/**/*.py", "benchmark/**/*.toml")
_APART = {"batch", "checks", "cli", "preparation", "project", "samples", "studio", "evaluation", "results"}
"""Rooms that no unit of work comes from: what they do is to use, or only shows, what is measured."""
_DATA = ("benchmark/assets/data/*", "benchmark/tasks/*/templates/*")
_PROTOCOL = ("benchmark/criteria/*.py", "benchmark/tasks/*/task.toml", *_DATA)
Unit = tuple[Any, ...]
"""What a unit of work is given: JSON-able."""


@cache
def digest() -> str:
    """A digest of the code and the data that results depend on, but for what only shows them."""
    return _digest((*_SOURCES, *_DATA))


@cache
def digest_protocol() -> str:
    """A digest of the meshes, the tasks and their criteria."""
    return _digest(_PROTOCOL)


def _digest(patterns: Iterable[str]) -> str:
    found = hashlib.blake2b(digest_size=8)
    for pattern in patterns:
        for path in sorted(ROOT.glob(pattern)):
            if not _APART & set(path.relative_to(ROOT).parts):
                found.update(f"{path.relative_to(ROOT)} {path.stat().st_size} ".encode() + path.read_bytes())
    return found.hexdigest()


def run_units(kind: str, work: Callable[..., Any], units: Sequence[Unit], tell: Tell) -> list[Any]:
    """The results of all units, in order, as JSON-able data; those in the journal are not worked out again.

    work: a function of a module, called with the unit. A unit that raises ends the run; what was done stays kept.
    """
    path = JOURNALS / f"{digest()}-{kind}.jsonl"
    known = dict(_read(path))
    missing = [unit for unit in units if _key(unit) not in known]
    if missing:
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("a", encoding="utf-8") as journal, ProcessPoolExecutor(os.cpu_count()) as pool:
            journal.write("\n" if journal.tell() else "")  # after a line that was cut off
            for count, (unit, result) in enumerate(_finished(pool, work, missing), 1):
                known[_key(unit)] = result
                journal.write(json.dumps([unit, result]) + "\n")
                journal.flush()
                tell(f"{kind}: {len(units) - len(missing) + count} of {len(units)}, {' '.join(map(str, unit))}")
    return [known[_key(unit)] for unit in units]


def _finished(pool: ProcessPoolExecutor, work: Callable[..., Any], units: Sequence[Unit]) -> Iterable[tuple[Unit, Any]]:
    from concurrent.futures import as_completed

    running = {pool.submit(work, *unit): unit for unit in units}
    try:
        for future in as_completed(running):
            yield running[future], future.result()
    finally:
        pool.shutdown(wait=False, cancel_futures=True)


def _read(path: Path) -> Iterable[tuple[str, Any]]:
    """What the journal holds; a last line that was cut off is passed over."""
    for line in path.read_text("utf-8").splitlines() if path.is_file() else ():
        try:
            unit, result = json.loads(line)
        except ValueError:
            continue
        yield _key(unit), result


def _key(unit: Sequence[Any]) -> str:
    return json.dumps(list(unit))
