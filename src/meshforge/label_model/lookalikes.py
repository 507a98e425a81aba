"""The hulls that are most like each hull of a family: of other meshes, a few of each, and of its own."""

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from meshforge.geometry import Floats, Ints
from meshforge.label_model.ties import pick_evenly

Bools = npt.NDArray[np.bool_]
Places = npt.NDArray[np.int32]

PER_MESH = 3
"""Hulls of each other mesh that are looked at, the nearest."""
OF_OWN = 4
"""Hulls of the same mesh, the nearest."""
MOST_MESHES = 96
"""Other meshes that are looked at, evenly chosen of more, so that the work grows with the family, not its square."""
KEPT_MESHES = 32
"""Of these, the nearest to each hull are kept where there are more than `MOST_MESHES`."""
_AT_ONCE = 2000  # hulls that are compared at a time
_GRAIN = 1e-7  # distances that differ by less are equal


@dataclass(frozen=True, eq=False)
class Lookalikes:
    """others: (n, meshes, PER_MESH) the nearest hulls of other meshes, mesh by mesh; apart: their distances, infinite
    where there is none, of many meshes in single precision; own: (n, OF_OWN) those of the same mesh; own_apart: their
    distances.
    """

    others: Places
    apart: Floats
    own: Places
    own_apart: Floats

    def nearest(self, usable: Bools, count: int, per_mesh: int) -> tuple[Places, Floats]:
        """Return the `count` nearest usable hulls of other meshes, at most `per_mesh` of one: (n, count) and distances.

        What was found last for a count is kept: an answer seldom changes which hulls are usable.
        """
        before = self._kept.get((count, per_mesh))
        if before is None or not np.array_equal(before[0], usable):
            starts = range(0, max(len(self.apart), 1), _AT_ONCE)
            found = [self._nearest(slice(start, start + _AT_ONCE), usable, count, per_mesh) for start in starts]
            hulls, apart = np.concatenate([one for one, _ in found]), np.concatenate([one for _, one in found])
            before = self._kept[count, per_mesh] = usable.copy(), hulls, apart.astype(self.apart.dtype)
        return before[1], before[2].astype(float)

    @cached_property
    def _kept(self) -> dict[tuple[int, int], tuple[Bools, Places, Floats]]:
        """Which hulls were usable last, and what was found, by count."""
        return {}

    def _nearest(self, some: slice, usable: Bools, count: int, per_mesh: int) -> tuple[Places, Floats]:
        """The same of some hulls: what is sorted for all at once takes a lot of memory."""
        others = self.others[some]
        apart = np.where(usable[others], self.apart[some].astype(float, copy=False), np.inf)
        if per_mesh == 1:
            best = apart.argmin(axis=2)[:, :, None]
            hulls = np.take_along_axis(others, best, axis=2)[:, :, 0]
            apart = np.take_along_axis(apart, best, axis=2)[:, :, 0]
        else:
            width = others.shape[1] * others.shape[2]
            hulls, apart = others.reshape(len(apart), width), apart.reshape(len(apart), width)
        return take_nearest(hulls, apart, count)

    def nearest_of(self, hull: int, usable: Bools, count: int, per_mesh: int) -> list[int]:
        """Return of one hull the nearest usable ones, of its own mesh too, the nearest first."""
        one = slice(hull, hull + 1)
        only = Lookalikes(self.others[one], self.apart[one], self.own[one], self.own_apart[one])
        hulls, apart = only.nearest(usable, count, per_mesh)
        own_apart = np.where(usable[only.own], only.own_apart, np.inf)
        joined = np.concatenate([hulls, only.own], axis=1), np.concatenate([apart, own_apart], axis=1)
        hulls, apart = take_nearest(*joined, count)
        return [int(found) for found in hulls[np.isfinite(apart)]]


def take_nearest(hulls: Places, apart: Floats, count: int) -> tuple[Places, Floats]:
    """Return of candidates (n, m) the nearest (n, count), equally near ones in order; padded where there are fewer."""
    missing = count - hulls.shape[1]
    if missing > 0:
        hulls = np.pad(hulls, ((0, 0), (0, missing)))
        apart = np.pad(apart, ((0, 0), (0, missing)), constant_values=np.inf)
    width = hulls.shape[1]
    grains = np.where(np.isfinite(apart), np.round(apart / _GRAIN), 2.0**40).astype(np.int64)
    keys = grains * width + np.arange(width)
    order = (
        np.argpartition(keys, count - 1, axis=1)[:, :count]
        if width > count
        else np.tile(np.arange(width), (len(keys), 1))
    )
    order = np.take_along_axis(order, np.argsort(np.take_along_axis(keys, order, axis=1), axis=1), axis=1)
    return np.take_along_axis(hulls, order, axis=1), np.take_along_axis(apart, order, axis=1)


class LookalikeSearch:
    """Compares hulls by the sum of the weighted differences of their rows (n, columns), by all processors.

    metric: the weight of each column; owner: (n,) the mesh of each, ascending.
    """

    def __init__(self, rows: Floats, metric: Floats, owner: Ints) -> None:
        self.rows, self.metric, self.owner = rows, metric, owner
        self._meshes, starts = np.unique(owner, return_index=True)
        self._starts = np.append(starts, len(owner)).astype(np.int64)
        self._base = pick_evenly(self._meshes, MOST_MESHES)
        self._last: tuple[frozenset[int], Lookalikes] | None = None

    def find(self, speaking: Sequence[int]) -> Lookalikes:
        """Return the nearest hulls of each; what was found last is kept.

        speaking: meshes of which something is said; where there are too many meshes to look at all, up to `MOST_MESHES`
        of these are looked at, beside those that always are. One more costs no more than itself.
        """
        beside = np.setdiff1d(np.array(speaking, dtype=np.int64), self._base)
        beside = pick_evenly(beside, MOST_MESHES - int(np.isin(self._base, speaking).sum()))
        wanted = frozenset(beside.tolist())
        if self._last is None or not self._last[0] <= wanted:
            self._last = frozenset(), self._extend(self._find_own(), self._base)
        last, found = self._last
        if last != wanted:
            self._last = wanted, self._extend(found, np.array(sorted(wanted - last)))
        return self._last[1]

    def _find_own(self) -> Lookalikes:
        from scipy.spatial.distance import cdist  # lazy: 0.5 s, half of all imports

        count, starts = len(self.rows), self._starts.tolist()
        own, own_apart = np.zeros((count, OF_OWN), np.int32), np.full((count, OF_OWN), np.inf)
        for start, end in pairwise(starts):
            weighted = self.rows[start:end] * self.metric
            gaps = cdist(weighted, weighted, "cityblock")
            np.fill_diagonal(gaps, np.inf)
            hulls = np.broadcast_to(np.arange(start, end, dtype=np.int32), gaps.shape)
            own[start:end], own_apart[start:end] = take_nearest(hulls, gaps, OF_OWN)
        precision = float if len(self._meshes) <= MOST_MESHES else np.float32
        nothing = np.zeros((count, 0, PER_MESH))
        return Lookalikes(nothing.astype(np.int32), nothing.astype(precision), own, own_apart)

    def _extend(self, known: Lookalikes, more: Ints) -> Lookalikes:
        places = np.searchsorted(self._meshes, more)
        spans = [slice(start, end) for start, end in zip(self._starts[places], self._starts[places + 1], strict=True)]
        compared = [
            (mesh, np.arange(span.start, span.stop, dtype=np.int32), self.rows[span] * self.metric)
            for mesh, span in zip(more.tolist(), spans, strict=True)
        ]
        width = known.others.shape[1] + len(compared)
        kept = width if len(self._meshes) <= MOST_MESHES else min(KEPT_MESHES, width)
        others = np.zeros((len(self.rows), kept, PER_MESH), dtype=np.int32)
        apart = np.full(others.shape, np.inf, known.apart.dtype)

        def compare(begin: int) -> None:
            some = slice(begin, min(begin + _AT_ONCE, len(self.rows)))
            hulls, gaps = _compare(self.rows[some] * self.metric, self.owner[some], compared)
            hulls = np.concatenate([known.others[some], hulls], axis=1)
            gaps = np.concatenate([known.apart[some], gaps.astype(apart.dtype)], axis=1)
            if gaps.shape[1] > kept:
                whose = self.owner[hulls[:, :, 0]]
                order = np.lexsort((whose, np.round(gaps[:, :, 0].astype(float) / _GRAIN)), axis=1)[:, :kept, None]
                hulls, gaps = np.take_along_axis(hulls, order, axis=1), np.take_along_axis(gaps, order, axis=1)
            others[some], apart[some] = hulls, gaps

        with ThreadPoolExecutor(os.cpu_count()) as pool:
            for _ in pool.map(compare, range(0, len(self.rows), _AT_ONCE)):
                pass
        return Lookalikes(others, apart, known.own, known.own_apart)


def _compare(rows: Floats, owner: Ints, meshes: Sequence[tuple[int, Places, Floats]]) -> tuple[Places, Floats]:
    """The nearest hulls of each of some meshes, given as number, places of hulls and their rows; and distances."""
    from scipy.spatial.distance import cdist  # lazy: as above

    count = len(rows)
    hulls, apart = np.zeros((count, len(meshes), PER_MESH), np.int32), np.full((count, len(meshes), PER_MESH), np.inf)
    for place, (mesh, places, theirs) in enumerate(meshes):
        gaps = cdist(rows, theirs, "cityblock")
        gaps[owner == mesh] = np.inf
        hulls[:, place], apart[:, place] = take_nearest(np.broadcast_to(places, gaps.shape), gaps, PER_MESH)
    return hulls, apart
