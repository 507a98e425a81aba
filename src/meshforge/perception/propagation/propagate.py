"""Labels of a few assets carried to all others, and which asset would help most if it were labelled next."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from meshforge.geometry import Floats
from meshforge.perception.propagation.advice import chosen
from meshforge.perception.propagation.agreement import agreeing
from meshforge.perception.propagation.family import Family, family_of
from meshforge.perception.propagation.likeness import by_likeness
from meshforge.perception.propagation.metric import weights
from meshforge.perception.propagation.righting import other_ways, righted
from meshforge.symbolic import GIVEN_SOURCES, Label, SymbolicMesh

_DIGITS = 3


@dataclass(frozen=True, eq=False)
class Propagated:
    """What some labels say about all hulls. chances: (hulls of all meshes, labels of the family)."""

    family: Family
    chances: Floats

    def labels(self, mesh: int) -> list[Label | None]:
        """The likeliest label of each hull of a mesh, with its chance; None where no label is known at all."""
        rows = self.chances[self.family.owner == mesh]
        if not self.family.labels:
            return [None] * len(rows)
        found = zip(rows.argmax(axis=1).tolist(), rows, strict=True)
        return [
            Label(self.family.labels[place], round(float(row[place]), _DIGITS), "propagated") for place, row in found
        ]

    def next_to_label(self, count: int = 1) -> list[int]:
        """The meshes to label next, the most helpful first; none on which every hull is told already."""
        return chosen(self.family, count)


def propagate(meshes: Sequence[SymbolicMesh]) -> Propagated:
    """What the labels that people gave, or that came in files, say about all hulls of a family, these included.

    The same family in the same order gives the same, bit for bit. Meshes may lie anyhow about the upright axis of
    their files, at any size and place, tilted by up to some 40 degrees, or on their side.
    """
    family = family_of(meshes, [[_told(hull.annotation) for hull in mesh.hulls] for mesh in meshes])
    if not family.labels:
        return Propagated(family, np.zeros((len(family.codes), 0)))
    family = righted(family, lambda mesh: other_ways(meshes[mesh]), weights())
    return Propagated(family, agreeing(family, by_likeness(family, weights())))


def _told(label: Label | None) -> str | None:
    return label.name if label and label.source in GIVEN_SOURCES else None
