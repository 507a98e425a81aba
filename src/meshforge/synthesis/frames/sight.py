"""A rule as it is met in one frame: what extractors can tell of the hulls decides whether there is one at all."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from meshforge.language import All, Base, Geo, Is, select_mask
from meshforge.synthesis.example import Example
from meshforge.synthesis.options import Layers
from meshforge.synthesis.search.arrays import Hulls
from meshforge.synthesis.search.leaves import leaves

Look = tuple[bytes, bool]
"""Which leaf extractors select a hull, and whether it was selected."""


@dataclass(frozen=True, eq=False, slots=True)
class Met:
    """What the demonstrations say about a rule in one frame.

    base: a base that selects what was shown; it does so in every frame, so nothing needs to be searched for.
    looks: of all hulls; rules with the same looks have the same extractors.
    strays: how many hulls any extractor takes or leaves wrongly, since others that look the same were not or were.
    least: an extractor has at least that many nodes.
    """

    examples: tuple[Example, ...]
    base: Base | None
    signatures: frozenset[Look] = frozenset()
    strays: int = 0
    least: int = 1


def met(examples: Sequence[Example], vocabulary: Sequence[str], layers: Layers, extremity: float) -> Met:
    """A rule as it is met on some examples."""
    bases: list[Base] = [*map(Is, vocabulary), All()]
    for base in bases:
        if all(select_mask(base, example.mesh) == example.selection for example in examples):
            return Met(tuple(examples), base)
    chosen = leaves(vocabulary, layers)
    table = Hulls([example.mesh for example in examples]).table(chosen, extremity)
    shown = [bool(e.selection >> index & 1) for e in examples for index in range(len(e.mesh.hulls))]
    fits = (table == np.array(shown)).all(axis=1)
    least = 2 if any(isinstance(chosen[row], Geo) for row in np.flatnonzero(fits)) else 3
    columns = [column.tobytes() for column in np.packbits(table.T, axis=1)]
    seen = Counter(zip(columns, shown, strict=True))
    return Met(tuple(examples), None, frozenset(seen), _strays(seen), least)


def _strays(seen: Counter[Look]) -> int:
    return sum(min(count, seen[look, False]) for (look, selected), count in seen.items() if selected)
