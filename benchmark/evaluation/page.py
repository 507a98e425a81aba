"""Writes `benchmark/README.md`, its plots and its pictures from the results."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from benchmark.assets import MERGED
from benchmark.assets.pictures import upright
from benchmark.evaluation import failures, mutation
from benchmark.evaluation.changes import tell_changes
from benchmark.evaluation.gallery import overview
from benchmark.evaluation.plots import plots
from benchmark.evaluation.sessions import QUICK
from benchmark.journal import digest_protocol
from benchmark.report import Result, Table, as_text, format_table
from benchmark.study import Session
from benchmark.tasks import task, tasks
from meshforge.common import write_atomically
from meshforge.rendering import draw_before_after, make_contact_sheet, write_png

if TYPE_CHECKING:
    from PIL.Image import Image

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
- `script/make-benchmark` makes the meshes and the calibration set again ([assets](assets)). The tasks are folders
  in [tasks](tasks), readable in a minute; criteria are in [criteria](criteria), the simulated people in
  [study](study), the real families in [real](real).
- [The gallery](gallery/index.html) shows each task before and after, rule by rule.

![Each task before and after](pictures/tasks.png)
"""
_CAPTIONS = {
    "effectiveness": "SSR against demonstrations plus answers; time by phase",
    "ablation": "SSR by layers",
    "scaling": "Seconds against meshes, hulls a mesh and labels",
}


def write(folder: Path, found: Sequence[Mapping[str, Any]], parts: Sequence[str]) -> None:
    """The page, in a folder, from what the JSON files of its parts hold; parts: all that a whole run has."""
    results = {data["part"]: Result.of_json(data) for data in found}
    quick = any(data["quick"] for data in found)
    drawn = plots(results, folder / "pictures")
    pictures(folder / "pictures", results, quick)
    table, removed = tell_changes(results)
    lines = [_INTRO, *_tell_missing(found, parts, results), "## What was changed since the first edition\n"]
    lines += [format_table(table), f"{removed}\n", "## How it is measured", _HOW]
    machine = ", ".join(f"{name} {value}" for name, value in found[-1]["machine"].items())
    lines += [f"Machine: {machine}.\n", *(["**A quick run: one category, one seed.**\n"] if quick else [])]
    for part, result in results.items():
        lines += [as_text(result), f"`script/bench {part}` measures this.\n"]
        if part in drawn:
            lines.append(f"![{_CAPTIONS[part]}](pictures/{drawn[part]})\n")
        if part == "effectiveness" and any(not row["right"] for row in result.details):
            told = "Sessions that ended with another behaviour: before, as learned, as intended"
            lines.append(f"![{told}](pictures/sessions.png)\n")
        if part == "mutation" and any(row["reason"] for row in result.details):
            lines.append("![Mutants that do the same job](pictures/mutants.png)\n")
        if part == "ceiling" and _choose_failures(result):
            lines.append("![What fails under the reference program: before, after](pictures/failures.png)\n")
    write_atomically(folder / "README.md", "\n".join(lines))


def _tell_missing(
    found: Sequence[Mapping[str, Any]], parts: Sequence[str], results: Mapping[str, Result]
) -> Iterator[str]:
    """What was not run, or on other meshes, tasks or criteria than today's."""
    if missing := [part for part in parts if part not in results]:
        yield f"**Not run yet: `script/bench {' '.join(missing)}`.**\n"
    if earlier := [f"`{data['part']}`" for data in found if data.get("protocol") != digest_protocol()]:
        yield f"**Measured before the last change of meshes, tasks or criteria: {', '.join(earlier)}.**\n"
    absent = [str(row[0]) for table in _list_tables(results) for row in table.rows if "not run" in map(str, row[1:])]
    if absent:
        yield f"**Not run: {', '.join(dict.fromkeys(absent))}.**\n"


def _list_tables(results: Mapping[str, Result]) -> list[Table]:
    return [table for result in results.values() for table in result.tables]


def pictures(folder: Path, results: Mapping[str, Result], quick: bool) -> None:
    """All tasks before and after, and what fails under the reference program."""
    folder.mkdir(parents=True, exist_ok=True)
    every = [one for one in tasks() if not quick or one.category == QUICK]
    shown = [
        draw_before_after(upright(sample), after, size=(200, 160), vocabulary=task(name).program.labels)
        for name, sample, after in overview(every)
    ]
    write_png(folder / "tasks.png", make_contact_sheet(shown, 3, [one.name for one in every]))
    ended = [Session.of_json(row) for row in results["effectiveness"].details] if "effectiveness" in results else []
    if otherwise := list(failures.pictures(ended)):
        captions, images = zip(*otherwise, strict=True)
        write_png(folder / "sessions.png", make_contact_sheet(images, 2, captions))
    if "mutation" in results and (alike := list(mutation.pictures(results["mutation"].details))):
        captions, images = zip(*alike, strict=True)
        write_png(folder / "mutants.png", make_contact_sheet(images, 2, captions))
    meshes = _choose_failures(results["ceiling"]) if "ceiling" in results else []
    if meshes:
        write_png(
            folder / "failures.png",
            make_contact_sheet([_draw_failure(*row) for row in meshes], 2, [f"{a}, {b}" for a, b in meshes]),
        )


def _choose_failures(result: Result) -> Sequence[tuple[str, str]]:
    """Task and mesh of what fails: pure ones, and of each task's impure ones the first."""
    rows = [row for row in result.details if row["reference"] is not None and row.get("set") not in MERGED]
    pure = [(row["task"], row["mesh"]) for row in rows if not row["impure"]]
    first = {row["task"]: row["mesh"] for row in reversed(rows) if row["impure"]}
    return [*pure, *first.items()][:12]


def _draw_failure(name: str, mesh: str) -> Image:
    one = task(name)
    sample = next(row for row in one.samples() if row.name == mesh)
    edited = one.run(one.program, sample.mesh)
    after = upright(sample, edited.mesh) if edited.mesh else upright(sample)
    return draw_before_after(upright(sample), after, size=(260, 200), vocabulary=one.program.labels)
