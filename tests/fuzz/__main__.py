"""Runs damaged inputs through every reader, prints a table, and ends with 1 where one was neither read nor refused.

python -m tests.fuzz [--count 100000] [--only KIND] [--from SEED] [--keep FOLDER]
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from meshforge.batch import ExecutionOptions, WorkerFailure, run_isolated
from tests.fuzz.inputs import KINDS, Tried, changed, tried

_CHUNK = 250
_SECONDS, _MEMORY = 120.0, 3 << 30  # for a chunk


def main() -> int:
    parser = argparse.ArgumentParser(prog="script/fuzz")
    parser.add_argument("--count", type=int, default=100_000)
    parser.add_argument("--only", choices=sorted(KINDS))
    parser.add_argument("--from", type=int, default=0, dest="start")
    parser.add_argument("--keep", type=Path, help="folder for inputs that went wrong")
    options = parser.parse_args()
    print("| kind | inputs | refused | slowest, s of processor | peak, MiB | neither result nor error |")
    print("| --- " * 6 + "|")
    bad = 0
    for kind in [options.only] if options.only else list(KINDS):
        wrong = _kind(kind, options.start, options.count)
        bad += len(wrong)
        for seed, why in wrong:
            print(f"  {kind} {seed}: {why}", file=sys.stderr)
            if options.keep:
                options.keep.mkdir(parents=True, exist_ok=True)
                name, data = changed(kind, seed)
                (options.keep / f"{seed}_{Path(name).name}").write_bytes(data)
    return int(bad > 0)


def _kind(kind: str, start: int, count: int) -> list[tuple[int, str]]:
    """What went wrong with a kind, by seed."""
    work = [(kind, first, min(first + _CHUNK, start + count)) for first in range(start, start + count, _CHUNK)]
    rows, wrong = [], list[tuple[int, str]]()
    for (_, first, last), row in zip(
        work, run_isolated(tried, work, ExecutionOptions(timeout=_SECONDS, memory=_MEMORY)), strict=True
    ):
        if isinstance(row, WorkerFailure):  # one of them broke the worker: each by itself
            alone = [(kind, seed, seed + 1) for seed in range(first, last)]
            for (_, seed, _), single in zip(
                alone, run_isolated(tried, alone, ExecutionOptions(timeout=20.0, memory=_MEMORY)), strict=True
            ):
                if isinstance(single, WorkerFailure):
                    wrong.append((seed, single.why))
                else:
                    rows.append(single)
        else:
            rows.append(row)
        print(f"\r{kind} {last - start:,}", end="", file=sys.stderr, flush=True)
    wrong += [fault for row in rows for fault in row.wrong]
    _tell(kind, rows, count, wrong)
    return wrong


def _tell(kind: str, rows: list[Tried], count: int, wrong: list[tuple[int, str]]) -> None:
    refused = sum(row.refused for row in rows)
    slowest = max((row.slowest for row in rows), default=(0.0, 0))
    peak = max((row.peak for row in rows), default=0) >> 20
    print("\r", end="", file=sys.stderr)
    told = f"{len(wrong)}" if wrong else "none"
    print(f"| {kind} | {count:,} | {refused:,} | {slowest[0]:.2f} | {peak} | {told} |", flush=True)


if __name__ == "__main__":
    sys.exit(main())
