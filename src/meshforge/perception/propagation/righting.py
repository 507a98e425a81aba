"""Meshes that lie on their side, set upright: as they lie, their hulls are most like those that are labelled."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace

import numpy as np
from scipy.spatial.distance import cdist

from meshforge.geometry import Floats
from meshforge.perception.propagation.describe import SHAPES
from meshforge.perception.propagation.family import UNTOLD, Family, evenly
from meshforge.perception.propagation.ties import EQUAL, greatest_first

_CLOSE = 2  # of the sides of a mesh that are looked at closely, those under which the hulls themselves are most like
_BETTER = 0.9  # of the distance as it seems to lie, under which another side must be
_TAUGHT_BY = 3000  # hulls at most, evenly chosen


def doubtful_sides(
    family: Family, sides: Callable[[int], Floats], metric: Floats
) -> Iterator[tuple[int, tuple[int, ...]]]:
    """Each mesh of which no hull is told, and on which other sides it has to be looked at closely, none or some.

    sides: `Sketch.sides` of the mesh of that number; metric: as of `by_likeness`.
    """
    if not len(family.labelled):
        return
    taught, scale = _taught(family, metric)[:, SHAPES], family.scale.of_columns(SHAPES)

    def apart(shapes: Floats) -> float:
        return _apart(shapes * metric[SHAPES], taught)

    for mesh, span in _spans(family):
        if (family.codes[span] != UNTOLD).any():
            continue
        likeness = [apart(scale(found)) for found in sides(mesh)]
        seems = apart(family.rows[span, SHAPES])
        order = greatest_first(-np.array(likeness))
        yield mesh, tuple([side for side in order if likeness[side] < seems - EQUAL][:_CLOSE])


def righted(family: Family, looked: Iterable[tuple[int, Sequence[Floats]]], metric: Floats) -> Family:
    """The family with those meshes turned whose hulls are then clearly more like the hulls whose label is told.

    looked: meshes, each with its rows on those sides that `doubtful_sides` tells.
    """
    taught, rows, spans = _taught(family, metric), family.rows, dict(_spans(family))
    turned = rows.copy()

    def apart(found: Floats) -> float:
        """How far hulls are from those that are told, on the average."""
        return _apart(found * metric, taught)

    for mesh, sides in looked:
        span = spans[mesh]
        found = [family.scale(side) for side in sides]
        order = greatest_first(np.array([-apart(side) for side in found]))
        if order and apart(found[order[0]]) < _BETTER * apart(rows[span]):
            turned[span] = found[order[0]]
    return replace(family, rows=turned)


def _taught(family: Family, metric: Floats) -> Floats:
    found: Floats = family.rows[evenly(family.labelled, _TAUGHT_BY)] * metric
    return found


def _spans(family: Family) -> Iterator[tuple[int, slice]]:
    """Each mesh that has hulls, and which of all hulls these are."""
    meshes, starts = np.unique(family.owner, return_index=True)
    ends = np.searchsorted(family.owner, meshes, side="right")
    for mesh, start, end in zip(meshes.tolist(), starts.tolist(), ends.tolist(), strict=True):
        yield mesh, slice(start, end)


def _apart(rows: Floats, taught: Floats) -> float:
    return float(cdist(rows, taught, "cityblock").min(axis=1).mean())
