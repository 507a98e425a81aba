"""Labellers, each as something that says labels for the drawn meshes of a family."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from time import perf_counter

from benchmark.labels.families import LABELLED, Family
from meshforge.common import UsageError
from meshforge.symbolic.label_file import read_labels

REPEATS = 5
Labels = tuple[str | None, ...]
"""What a labeller says of each hull of a mesh."""


@dataclass(frozen=True, slots=True)
class LabellerOutput:
    """What a labeller says of the drawn meshes of a family, in their order; seconds: for all of them.

    cost: what was paid for it, however long ago [$], None where nothing is known of prices; missing: meshes that it
    could not be asked about whole, and why: the first reason.
    """

    labels: tuple[Labels, ...]
    seconds: float = 0.0
    cost: float | None = 0.0
    missing: int = 0
    why: str = ""


@dataclass(frozen=True, slots=True)
class Method:
    """A labeller. tell: what it says of a family, the same question asked again for each repeat, counted from 0.

    repeats: how often it is asked.
    """

    name: str
    tell: Callable[[Family, int], LabellerOutput] = field(repr=False)
    repeats: int = REPEATS


def offline(folders: Sequence[Path]) -> list[Method]:
    """The labellers that ask nobody, and labels that something else wrote into folders."""
    return [
        *(Method(f"propagation, {count} labelled", partial(_propagate, count)) for count in range(1, LABELLED + 1)),
        Method("names", _label_by_names),
        Method("majority, 1 labelled", _commonest),
        *(Method(f"labels of {folder.name}", partial(_label_by_files, folder), repeats=1) for folder in folders),
    ]


def _propagate(count: int, family: Family, repeat: int) -> LabellerOutput:
    family.project.label(family.advised[:count])
    _, seconds = family.project.propagate()
    return LabellerOutput(_read_drawn(family), seconds)


def _label_by_names(family: Family, repeat: int) -> LabellerOutput:
    family.project.clear()
    started = perf_counter()
    family.project.label_by_names()
    seconds = perf_counter() - started
    return LabellerOutput(_read_drawn(family), seconds)


def _read_drawn(family: Family) -> tuple[Labels, ...]:
    """The labels of the drawn meshes in the project."""
    rows = family.project.read_labels()
    return tuple(tuple(label.name if label else None for label in rows[place]) for place in family.drawn)


def _commonest(family: Family, repeat: int) -> LabellerOutput:
    started = perf_counter()
    counts = Counter(hull.label for hull in family.samples[family.advised[0]].mesh.hulls)
    label = max(counts, key=lambda name: (counts[name], name or ""))
    labels = tuple((label,) * len(family.bare[place].hulls) for place in family.drawn)
    return LabellerOutput(labels, perf_counter() - started)


def _label_by_files(folder: Path, family: Family, repeat: int) -> LabellerOutput:
    """Labels from MESH.labels.json, in the folder or below it; a mesh without a file has none."""
    found = {path.name.removesuffix(".labels.json"): path for path in sorted(folder.rglob("*.labels.json"))}
    if not found:
        raise UsageError("there is no labels file, MESH.labels.json", where=str(folder))
    rows = list[Labels]()
    for place in family.drawn:
        path, mesh = found.get(family.samples[place].name), family.bare[place]
        known = read_labels(path).labels if path else {}
        by_hull = {name.rpartition("/")[2]: label.name for name, label in known.items()}
        rows.append(tuple(by_hull.get(hull.name) for hull in mesh.hulls))
    return LabellerOutput(tuple(rows), cost=None)
