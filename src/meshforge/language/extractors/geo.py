"""Geo: the hulls that reach farthest in a direction."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import product
from math import dist
from typing import ClassVar, Literal, Self

import numpy as np

from meshforge.language.arguments import DirectionArgument
from meshforge.language.extractors.base import BaseArgument, BaseExtractor, Candidates, Leaf
from meshforge.language.hull_table import Bools, HullTable
from meshforge.language.words import DIRECTIONS, Direction

UPRIGHT, SIDEWAYS = 0.3, 1.65
"""For each direction [nats]: six are tried, so they fit by accident; up and down are meant more often than others."""
SLACK = 1e-9
"""Comparisons with a threshold forgive this share of L, against rounding."""


@dataclass(frozen=True, slots=True)
class Geo(Leaf):
    """The hulls of `base` that reach farthest along `direction`, within extremity times the diagonal of `base`."""

    layer: ClassVar[Literal["G"]] = "G"
    base: BaseExtractor = field(metadata={"argument": BaseArgument()})
    direction: Direction = field(metadata={"argument": DirectionArgument()})

    def mask(self, hulls: HullTable, *bases: Bools) -> Bools:
        (base,) = bases
        farthest = hulls.recall((Geo, base.tobytes()), lambda: _find_farthest(hulls, base))
        chosen: Bools = farthest[DIRECTIONS.index(self.direction)]
        return chosen

    @property
    def phrase(self) -> str:
        return f"that reach farthest along {self.direction}"

    @classmethod
    def enumerate(cls, candidates: Candidates) -> Iterator[Self]:
        yield from (cls(base, direction) for base, direction in product(candidates.bases, DIRECTIONS))

    @property
    def cost(self) -> float:
        return (UPRIGHT if self.direction[1] == "Z" else SIDEWAYS) + self.base.cost


def _find_farthest(hulls: HullTable, base: Bools) -> Bools:
    """For each direction, the hulls of a base that reach farthest along it on their mesh (6, hulls)."""
    found = np.zeros((len(DIRECTIONS), len(base)), dtype=np.bool_)
    chosen = np.flatnonzero(base)
    if not len(chosen):
        return found
    owner = hulls.owner[chosen]
    fresh = np.concatenate([[True], owner[1:] != owner[:-1]])
    firsts, part = np.flatnonzero(fresh), np.cumsum(fresh) - 1
    low, high = hulls.low[chosen], hulls.high[chosen]
    lowest, highest = np.minimum.reduceat(low, firsts), np.maximum.reduceat(high, firsts)
    diagonals = np.array([dist(a, b) for a, b in zip(lowest.tolist(), highest.tolist(), strict=True)])
    slack = SLACK * hulls.lengths[owner[firsts]]
    for row, direction in enumerate(DIRECTIONS):
        axis = "XYZ".index(direction[1])
        reach, most = (high, highest) if direction[0] == "+" else (-low, -lowest)
        nearest = most[:, axis] - hulls.extremity * diagonals - slack
        found[row, chosen[reach[:, axis] >= nearest[part]]] = True
    return found
