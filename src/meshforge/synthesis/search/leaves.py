"""The extractors without set operators: everything else is put together from these."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

from meshforge.language import DIRECTIONS, All, Attach, Base, Geo, Is
from meshforge.synthesis.options import Layers

Leaf = All | Is | Attach | Geo


def leaves(vocabulary: Sequence[str], layers: Layers = "S+T+G") -> tuple[Leaf, ...]:
    """Every extractor without set operators over the labels of a vocabulary."""
    bases: list[Base] = [*map(Is, vocabulary), All()]
    attached = [Attach(selected, anchor) for selected, anchor in product(bases, bases)] if "T" in layers else []
    extreme = [Geo(base, direction) for base, direction in product(bases, DIRECTIONS)] if "G" in layers else []
    return (*bases, *attached, *extreme)
