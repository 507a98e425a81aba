"""Labels of a few assets carried to all others, and which asset would help most if it were labelled next."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, lru_cache

import numpy as np

from meshforge.geometry import Floats
from meshforge.perception.propagation.advice import chosen
from meshforge.perception.propagation.agreement import agreeing
from meshforge.perception.propagation.family import Family, family_of
from meshforge.perception.propagation.likeness import by_likeness
from meshforge.perception.propagation.metric import weights
from meshforge.perception.propagation.righting import doubtful_sides, righted
from meshforge.perception.propagation.sketch import Sketcher
from meshforge.perception.propagation.ties import first_greatest
from meshforge.symbolic import GIVEN_SOURCES, HUMAN_SOURCES, Label, SymbolicMesh
from meshforge.views.coloring import UNSURE

_DIGITS = 3
_REMEMBERED = 2000  # meshes whose other sides are not described again


@dataclass(frozen=True, eq=False)
class Propagated:
    """What some labels say about all hulls. chances: (hulls of all meshes, labels of the family)."""

    family: Family
    chances: Floats

    def labels(self, mesh: int) -> list[Label | None]:
        """The likeliest label of each hull of a mesh, with its chance; None where no label is known at all."""
        rows = self.chances[slice(*np.searchsorted(self.family.owner, (mesh, mesh + 1)))]
        if not self.family.labels:
            return [None] * len(rows)
        found = zip(first_greatest(rows).tolist(), rows, strict=True)
        return [
            Label(self.family.labels[place], round(float(row[place]), _DIGITS), "propagated") for place, row in found
        ]

    def next_to_label(self, count: int = 1) -> list[int]:
        """The meshes to label next, the most helpful first; none on which every hull is told already."""
        return chosen(self.family, self.chances, count)


class Relatives:
    """Meshes of one kind, described once; labels may then be told again and again."""

    def __init__(self, meshes: Sequence[SymbolicMesh]) -> None:
        sketches = [Sketcher(mesh).describe() for mesh in meshes]
        self.family = family_of([(sketch.rows, sketch.touching) for sketch in sketches])
        self._sides = [sketch.sides for sketch in sketches]
        self._closely = lru_cache(_REMEMBERED)(lambda mesh: cache(Sketcher(meshes[mesh]).describe_side))

    def propagate(self, told: Sequence[str | None], metric: Floats | None = None) -> Propagated:
        """What some labels say about all hulls, these included.

        told: of each hull of all meshes, None where its label is not known; metric: the weight of each column of a
        description, None for the one that ships.
        """
        metric = weights() if metric is None else metric
        family = self.family.with_labels(told)
        doubtful = doubtful_sides(family, self._sides.__getitem__, metric)
        looked = ((mesh, [self._closely(mesh)(side) for side in sides]) for mesh, sides in doubtful)
        return compared_hulls(righted(family, looked, metric), metric)


def compared_hulls(family: Family, metric: Floats | None = None) -> Propagated:
    """What the labels that are told say about all hulls of a family whose meshes stand upright."""
    if not family.labels:
        return Propagated(family, np.zeros((len(family.codes), 0)))
    return Propagated(family, agreeing(family, by_likeness(family, weights() if metric is None else metric)))


def propagate(meshes: Sequence[SymbolicMesh]) -> Propagated:
    """What the labels that people gave, or that came in files, say about all hulls of a family, these included.

    The same family in the same order gives the same, bit for bit, on any processor. Meshes may lie anyhow about the
    upright axis of their files, at any size and place, tilted by up to some 40 degrees, or on their side.
    """
    return Relatives(meshes).propagate([given_label(hull.annotation) for mesh in meshes for hull in mesh.hulls])


def given_label(label: Label | None) -> str | None:
    """The label that others may be taken from: one that a person gave, or that came in a file and is not unsure."""
    if label is None or label.source not in GIVEN_SOURCES:
        return None
    return label.name if label.source in HUMAN_SOURCES or label.confidence >= UNSURE else None
