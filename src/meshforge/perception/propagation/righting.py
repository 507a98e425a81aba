"""Meshes that lie on their side, set upright: as they lie, their hulls are most like those that are labelled."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from scipy.spatial.distance import cdist

from meshforge.geometry import Floats
from meshforge.perception.propagation.describe import described
from meshforge.perception.propagation.family import UNTOLD, Family, evenly
from meshforge.perception.propagation.upright import other_sides, upright
from meshforge.symbolic import SymbolicMesh

_SIDES = 5  # on which a mesh may lie, besides the one it seems to lie on
_BETTER = 0.9  # of the distance as it seems to lie, under which another side must be
_TAUGHT_BY = 3000  # hulls at most, evenly chosen


def righted(family: Family, ways: Callable[[int], Sequence[Floats]], metric: Floats) -> Family:
    """The family with those meshes turned whose hulls are then clearly more like the hulls whose label is told.

    Looked at are meshes no hull of which is told, the half of them that is less like those than the other half.
    ways: `other_ways` of the mesh of that number; metric: as of `by_likeness`.
    """
    ends = np.searchsorted(family.owner, np.arange(family.owner.max(initial=-1) + 1), side="right").tolist()
    spans = [slice(start, end) for start, end in zip([0, *ends], ends, strict=False)]
    asked = [k for k, span in enumerate(spans) if span.start < span.stop and (family.codes[span] == UNTOLD).all()]
    if not asked or not len(family.told):
        return family
    taught = family.rows[evenly(family.told, _TAUGHT_BY)] * metric

    def apart(rows: Floats) -> float:
        """How far hulls are from those that are told, on the average."""
        return round(float(cdist(rows * metric, taught, "cityblock").min(axis=1).mean()), 9)

    distances = [apart(family.rows[spans[k]]) for k in asked]
    typical = float(np.median(distances))
    rows = family.rows.copy()
    for k, distance in zip(asked, distances, strict=True):
        if distance >= typical:
            best = min(map(family.scale, ways(k)), key=apart, default=rows[spans[k]])
            rows[spans[k]] = best if apart(best) < _BETTER * distance else rows[spans[k]]
    return replace(family, rows=rows)


def other_ways(mesh: SymbolicMesh) -> list[Floats]:
    """Its hulls described as they are if the mesh lies on another side than it seems to."""
    return [described(mesh, up) for up in other_sides(mesh, upright(mesh), _SIDES)]
