"""The real track, before anything is learned: its families, and how the reference fares on meshes as they come and
decomposed; and the tasks that sessions are run on."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

from benchmark.assets import Sample
from benchmark.assets.pictures import upright
from benchmark.journal import run_units
from benchmark.real.ceiling import Row, judge_sample
from benchmark.real.family import families, family
from benchmark.real.samples import ALL_SETTINGS, AS_IS, family_samples, why_absent
from benchmark.real.tasks import real_task, real_tasks, tasks_of
from benchmark.report import Cell, Result, Table, Tell
from benchmark.speed.assets import corpus
from benchmark.tasks import Task
from meshforge.common import AssetError
from meshforge.rendering import draw_before_after, make_contact_sheet, write_png

__all__ = ["draw_pictures", "measure", "real_tasks"]

PICTURES = Path(__file__).resolve().parents[1] / "pictures"
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
_SIZE, _COLUMNS_OF_PICTURES = (240, 190), 4


def measure(tell: Tell, quick: bool) -> Result:
    """Judge all meshes of all families. Raises AssetError where the corpus is not here: then the part is left out."""
    if corpus() is None:
        raise AssetError("not run: no corpus is here", where="real", remedy="Set MESHFORGE_CORPUS to its folder.")
    names = families()[:1] if quick else families()
    units = [(name, task.difficulty, setting) for name in names for task in tasks_of(name) for setting in ALL_SETTINGS]
    found = dict(zip(units, run_units("real", judge_meshes, units, tell), strict=True))
    return Result(
        "real",
        "Real assets",
        (
            Table("Families", ("family", "assets", "licences", "labels"), tuple(map(_describe_family, names))),
            Table(
                "The reference on real assets", _COLUMNS, tuple(_row(*key, rows) for key, rows in found.items() if rows)
            ),
            Table("Assets without a mesh as they come", ("family", "asset", "why"), tuple(_list_absent(names))),
        ),
        (),
        (
            "Of each asset regions of the surface were labelled by hand, from pictures, and looked at twice; labels of "
            "hulls follow from the share of their volume. *As is*: the collision geometry of the file; *coarse*, "
            "*medium*, *fine*: CoACD on what each body shows. *Merged*: a hull that the rules are about belongs to "
            "several parts (purity below 0.9), or a part of theirs has no hull of its own; *pure*: the others. "
            "Nothing was tuned on these assets, and none is left out because it fails.",
        ),
        tuple(row for rows in found.values() for row in rows),
    )


def judge_meshes(name: str, difficulty: str, setting: str) -> list[Row]:
    """Why each mesh of a family at one setting fails by a task: unedited, by the reference, by the wrong program."""
    task = real_task(name, difficulty)
    return [
        {"task": task.name, "setting": setting, **judge_sample(task, sample)}
        for sample in family_samples(name, setting)
    ]


def draw_pictures(folder: Path = PICTURES) -> list[Path]:
    """Write a sheet for each family: its assets before and after the reference's edit of the hard task."""
    paths = []
    for name in families():
        task, path = real_task(name, "hard"), folder / f"real-{name}.png"
        pairs = [(sample, after) for sample in _one_each(name) if (after := _edit(task, sample))]
        images = [
            draw_before_after(upright(sample), after, size=_SIZE, vocabulary=task.program.labels)
            for sample, after in pairs
        ]
        folder.mkdir(parents=True, exist_ok=True)
        write_png(path, make_contact_sheet(images, _COLUMNS_OF_PICTURES, [sample.name for sample, _ in pairs]))
        paths.append(path)
    return paths


def _one_each(name: str) -> Iterable[Sample]:
    """A mesh of each asset of a family: as it comes, else the fine one."""
    chosen = {s.asset.name: s for setting in ("fine", AS_IS) for s in family_samples(name, setting)}
    return [chosen[asset] for asset in family(name).names if asset in chosen]


def _edit(task: Task, sample: Sample) -> Any:
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
