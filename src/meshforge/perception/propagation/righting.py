"""Meshes that lie on their side, set upright: as they lie, their hulls are most like those that are labelled."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
from scipy.spatial.distance import cdist

from meshforge.geometry import Floats
from meshforge.perception.propagation.describe import SHAPES, Describer
from meshforge.perception.propagation.family import UNTOLD, Family, evenly
from meshforge.perception.propagation.upright import other_sides, upright
from meshforge.symbolic import SymbolicMesh

_SIDES = 5  # on which a mesh may lie, besides the one it seems to lie on
_CLOSE = 2  # of these that are looked at closely, those under which the hulls themselves are most like
_BETTER = 0.9  # of the distance as it seems to lie, under which another side must be
_TAUGHT_BY = 3000  # hulls at most, evenly chosen


class OtherSides:
    """A mesh as it would be described if it lay on another side than it seems to."""

    def __init__(self, mesh: SymbolicMesh) -> None:
        self._describer = Describer(mesh)
        self._ups = other_sides(mesh, upright(mesh), _SIDES)
        self.shapes = [self._describer.shapes(up) for up in self._ups]
        """`SHAPES` of the rows on each side."""

        self._rows: dict[int, Floats] = {}

    def described(self, side: int) -> Floats:
        """The rows on one side."""
        if side not in self._rows:
            self._rows[side] = self._describer.described(self._ups[side])
        return self._rows[side]


def righted(family: Family, sides: Callable[[int], OtherSides], metric: Floats) -> Family:
    """The family with those meshes turned whose hulls are then clearly more like the hulls whose label is told.

    Looked at are meshes no hull of which is told. sides: those of the mesh of that number; metric: as of
    `by_likeness`.
    """
    if not len(family.told):
        return family
    taught = family.rows[evenly(family.told, _TAUGHT_BY)] * metric
    scale_of_shapes, rows = family.scale.of_columns(SHAPES), family.rows.copy()

    def apart(found: Floats) -> float:
        """How far hulls are from those that are told, on the average."""
        return _apart(found * metric, taught)

    def apart_in_shape(found: Floats) -> float:
        return _apart(found * metric[SHAPES], taught[:, SHAPES])

    for mesh, span in _spans(family):
        if (family.codes[span] != UNTOLD).any():
            continue
        others = sides(mesh)
        likeness = [apart_in_shape(scale_of_shapes(found)) for found in others.shapes]
        seems = apart_in_shape(family.rows[span, SHAPES])
        order = sorted((side for side, far in enumerate(likeness) if far < seems), key=lambda side: likeness[side])
        found = [family.scale(others.described(side)) for side in order[:_CLOSE]]
        best = min(found, key=apart, default=rows[span])
        rows[span] = best if apart(best) < _BETTER * apart(rows[span]) else rows[span]
    return replace(family, rows=rows)


def _spans(family: Family) -> Iterator[tuple[int, slice]]:
    """Each mesh that has hulls, and which of all hulls these are."""
    meshes, starts = np.unique(family.owner, return_index=True)
    ends = [*starts[1:].tolist(), len(family.owner)]
    for mesh, start, end in zip(meshes.tolist(), starts.tolist(), ends, strict=True):
        yield mesh, slice(start, end)


def _apart(rows: Floats, taught: Floats) -> float:
    return round(float(cdist(rows, taught, "cityblock").min(axis=1).mean()), 9)
