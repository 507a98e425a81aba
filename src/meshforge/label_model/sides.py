"""Meshes that lie on another side than it seems are set upright, by hulls of other meshes whose labels are known."""

from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np

from meshforge.geometry import Floats
from meshforge.label_model.describe import SHAPE_COLUMNS
from meshforge.label_model.table import NO_LABEL, ColumnScale, FamilyTable, Observations
from meshforge.label_model.ties import EQUAL, greatest_first, pick_evenly

_CLOSE = 2  # of the sides of a mesh that are looked at closely, those under which the hulls themselves are most like
_BETTER = 0.9  # of the distance as it seems to lie, under which another side must be
_FEW = 4  # meshes of whose hulls something is said, up to which these stay as they seem to stand
_MOST_ROWS = 800  # hulls at most, evenly chosen


class UprightReference:
    """The hulls by which it is told how a mesh stands: all of which anything is said, not only those whose labels are
    given, since a few answers of people say little of that. Of the labels that a mesh has itself each is compared with
    hulls of that label alone.
    """

    def __init__(self, table: FamilyTable, seen: Observations) -> None:
        self._table, self._codes = table, seen.codes
        self.hulls = pick_evenly(np.flatnonzero(seen.known), _MOST_ROWS)
        self._speaking = np.unique(table.owner[self.hulls])

    def may_turn(self, mesh: int) -> bool:
        """Return whether it can be told how a mesh stands: of a few with labels nobody knows which one lies."""
        return mesh not in self._speaking or len(self._speaking) > _FEW

    def apart(self, mesh: int, sides: Sequence[Floats], columns: slice) -> list[float]:
        """Return how far hulls of a mesh, described by rows (n, columns) on each of some sides, are from those of other
        meshes, on average.
        """
        from scipy.spatial.distance import cdist  # lazy: 0.5 s, half of all imports

        table, span = self._table, self._table.spans[mesh]
        others = self.hulls[table.owner[self.hulls] != mesh]
        if not len(others):
            return [0.0] * len(sides)
        metric, own, codes = table.metric[columns], self._codes[span], self._codes[others]
        theirs, mine = table.rows[others, columns] * metric, np.stack(sides) * metric
        nearest = np.empty(mine.shape[:2])
        for code in np.unique(own).tolist():
            which, same = own == code, codes == code
            compared = theirs[same] if code != NO_LABEL and same.any() else theirs
            gaps = cdist(mine[:, which].reshape(-1, mine.shape[2]), compared, "cityblock")
            nearest[:, which] = gaps.min(axis=1).reshape(len(sides), -1)
        return [float(side.mean()) for side in nearest]


def find_doubtful_sides(
    table: FamilyTable, seen: Observations, sides: Callable[[int], Floats]
) -> Iterator[tuple[int, tuple[int, ...]]]:
    """Yield each mesh, and on which other sides it has to be looked at closely, none or some.

    sides: `ShapeDescriptor.sides` of the mesh of that number.
    """
    reference = UprightReference(table, seen)
    scale = ColumnScale(table.scale.middle[SHAPE_COLUMNS], table.scale.spread[SHAPE_COLUMNS])
    if not len(reference.hulls):
        return
    for mesh, span in table.spans.items():
        if not reference.may_turn(mesh):
            yield mesh, ()
            continue
        rows = [table.rows[span, SHAPE_COLUMNS], *map(scale, sides(mesh))]
        seems, *likeness = reference.apart(mesh, rows, SHAPE_COLUMNS)
        order = greatest_first(-np.array(likeness))
        yield mesh, tuple([side for side in order if likeness[side] < seems - EQUAL][:_CLOSE])


def choose_sides(table: FamilyTable, seen: Observations, closer: Mapping[int, Sequence[Floats]]) -> dict[int, int]:
    """Return those meshes whose hulls are clearly more like those of others on another side, each with which of its
    rows.

    closer: meshes, each with its rows on those sides that `find_doubtful_sides` names.
    """
    reference, every = UprightReference(table, seen), slice(0, table.rows.shape[1])
    found = {}
    for mesh, sides in closer.items():
        seems, *apart = reference.apart(mesh, [table.rows[table.spans[mesh]], *map(table.scale, sides)], every)
        order = greatest_first(-np.array(apart))
        if order and apart[order[0]] < _BETTER * seems:
            found[mesh] = order[0]
    return found


def correct_upright(table: FamilyTable, seen: Observations, closer: Mapping[int, Sequence[Floats]]) -> FamilyTable:
    """Return the table with those meshes turned; closer: as of `choose_sides`."""
    chosen = choose_sides(table, seen, closer)
    return table.turn((table.spans[mesh], table.scale(closer[mesh][side])) for mesh, side in chosen.items())
