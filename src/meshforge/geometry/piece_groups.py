"""Convex pieces of one kind joined, where one convex hull around them adds little and takes nothing of other kinds."""

import heapq
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from meshforge.geometry.arrays import Aabb, Ints
from meshforge.geometry.convex import FLATNESS, convex_hull, measure_hull
from meshforge.geometry.shape import Polytope
from meshforge.geometry.solids import overlap_volume, volume_of_union

_WASTE = 0.15  # of a hull around pieces, which may be filled by none of them
_TAKEN = 0.01  # of it, which may be of other kinds beyond what its halves have of these
_GROWTH = {True: 0.2, False: 0.02}  # of a hull by a sliver, beside what that fills, by whether both have one label
_NEAR = 2e-3  # of the diagonal of all: pieces farther apart do not touch


@dataclass(frozen=True, eq=False)
class PieceGroup:
    """Pieces that are one hull. members: their places, in order."""

    shape: Polytope
    members: tuple[int, ...]
    kind: int
    pieces: tuple[Polytope, ...]

    @cached_property
    def volume(self) -> float:
        """What the pieces fill [m^3], what they share counted more than once."""
        return float(sum(piece.volume for piece in self.pieces))


def merge_pieces(
    pieces: Sequence[Polytope], kinds: Ints, sliver: float = 0.0, labels: Ints | None = None
) -> tuple[PieceGroup, ...]:
    """Join pieces that touch, are of one kind (n,), and whose convex hull adds at most 15%, the least first.

    Each piece is in one group. A group of one is the piece as it is. In the order of the first member. sliver: [m^3] a
    smaller group is then joined to one of any kind, whose hull grows by little beside what the group fills: by no more
    than that, than 20% where both have one of the labels (n,), by default the kinds, and than 2% elsewhere.
    """
    merger = _Merger(pieces, kinds)
    merger.run()
    merger.join_slivers(sliver, kinds if labels is None else labels)
    return tuple(sorted(merger.groups.values(), key=lambda group: group.members))


class _Merger:
    def __init__(self, pieces: Sequence[Polytope], kinds: Ints) -> None:
        self._pieces = list(pieces)
        self._kinds = np.asarray(kinds, dtype=np.int64)
        rows = zip(pieces, self._kinds.tolist(), strict=True)
        self.groups = {k: PieceGroup(piece, (k,), kind, (piece,)) for k, (piece, kind) in enumerate(rows)}
        from meshforge.geometry.proximity import close_pairs  # lazy: 0.04 s for coal, not needed to name what is here

        diagonal = Aabb.union(piece.aabb for piece in pieces).diagonal if pieces else 0.0
        self._thickness = FLATNESS * diagonal
        self._touching: dict[int, set[int]] = {k: set() for k in self.groups}
        for a, b in close_pairs(pieces, _NEAR * diagonal) if pieces else ():
            self._touching[a].add(b)
            self._touching[b].add(a)
        self._queue: list[tuple[float, int, int, PieceGroup]] = []
        self._taken = dict[int, float]()

    def run(self) -> None:
        for place in list(self.groups):
            self._propose(place, [other for other in self._touching[place] if other < place])
        while self._queue:
            _, one, other, group = heapq.heappop(self._queue)
            if one in self.groups and other in self.groups:
                place = len(self._taken)
                self._replace((one, other), place, group)
                self._propose(place, self._touching[place])

    def _replace(self, old: tuple[int, int], place: int, group: PieceGroup) -> None:
        touching = set[int]().union(*(self._touching.pop(k) for k in old)).difference(old)
        for k in old:
            del self.groups[k]
        self.groups[place], self._touching[place] = group, touching
        for other in touching:
            self._touching[other].difference_update(old)
            self._touching[other].add(place)

    def join_slivers(self, least: float, labels: Ints) -> None:
        """Join groups below a volume to the neighbour of any kind whose hull grows least, and only by little."""
        for place in sorted(self.groups, key=lambda k: (self.groups[k].volume, k)):
            own = self.groups[place]
            if own.volume >= least:  # it took in others meanwhile
                continue
            hulls = [(k, self._enclose(k, place)) for k in sorted(self._touching[place])]
            found = [(shape.volume - self.groups[k].shape.volume, k, shape) for k, shape in hulls]
            for grown, other, shape in sorted(found, key=lambda row: row[:2]):
                into = self.groups[other]
                growth = _GROWTH[bool(labels[into.members[0]] == labels[own.members[0]])]
                if grown <= min(least, growth * into.shape.volume) + own.volume:
                    self._replace((other, place), other, _unite(into, own, shape))
                    break

    def _propose(self, place: int, others: Iterable[int]) -> None:
        own = self.groups[place]
        self._taken[place] = self._overlap_others(own.shape, own.kind)
        for other in sorted(others):
            found = self._join(other, place) if self.groups[other].kind == own.kind else None
            if found is not None:
                heapq.heappush(self._queue, (found[0], other, place, found[1]))

    def _join(self, one: int, other: int) -> tuple[float, PieceGroup] | None:
        """The share of the hull around two groups that nothing fills, and the hull; None where they stay apart."""
        a, b = self.groups[one], self.groups[other]
        points = np.concatenate([a.shape.vertices, b.shape.vertices])
        if (1 - _WASTE) * measure_hull(points) > a.volume + b.volume:
            return None
        shape = self._enclose(one, other)
        waste = 1 - volume_of_union((*a.pieces, *b.pieces)) / shape.volume
        had = self._taken[one] + self._taken[other]
        if waste > _WASTE or self._overlap_others(shape, a.kind) - had > _TAKEN * shape.volume:
            return None
        return round(waste, 9), _unite(a, b, shape)

    def _enclose(self, one: int, other: int) -> Polytope:
        points = np.concatenate([self.groups[place].shape.vertices for place in (one, other)])
        return convex_hull(points, name="pieces of a part", thicken=self._thickness)

    def _overlap_others(self, shape: Polytope, kind: int) -> float:
        others = (self._pieces[k] for k in np.flatnonzero(self._kinds != kind).tolist())
        return sum(overlap_volume(shape, piece) for piece in others)


def _unite(a: PieceGroup, b: PieceGroup, shape: Polytope) -> PieceGroup:
    return PieceGroup(shape, tuple(sorted(a.members + b.members)), a.kind, (*a.pieces, *b.pieces))
