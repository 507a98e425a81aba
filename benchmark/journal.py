"""Work that is done in units, by several processes, and kept as it comes: what was interrupted goes on where it was."""

from __future__ import annotations

import ast
import hashlib
import json
import os
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from pathlib import Path
from typing import Any

from benchmark.report import Tell
from script.stubs import read_offers

ROOT = Path(__file__).resolve().parents[1]
JOURNALS = ROOT / ".bench"
_FOLDERS = {"meshforge": ROOT / "src", "benchmark": ROOT, "script": ROOT}
"""Where the packages lie whose code results depend on."""
_CRITERIA = (
    "benchmark/criteria/*.py",
    *(f"src/meshforge/checks/physics/{name}.py" for name in ("scene", "objects", "gripper", "motion")),
)
_PROTOCOL = (*_CRITERIA, "benchmark/tasks/*/task.toml", "benchmark/tasks/*/templates/*", "benchmark/assets/data/*")
_MOVED = dict.fromkeys(("c4b02ffe6bb53905", "0106c17431d1ddb3"), "c01a0803d21fe2b3") | dict.fromkeys(
    ("bf7944a3e5e42c41", "64b2d53ae2223729"), "43abfe8b515caef9"
)
"""Digests of a protocol before and after changes of files after which verdicts stayed: criteria moved into the source
(decision 0084), and watch a joint by what checks watch it by."""
_DATA = ("src/meshforge/**/*.lark", "src/meshforge/*/*.json", *_PROTOCOL)
_REAL = ("benchmark/real/**/*.toml", "benchmark/real/**/*.obj")
Unit = tuple[Any, ...]
"""What a unit of work is given: JSON-able."""


@cache
def digest(module: str) -> str:
    """A digest of a module, of all of ours that it imports, however far down, and of the data that these read."""
    sources = list_sources(module)
    return _digest(
        [*(f"{path}" for path in sources), *_DATA, *(_REAL if "benchmark/real/family.py" in sources else ())]
    )


@cache
def digest_protocol(part: str) -> str:
    """A digest of the meshes, the tasks and their criteria that a part is about."""
    return _digest((*_CRITERIA, *_REAL) if part in ("real", "real_families", "real_assets") else _PROTOCOL)


def is_of_protocol(part: str, measured: str | None) -> bool:
    """Whether a part was measured on today's meshes, tasks and criteria; measured: the digest of its protocol then."""
    return digest_protocol(part) in (measured, _MOVED.get(measured or ""))


def list_sources(module: str) -> list[str]:
    """The files of a module and of all of ours that it imports, also inside functions; relative to the checkout."""
    found, waiting = dict[str, Path](), [module]
    while waiting:
        name = waiting.pop()
        path = _find_source(name)
        if name in found or path is None:
            continue
        found[name] = path
        waiting += [".".join(name.split(".")[:k]) for k in range(1, name.count(".") + 1)]
        waiting += _list_imports(path)
    return sorted(str(path.relative_to(ROOT)) for path in found.values())


def _find_source(name: str) -> Path | None:
    top, *rest = name.split(".")
    if top not in _FOLDERS:
        return None
    path = _FOLDERS[top].joinpath(top, *rest)
    return next((p for p in (path / "__init__.py", path.with_suffix(".py")) if p.is_file()), None)


@cache
def _list_imports(path: Path) -> frozenset[str]:
    found = set[str]()
    tree = ast.parse(path.read_text("utf-8"))
    source = _FOLDERS["meshforge"]
    package = ".".join(path.relative_to(source).parts[:-1]) if path.is_relative_to(source) else ""
    for node in (*ast.walk(tree), *read_offers(tree, package)):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            found |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
    return frozenset(found)


def _digest(patterns: Iterable[str]) -> str:
    found = hashlib.blake2b(digest_size=8)
    for pattern in patterns:
        for path in sorted(ROOT.glob(pattern)):
            found.update(f"{path.relative_to(ROOT)} {path.stat().st_size} ".encode() + path.read_bytes())
    return found.hexdigest()


def run_units(
    kind: str, work: Callable[..., Any], units: Sequence[Unit], tell: Tell, workers: int | None = None
) -> list[Any]:
    """The results of all units, in order, as JSON-able data; those in the journal are not worked out again.

    work: a function of a module, called with the unit. A unit that raises ends the run; what was done stays kept.
    workers: processes, None for one a processor.
    """
    path = JOURNALS / f"{digest(work.__module__)}-{kind}.jsonl"
    known = dict(_read(path))
    missing = [unit for unit in units if _key(unit) not in known]
    if missing:
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("a", encoding="utf-8") as journal, ProcessPoolExecutor(workers or os.cpu_count()) as pool:
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
