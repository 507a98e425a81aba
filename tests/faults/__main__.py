"""Runs every fault many times and prints a table of what became of it; ends with 1 where anything was lost.

python -m tests.faults [--times 50] [--seed 0] [--only WORD]
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections import Counter
from pathlib import Path
from random import Random

from tests.faults.failing import FAILING
from tests.faults.killing import KILLING


def main() -> int:
    parser = argparse.ArgumentParser(prog="script/faults")
    parser.add_argument("--times", type=int, default=50)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", default="", help="those with this word in their title")
    options = parser.parse_args()
    print("| fault | times | when it came | lost or half-written |\n| --- | --- | --- | --- |", flush=True)
    bad = 0
    for fault in (fault for fault in (*KILLING, *FAILING) if options.only in fault.title):
        found, wrong, draw = Counter[str](), list[str](), Random(options.seed)
        with tempfile.TemporaryDirectory() as folder:
            made = fault(Path(folder))
            for time in range(options.times):
                print(f"\r{fault.title} {time + 1}", end="", file=sys.stderr, flush=True)
                try:
                    found[made.trial(draw)] += 1
                except AssertionError as error:
                    wrong.append((str(error).strip() or repr(error)).splitlines()[0])
        print("\r", end="", file=sys.stderr)
        when = ", ".join(f"{what} {count}" for what, count in found.most_common())
        print(f"| {fault.title} | {options.times} | {when} | {'; '.join(wrong) or 'nothing'} |", flush=True)
        bad += len(wrong)
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main())
