"""Meshes that lie on another side than it seems are set upright, by the hulls whose labels are given."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

import numpy as np
from scipy.spatial.distance import cdist

from meshforge.geometry import Floats
from meshforge.label_model.describe import SHAPE_COLUMNS
from meshforge.label_model.table import Bools, FamilyTable
from meshforge.label_model.ties import EQUAL, greatest_first, pick_evenly

_CLOSE = 2  # of the sides of a mesh that are looked at closely, those under which the hulls themselves are most like
_BETTER = 0.9  # of the distance as it seems to lie, under which another side must be
_MOST_ROWS = 3000  # hulls at most, evenly chosen


def find_doubtful_sides(
    table: FamilyTable, given: Bools, sides: Callable[[int], Floats]
) -> Iterator[tuple[int, tuple[int, ...]]]:
    """Each mesh without a hull whose label is given, and on which other sides it has to be looked at closely, none or
    some.

    given: (n,) of all hulls; sides: `ShapeDescriptor.sides` of the mesh of that number.
    """
    if not given.any():
        return
    known, scale = _rows_of(table, given)[:, SHAPE_COLUMNS], table.scale.of_columns(SHAPE_COLUMNS)

    def apart(shapes: Floats) -> float:
        return _mean_distance(shapes * table.metric[SHAPE_COLUMNS], known)

    for mesh, span in table.spans.items():
        if given[span].any():
            continue
        likeness = [apart(scale(found)) for found in sides(mesh)]
        seems = apart(table.rows[span, SHAPE_COLUMNS])
        order = greatest_first(-np.array(likeness))
        yield mesh, tuple([side for side in order if likeness[side] < seems - EQUAL][:_CLOSE])


def correct_upright(table: FamilyTable, given: Bools, closer: Iterable[tuple[int, Sequence[Floats]]]) -> FamilyTable:
    """The table with those meshes turned whose hulls are then clearly more like those whose labels are given.

    closer: meshes, each with its rows on those sides that `find_doubtful_sides` names.
    """
    known = _rows_of(table, given)

    def apart(found: Floats) -> float:
        return _mean_distance(found * table.metric, known)

    def turned() -> Iterator[tuple[slice, Floats]]:
        for mesh, sides in closer:
            span = table.spans[mesh]
            found = [table.scale(side) for side in sides]
            order = greatest_first(np.array([-apart(side) for side in found]))
            if order and apart(found[order[0]]) < _BETTER * apart(table.rows[span]):
                yield span, found[order[0]]

    return table.turn(turned())


def _rows_of(table: FamilyTable, given: Bools) -> Floats:
    return table.rows[pick_evenly(np.flatnonzero(given), _MOST_ROWS)] * table.metric


def _mean_distance(rows: Floats, others: Floats) -> float:
    return float(cdist(rows, others, "cityblock").min(axis=1).mean())
