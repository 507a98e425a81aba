"""The base extractors: all hulls, and those with a label."""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from meshforge.language.arguments import LabelArgument
from meshforge.language.extractors.base import BaseExtractor, Candidates
from meshforge.language.hull_table import Bools, HullTable
from meshforge.language.words import quote_label

ALL = 2.6
"""For each `All` [nats]: people think in parts."""


@dataclass(frozen=True, slots=True)
class All(BaseExtractor):
    """Every hull."""

    def mask(self, hulls: HullTable, *bases: Bools) -> Bools:
        return np.ones(len(hulls), dtype=np.bool_)

    @property
    def phrase(self) -> str:
        return "all hulls"

    def one(self, *, other: bool) -> str:
        return "any other hull"

    @classmethod
    def enumerate(cls, candidates: Candidates) -> "Iterator[All]":
        yield All()

    @property
    def cost(self) -> float:
        return ALL


@dataclass(frozen=True, slots=True)
class Is(BaseExtractor):
    """The hulls with a label."""

    label: str = field(metadata={"argument": LabelArgument()})

    def mask(self, hulls: HullTable, *bases: Bools) -> Bools:
        return hulls.with_label(self.label)

    @property
    def phrase(self) -> str:
        return f"the {quote_label(self.label)} hulls"

    def one(self, *, other: bool) -> str:
        word = quote_label(self.label)
        article = "another" if other else "an" if word[0].lower() in "aeiou" else "a"
        return f"{article} {word} hull"

    @classmethod
    def enumerate(cls, candidates: Candidates) -> "Iterator[Is]":
        yield from map(Is, candidates.labels)

    @property
    def cost(self) -> float:
        return 0.0

    @property
    def uncertainty(self) -> int:
        return 0
