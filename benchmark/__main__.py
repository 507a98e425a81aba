"""Runs parts of the benchmark by name, and writes what they find into the results.

Usage: script/bench [PART ...] [--quick] [--out FOLDER] [--vlm FILE] [--max-cost DOLLARS] [--blender PYTHON] ...
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from importlib import import_module
from pathlib import Path

from benchmark.evaluation.page import write as write_page
from benchmark.journal import digest_protocol
from benchmark.machine import machine
from benchmark.options import RunOptions
from benchmark.pages import PAGES, Page, page_of, parts_of, text_of
from benchmark.progress import Progress
from benchmark.report import Result, as_text, write_lines
from benchmark.signoff.plot import draw_curves
from meshforge.common import AssetError, UsageError, write_atomically

RESULTS = Path(__file__).resolve().parent / "results"
_PICTURES = {"signoff": draw_curves}
"""What draws the pictures of a page from its results, and gives the Markdown that shows them."""


def main(arguments: list[str] | None = None) -> int:
    """Run the parts that are named; where none is, all but those that are for a special occasion."""
    every, pages = [part for page in PAGES for part in page.all_parts], [page.name for page in PAGES]
    parser = argparse.ArgumentParser(prog="script/bench", description="Measures how fast and how well MeshForge does.")
    parser.add_argument(
        "parts",
        nargs="*",
        metavar="PART",
        help=f"of {', '.join(every)}; or a page of them: {', '.join(pages)}; without any, all pages",
    )
    parser.add_argument("--quick", action="store_true", help="few cases, one round: to see that it works")
    parser.add_argument("--out", type=Path, default=RESULTS, help="the folder of the results")
    _add_given(parser)
    options = parser.parse_args(arguments)
    try:
        parts = parts_of(options.parts)
    except KeyError as unknown:
        parser.error(f"there is no part {unknown}, only {', '.join((*pages, *every))}")
    given = RunOptions(options.vlm, options.max_cost, options.blender, options.sample, tuple(options.labels))
    progress = Progress([*parts, repr(vars(options))])
    failed = False
    for part in parts:
        page = page_of(part)
        if len(parts) > 1 and progress.is_done(page.name, part):
            print(f"{part}: done before this run was interrupted", file=sys.stderr)
            continue
        try:
            result = run(page, part, options.quick, given)
        except (UsageError, AssetError) as error:
            _tell("")
            print(error.message, file=sys.stderr)
            failed = True
            continue
        _write(options.out, page, result, options.quick)
        progress.note(page.name, part)
        print(as_text(result), flush=True)
    progress.end()
    return int(failed)


def _add_given(parser: argparse.ArgumentParser) -> None:
    """The options of the parts that ask a model; their defaults are in the environment."""
    vlm = Path(name) if (name := os.environ.get("BENCH_VLM")) else None
    asking = parser.add_argument_group("for comparison and labellers")
    asking.add_argument("--vlm", type=Path, default=vlm, metavar="FILE", help="a TOML file whose table [vlm] says "
                        "which model to ask, as that of a project's meshforge.toml (BENCH_VLM)")  # fmt: skip
    asking.add_argument("--max-cost", type=float, metavar="DOLLARS", help="the most that a baseline or labeller costs")
    asking.add_argument("--blender", type=Path, metavar="PYTHON", help="a Python 3.11 with the dependency "
                        "group blender (BENCH_BLENDER), else that in .bench/blender")  # fmt: skip
    asking.add_argument("--sample", type=int, default=RunOptions().sample, metavar="N", help="meshes that are labelled")
    asking.add_argument("--labels", type=Path, action="append", default=[], metavar="FOLDER",
                        help="labels that something else made: MESH.labels.json for each mesh")  # fmt: skip


def run(page: Page, part: str, quick: bool = False, given: RunOptions | None = None) -> Result:
    """The result of one part."""
    measure = import_module(f"benchmark.{page.name}.{part}").measure
    result = measure(_tell, quick, given or RunOptions()) if part in page.given else measure(_tell, quick)
    _tell("")
    assert isinstance(result, Result)
    return result


def _tell(line: str) -> None:
    print(f"\r\033[K{line}" if sys.stderr.isatty() else line, end="" if sys.stderr.isatty() else "\n", file=sys.stderr)


def _write(out: Path, page: Page, result: Result, quick: bool) -> None:
    """Write one result, and its page anew from all results there are."""
    out.mkdir(parents=True, exist_ok=True)
    of_run = {"machine": machine(page.packages), "quick": quick, "protocol": digest_protocol(result.part)}
    data = {**of_run, **result.to_json()}
    write_atomically(out / f"{page.name}-{result.part}.json", write_lines(data))
    files = [out / f"{page.name}-{part}.json" for part in page.all_parts]
    found = [json.loads(f.read_text("utf-8")) for f in files if f.is_file()]
    if page.name == "evaluation":
        write_page(out.parent if out == RESULTS else out, found, page.parts, result.part)
    else:
        draw = _PICTURES.get(page.name)
        write_atomically(out / f"{page.name}.md", text_of(page, found, draw(out, found) if draw else ""))


if __name__ == "__main__":
    sys.exit(main())
