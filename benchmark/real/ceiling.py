"""How unedited meshes, edits of the reference and wrong edits fare, family by family and setting by setting."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from benchmark.assets import Sample
from benchmark.assets.pictures import upright
from benchmark.real.samples import choose_samples, is_pure
from benchmark.real.tasks import real_tasks, tasks_of
from benchmark.tasks import EditResult, Task
from benchmark.tasks.mutants import judge_mutants_on
from meshforge.rendering import draw_before_after, make_contact_sheet, write_png

MOST = 0.1
"""Of the meshes that a mutant edits otherwise than the reference, so many may pass."""
Row = dict[str, Any]


def judge_family(name: str) -> Iterator[Row]:
    """A row for each mesh of each task of a family."""
    for task, setting, samples in real_tasks([name]):
        for sample in samples:
            yield {"task": task.name, "setting": setting, **judge_sample(task, sample)}


def judge_sample(task: Task, sample: Sample) -> Row:
    """Why a mesh fails by a task's criterion: unedited, by the reference, by the wrong program; None: it does not."""
    edits = {
        "unedited": EditResult(sample.mesh),
        "reference": task.run(task.program, sample.mesh),
        "wrong": task.run(task.wrong, sample.mesh),
    }
    why = {about: task.failure(sample, edited) for about, edited in edits.items()}
    hulls = len(sample.mesh.hulls)
    return {"mesh": sample.name, "asset": sample.asset.name, "hulls": hulls, "pure": is_pure(task, sample), **why}


def describe_rows(rows: Sequence[Row]) -> Iterator[str]:
    """How the meshes of each task fare at each setting, and what fails under the reference."""
    for key in dict.fromkeys((row["task"], row["setting"]) for row in rows):
        mine = [row for row in rows if (row["task"], row["setting"]) == key]
        pure = [row for row in mine if row["pure"]]
        passed = {about: sum(row[about] is None for row in mine) for about in ("unedited", "reference", "wrong")}
        told = ", ".join(f"{about} {count}" for about, count in passed.items())
        good = sum(row["reference"] is None for row in pure)
        yield f"{key[0]} {key[1]}: of {len(mine)} pass: {told}; reference, pure: {good} of {len(pure)}"
        for row in mine:
            if row["reference"]:
                yield f"    {row['mesh']}{'' if row['pure'] else ' (merged)'}: {row['reference']}"


def judge_mutants_of(name: str, task: Task) -> list[Row]:
    """The mutants of a task of a family, on its assets as they come, else fine."""
    samples = choose_samples(name)
    return judge_mutants_on(task, samples, [sample.mesh for sample in samples])


def describe_mutants(name: str) -> Iterator[str]:
    """How many mutants of each task pass on more than a tenth of the meshes that they edit otherwise."""
    for task in tasks_of(name):
        rows = [row for row in judge_mutants_of(name, task) if row["differs"]]
        passing = [row for row in rows if len(row["pass"]) > MOST * row["differs"]]
        yield f"{task.name}: {len(passing)} of {len(rows)} mutants pass on more than a tenth of the meshes"
        for row in passing:
            told = f"{len(row['pass'])} of {row['differs']}, such as {', '.join(row['pass'][:3])}"
            yield f"    {row['mutant']}: {told}{' (equivalent)' if row['reason'] else ''}"


def draw_edits(task: Task, samples: Sequence[Sample], path: Path, side: int = 260, columns: int = 3) -> None:
    """Write a sheet: each mesh before and after the reference program."""
    images, titles = [], []
    for sample in samples:
        after = task.run(task.program, sample.mesh).mesh
        pair = (upright(sample), upright(sample, after))
        images.append(draw_before_after(*pair, size=(side, side), vocabulary=tuple(task.program.labels)))
        titles.append(sample.name if after else f"{sample.name}: the reference fails")
    path.parent.mkdir(parents=True, exist_ok=True)
    write_png(path, make_contact_sheet(images, columns, titles))
