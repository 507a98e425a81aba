"""The extractors without set operators, and what they select: everything else is put together from these."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import assert_never

from meshforge.language import DIRECTIONS, All, Attach, Base, Geo, Is, attach_mask, geo_mask, select_mask
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.options import Layers

Leaf = All | Is | Attach | Geo


def leaves(vocabulary: Sequence[str], layers: Layers = "S+T+G") -> tuple[Leaf, ...]:
    """Every extractor without set operators over the labels of a vocabulary."""
    bases: list[Base] = [*map(Is, vocabulary), All()]
    attached = [Attach(selected, anchor) for selected, anchor in product(bases, bases)] if "T" in layers else []
    extreme = [Geo(base, direction) for base, direction in product(bases, DIRECTIONS)] if "G" in layers else []
    return (*bases, *attached, *extreme)


def observed(chosen: Sequence[Leaf], mesh: SymbolicMesh, extremity: float) -> tuple[int, ...]:
    """What each of the leaves selects on a mesh, as bit sets; a base is looked up once for all that use it."""
    known: dict[Base, int] = {}

    def base(node: Base) -> int:
        if node not in known:
            known[node] = select_mask(node, mesh)
        return known[node]

    def leaf(node: Leaf) -> int:
        match node:
            case All() | Is():
                return base(node)
            case Attach(selected, anchor):
                return attach_mask(mesh, base(selected), base(anchor))
            case Geo(inner, direction):
                return geo_mask(mesh, base(inner), direction, extremity)
            case _:
                assert_never(node)

    return tuple(leaf(node) for node in chosen)
