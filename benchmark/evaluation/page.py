"""Writes `benchmark/README.md`, its plots and its pictures from the results."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from benchmark.evaluation.changes import tell_changes
from benchmark.evaluation.pictures import draw, list_pictures
from benchmark.evaluation.plots import plots
from benchmark.journal import is_of_protocol
from benchmark.report import Result, Table, as_text, format_table
from meshforge.common import write_atomically

_INTRO = """# The benchmark

24 tasks on 600 different collision meshes: eight categories of 25 generated assets, each decomposed by CoACD at
three settings; the same assets decomposed as a whole, so that hulls span parts; and families of real assets. A task
is a program that a person has in mind, demonstrations from which the tool must learn it, and a criterion that the
edited meshes must meet, measured by physics in MuJoCo where it is physical. `script/bench` writes this page from
the JSON files in [results](results), which hold every run.
"""
_HOW = """
- `script/bench evaluation` measures the figures of this page again (any part by name; `--quick`: one category, one
  demonstrator); an interrupted run continues where it was. Except for times, the results are the same, bit for bit.
  `script/bench`, all pages, took 85 minutes on the machine below (two cores), from nothing but the frozen meshes.
- `script/make-benchmark` makes the meshes and the calibration set again ([assets](assets)). The tasks are folders
  in [tasks](tasks), readable in a minute; criteria are in [criteria](criteria), the simulated people in
  [study](study), the real families in [real](real).
- Who teaches a task does so in a project on a disk, by the methods of `meshforge.Project`: labels, demonstrations,
  learning, answers, repairs and verdicts. Results are judged on the meshes in memory, which have the same hulls.
- [The gallery](gallery/index.html) shows each task before and after, rule by rule.

![Each task before and after](pictures/tasks.png)
"""
_CAPTIONS = {
    "effectiveness": "SSR against demonstrations plus answers; time by phase",
    "ablation": "SSR by layers",
    "scaling": "Seconds against meshes, hulls a mesh and labels",
}


def write(folder: Path, found: Sequence[Mapping[str, Any]], parts: Sequence[str], part: str | None = None) -> None:
    """The page, in a folder, from what the JSON files of its parts hold.

    parts: all that a whole run has; part: the one that was run just now, whose pictures are drawn; None: draw all.
    """
    results = {data["part"]: Result.of_json(data) for data in found}
    quick = any(data["quick"] for data in found)
    drawn = plots(results, folder / "pictures")
    draw(folder / "pictures", results, quick, part)
    table, removed = tell_changes(results)
    lines = [_INTRO, *_tell_missing(found, parts, results), "## What was changed since the first edition\n"]
    lines += [format_table(table), f"{removed}\n", "## How it is measured", _HOW]
    machine = ", ".join(f"{name} {value}" for name, value in found[-1]["machine"].items())
    lines += [f"Machine: {machine}.\n", *(["**A quick run: one category, one seed.**\n"] if quick else [])]
    for name, result in results.items():
        lines += [as_text(result), f"`script/bench {name}` measures this.\n"]
        if name in drawn:
            lines.append(f"![{_CAPTIONS[name]}](pictures/{drawn[name]})\n")
        lines += [f"![{told}](pictures/{file})\n" for file, told in list_pictures(name, result)]
    write_atomically(folder / "README.md", "\n".join(lines))


def _tell_missing(
    found: Sequence[Mapping[str, Any]], parts: Sequence[str], results: Mapping[str, Result]
) -> Iterator[str]:
    """What was not run, or on other meshes, tasks or criteria than today's."""
    if missing := [part for part in parts if part not in results]:
        yield f"**Not run yet: `script/bench {' '.join(missing)}`.**\n"
    if earlier := [f"`{data['part']}`" for data in found if not is_of_protocol(data["part"], data.get("protocol"))]:
        yield f"**Measured before the last change of meshes, tasks or criteria: {', '.join(earlier)}.**\n"
    absent = [str(row[0]) for table in _list_tables(results) for row in table.rows if "not run" in map(str, row[1:])]
    if absent:
        yield f"**Not run: {', '.join(dict.fromkeys(absent))}.**\n"


def _list_tables(results: Mapping[str, Result]) -> list[Table]:
    return [table for result in results.values() for table in result.tables]
