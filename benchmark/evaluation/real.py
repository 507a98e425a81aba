"""The real track, before anything is learned: its families, and how the reference fares on meshes as they come and
decomposed; and the tasks that sessions are run on."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from benchmark.assets import Sample
from benchmark.assets.pictures import upright
from benchmark.evaluation.real_sessions import find_goals, teach_families, tell_families, tell_settings
from benchmark.journal import run_units
from benchmark.real.ceiling import MOST, Row, judge_mutants_of, judge_sample
from benchmark.real.family import families, family
from benchmark.real.samples import ALL_SETTINGS, AS_IS, choose_samples, family_samples, why_absent
from benchmark.real.tasks import real_task, tasks_of
from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.speed.assets import corpus
from benchmark.tasks import Task
from meshforge.common import AssetError
from meshforge.rendering import draw_before_after, make_contact_sheet, write_png
from meshforge.symbolic import SymbolicMesh

_COLUMNS = (
    "task",
    "setting",
    "meshes",
    "hulls",
    "merged, %",
    "unedited: fail, %",
    "wrong edit: fail, %",
    "reference: pass, pure, %",
    "the others, %",
    "all, %",
)
_MUTANT_COLUMNS = ("task", "mutants that differ", "pass on more than a tenth", "which", "do the same job, and why")
_SIZE, _COLUMNS_OF_PICTURES = (240, 190), 4


def measure(tell: Tell, quick: bool) -> Result:
    """Judge all meshes of all families. Raises AssetError where the corpus is not here: then the part is left out."""
    if corpus() is None:
        raise AssetError("not run: no corpus is here", where="real", remedy="Set MESHFORGE_CORPUS to its folder.")
    names, settings = (families()[-1:], (AS_IS,)) if quick else (families(), ALL_SETTINGS)
    units = [(name, task.difficulty, setting) for name in names for task in tasks_of(name) for setting in settings]
    found = dict(zip(units, run_units("real", judge_meshes, units, tell), strict=True))
    tried = [(name, task.difficulty) for name in names for task in tasks_of(name)[: 1 if quick else None]]
    mutants = dict(zip(tried, run_units("real-mutants", judge_real_mutants, tried, tell), strict=True))
    taught = teach_families(names, settings, tell, quick)
    return Result(
        "real",
        "Real assets",
        (
            Table("Families", ("family", "assets", "licences", "labels"), tuple(map(_describe_family, names))),
            Table(
                "The reference on real assets", _COLUMNS, tuple(_row(*key, rows) for key, rows in found.items() if rows)
            ),
            Table("Assets without a mesh as they come", ("family", "asset", "why"), tuple(_list_absent(names))),
            Table("Mutants of the reference on real assets", _MUTANT_COLUMNS, tuple(_tell_mutants(mutants))),
            tell_families(taught),
            tell_settings(taught),
        ),
        (
            *find_goals(taught),
            Goal(
                "mutants that pass on more than a tenth of the meshes",
                "at most",
                0.0,
                float(sum(len(_list_passing(rows)) for rows in mutants.values())),
            ),
        ),
        (
            "Of each asset regions of the surface were labelled by hand, from pictures, and looked at twice; labels of "
            "hulls follow from the share of their volume. *As is*: the collision geometry of the file; *coarse*, "
            "*medium*, *fine*: CoACD on what each body shows. *Merged*: a hull that the rules are about belongs to "
            "several parts (purity below 0.9), or a part of theirs has no hull of its own; *pure*: the others. "
            "Nothing was tuned on these assets, and none is left out because it fails.",
            "*Mutants* of the reference are judged on each asset as it comes, else fine.",
            "A demonstrator for each decomposition teaches each task, under each condition, where a family has at "
            "least eight meshes at it; labels and people are those of RQ1.",
        ),
        (*(row for rows in found.values() for row in rows), *(row.summarize() for row in taught)),
    )


def judge_meshes(name: str, difficulty: str, setting: str) -> list[Row]:
    """Why each mesh of a family at one setting fails by a task: unedited, by the reference, by the wrong program."""
    task = real_task(name, difficulty)
    return [
        {"task": task.name, "setting": setting, **judge_sample(task, sample)}
        for sample in family_samples(name, setting)
    ]


def judge_real_mutants(name: str, difficulty: str) -> list[Row]:
    """The mutants of a task, on assets as they come, else fine."""
    return judge_mutants_of(name, real_task(name, difficulty))


def _tell_mutants(found: Mapping[tuple[str, str], list[Row]]) -> Iterator[tuple[Cell, ...]]:
    for (name, difficulty), rows in found.items():
        differ = [row for row in rows if row["differs"]]
        told = ", ".join(f"`{row['mutant']}`" for row in _list_passing(rows)) or "–"
        alike = "; ".join(f"`{row['mutant']}`: {row['reason']}" for row in differ if row["reason"]) or "–"
        yield f"{name}-{difficulty}", len(differ), len(_list_passing(rows)), told, alike


def _list_passing(rows: Sequence[Row]) -> list[Row]:
    """The mutants that pass on more than a tenth of the meshes that they edit otherwise, but for those that do the same
    job."""
    return [row for row in rows if row["differs"] and not row["reason"] and len(row["pass"]) > MOST * row["differs"]]


def draw_pictures(names: Sequence[str], folder: Path) -> None:
    """Write a sheet for each family: its assets before and after the reference's edit of the hard task."""
    for name in names:
        task, path = real_task(name, "hard"), folder / f"real-{name}.png"
        pairs = [(sample, _edit(task, sample)) for sample in choose_samples(name)]
        images = [
            draw_before_after(upright(sample), after or upright(sample), size=_SIZE, vocabulary=task.program.labels)
            for sample, after in pairs
        ]
        titles = [sample.name if after else f"{sample.name}: the reference fails" for sample, after in pairs]
        folder.mkdir(parents=True, exist_ok=True)
        write_png(path, make_contact_sheet(images, _COLUMNS_OF_PICTURES, titles))


def _edit(task: Task, sample: Sample) -> SymbolicMesh | None:
    """What the reference makes of a mesh, upright; None where it fails."""
    after = task.run(task.program, sample.mesh).mesh
    return upright(sample, after) if after else None


def _describe_family(name: str) -> tuple[Cell, ...]:
    one = family(name)
    licences = sorted({source.licence.split(" (")[0] for source in one.sources})
    return name, len(one.sources), ", ".join(licences), ", ".join(one.vocabulary)


def _row(name: str, difficulty: str, setting: str, rows: Sequence[Row]) -> tuple[Cell, ...]:
    pure, merged = [row for row in rows if row["pure"]], [row for row in rows if not row["pure"]]
    return (
        f"{name}-{difficulty}",
        setting.replace("_", " "),
        len(rows),
        sum(row["hulls"] for row in rows),
        100 * len(merged) / len(rows),
        *(100 - _share_passed(rows, about) for about in ("unedited", "wrong")),
        *(_share_passed(part, "reference") if part else "–" for part in (pure, merged, rows)),
    )


def _share_passed(rows: Sequence[Row], about: str) -> float:
    return 100 * sum(row[about] is None for row in rows) / len(rows)


def _list_absent(names: Sequence[str]) -> Iterator[tuple[Cell, ...]]:
    for name in names:
        for source in family(name).sources:
            if why := why_absent(source):
                yield name, source.name, why
