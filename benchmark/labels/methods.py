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
from meshforge.labels.names.label_by_names import HullNames, match_names
from meshforge.symbolic import Label, SymbolicMesh
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
    labelled = family.labels_of(family.advised[:count])
    started = perf_counter()
    found = family.relatives.infer(labelled)
    seconds = perf_counter() - started
    return LabellerOutput(tuple(tuple(map(_name, found.labels(place))) for place in family.drawn), seconds)


def _label_by_names(family: Family, repeat: int) -> LabellerOutput:
    started = perf_counter()
    labels = tuple(_by_names(family.bare[place], family.vocabulary) for place in family.drawn)
    return LabellerOutput(labels, perf_counter() - started)


def _by_names(mesh: SymbolicMesh, vocabulary: Sequence[str]) -> Labels:
    said = (match_names(HullNames(hull.name, hull.body), vocabulary) for hull in mesh.hulls)
    return tuple(one.label if one else None for one in said)


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


def _name(label: Label | None) -> str | None:
    return label.name if label else None
