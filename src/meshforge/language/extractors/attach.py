"""Attach: hulls in contact with others."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import product
from typing import ClassVar, Literal, Self

import numpy as np

from meshforge.language.extractors.base import BaseArgument, BaseExtractor, Candidates, Leaf
from meshforge.language.hull_table import Bools, HullTable

SELF = 6.0
"""For a base attached to itself [nats]: that says how parts were cut rather than what they are."""


@dataclass(frozen=True, slots=True)
class Attach(Leaf):
    """The hulls of `selected` in contact with at least one hull of `anchor`."""

    layer: ClassVar[Literal["T"]] = "T"
    selected: BaseExtractor = field(metadata={"argument": BaseArgument()})
    anchor: BaseExtractor = field(metadata={"argument": BaseArgument()})

    def mask(self, hulls: HullTable, *bases: Bools) -> Bools:
        selected, anchor = bases
        return selected & hulls.recall((Attach, anchor.tobytes()), lambda: _find_touching(hulls, anchor))

    @property
    def phrase(self) -> str:
        return f"that touch {self.anchor.one(other=self.anchor == self.selected)}"

    @classmethod
    def enumerate(cls, candidates: Candidates) -> Iterator[Self]:
        yield from (cls(selected, anchor) for selected, anchor in product(candidates.bases, candidates.bases))

    @property
    def cost(self) -> float:
        return self.selected.cost + self.anchor.cost + SELF * (self.selected == self.anchor)

    @property
    def uncertainty(self) -> int:
        """One more where it is not between two labels: it says how parts were cut then."""
        uncertainty = self.selected.uncertainty + self.anchor.uncertainty
        return uncertainty + (uncertainty > 0 or self.selected == self.anchor)


def _find_touching(hulls: HullTable, anchor: Bools) -> Bools:
    found = np.zeros_like(anchor)
    for here, there in ((0, 1), (1, 0)):
        found[hulls.contacts[anchor[hulls.contacts[:, there]], here]] = True
    return found
