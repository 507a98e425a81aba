"""Runs parts of the speed benchmark by name, and writes what they find into the results.

Usage: script/bench [PART ...] [--quick] [--out FOLDER]
"""

from __future__ import annotations

import argparse
import json
import sys
from importlib import import_module
from pathlib import Path

from benchmark.speed.machine import machine
from benchmark.speed.report import Result, as_text
from meshforge.files import write_atomically

PARTS = ("contact", "load", "save", "apply", "geometry", "start")
RESULTS = Path(__file__).resolve().parents[1] / "results"
PAGE = "speed.md"


def main(arguments: list[str] | None = None) -> int:
    """Run the parts that are named, all where none is."""
    parser = argparse.ArgumentParser(prog="script/bench", description="Measures how fast MeshForge is.")
    parser.add_argument("parts", nargs="*", metavar="PART", help=f"of {', '.join(PARTS)}; all where none is named")
    parser.add_argument("--quick", action="store_true", help="few files, one round: to see that it works")
    parser.add_argument("--out", type=Path, default=RESULTS, help="the folder of the results")
    options = parser.parse_args(arguments)
    if unknown := [part for part in options.parts if part not in PARTS]:
        parser.error(f"there is no part {unknown[0]!r}, only {', '.join(PARTS)}")
    for part in options.parts or PARTS:
        result = run(part, options.quick)
        _write(options.out, result, options.quick)
        print(as_text(result), flush=True)
    return 0


def run(part: str, quick: bool = False) -> Result:
    """The result of one part."""
    result = import_module(f"benchmark.speed.{part}").measure(_tell, quick)
    _tell("")
    assert isinstance(result, Result)
    return result


def _tell(line: str) -> None:
    print(f"\r\033[K{line}" if sys.stderr.isatty() else line, end="" if sys.stderr.isatty() else "\n", file=sys.stderr)


def _write(out: Path, result: Result, quick: bool) -> None:
    """Write one result, and the page of all results there are."""
    out.mkdir(parents=True, exist_ok=True)
    data = {"machine": machine(), "quick": quick, **result.to_json()}
    write_atomically(out / f"speed-{result.part}.json", json.dumps(data, indent=1, ensure_ascii=False) + "\n")
    files = [out / f"speed-{part}.json" for part in PARTS]
    write_atomically(out / PAGE, page([json.loads(f.read_text("utf-8")) for f in files if f.is_file()]))


def page(results: list[dict[str, object]]) -> str:
    """The page on some results."""
    facts = results[-1]["machine"]
    assert isinstance(facts, dict)
    head = "# Speed\n\nWritten by `script/bench` from the JSON files beside it. Medians; contestants take turns.\n"
    listed = "Machine: " + ", ".join(f"{name} {value}" for name, value in facts.items()) + ".\n"
    quick = "**A quick run: few files, one round.**\n" if any(result["quick"] for result in results) else ""
    return "\n".join(filter(None, [head, listed, quick, *(as_text(Result.of_json(result)) for result in results)]))


if __name__ == "__main__":
    sys.exit(main())
