"""Relabelled meshes side by side: what the leaves select on all of them at once, by arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from meshforge.language import SLACK, Extractor, length
from meshforge.symbolic import mask_of
from meshforge.synthesis.example import Example
from meshforge.synthesis.options import Layers
from meshforge.synthesis.repair.relabelings import Relabeling
from meshforge.synthesis.search.arrays import Hulls
from meshforge.synthesis.search.groups import Groups


@dataclass(frozen=True, slots=True)
class Variant:
    """One mesh under one relabeling: the groups of hulls that are to be selected there, and those that are not."""

    relabeling: Relabeling
    need: int
    avoid: int


class RelabelledHulls(Hulls):
    """The hulls of many relabelings of some meshes in one row; boxes and contacts are those of the meshes."""

    __slots__ = ()

    def __init__(self, examples: Sequence[Example], ways: Sequence[Sequence[Relabeling]]) -> None:
        copies = [len(some) for some in ways]
        sizes = [len(example.mesh.hulls) for example in examples]
        self.counts = np.repeat(np.array(sizes, dtype=np.int64), copies)
        self.starts = np.concatenate([[0], np.cumsum(self.counts)]).astype(np.int64)
        self._owner = np.repeat(np.arange(len(self.counts)), self.counts)
        corners = [example.mesh.corners for example in examples]
        self._low = np.concatenate([np.tile(low, (n, 1)) for (low, _), n in zip(corners, copies, strict=True)])
        self._high = np.concatenate([np.tile(high, (n, 1)) for (_, high), n in zip(corners, copies, strict=True)])
        self._slack = np.repeat([SLACK * length(example.mesh) for example in examples], copies)
        self._labels = [
            label
            for example, some in zip(examples, ways, strict=True)
            for one in some
            for label in _labels(example, one)
        ]
        firsts = np.cumsum([0, *copies])
        pairs = [
            (
                self.starts[first : first + n, None, None]
                + np.array(sorted(example.mesh.contacts), dtype=np.int64).reshape(-1, 2)
            )
            for example, first, n in zip(examples, firsts, copies, strict=False)
        ]
        self._contacts = np.concatenate([pair.reshape(-1, 2) for pair in pairs])


class Variants:
    """The variants of each example that an extractor may match, and the leaves as terms over their groups of hulls.

    A variant is left out where two hulls that no extractor tells apart were treated differently.
    """

    def __init__(
        self,
        examples: Sequence[Example],
        ways: Sequence[Sequence[Relabeling]],
        vocabulary: Sequence[str],
        layers: Layers,
        extremity: float,
    ) -> None:
        self._groups = Groups(RelabelledHulls(examples, ways), vocabulary, layers, extremity)
        self.width, self.terms = self._groups.width, self._groups.terms
        self.by_example: list[list[Variant]] = []
        begin = 0
        for example, some in zip(examples, ways, strict=True):
            size = len(example.mesh.hulls)
            slices = [self._groups.of[begin + k * size : begin + (k + 1) * size] for k in range(len(some))]
            begin += len(some) * size
            variants = [_variant(example, one, part) for one, part in zip(some, slices, strict=True)]
            self.by_example.append([variant for variant in variants if not variant.need & variant.avoid])

    def relabelings_for(self, extractor: Extractor | None) -> list[list[Relabeling]]:
        """Of each example the relabelings on which an extractor selects what was shown; on all of them for None."""
        found = None if extractor is None else self._groups.term(extractor).bits
        return [
            [
                variant.relabeling
                for variant in variants
                if found is None or (found & variant.need == variant.need and not found & variant.avoid)
            ]
            for variants in self.by_example
        ]


def _variant(example: Example, relabeling: Relabeling, groups: Sequence[int]) -> Variant:
    shown = example.selection
    need = mask_of(group for hull, group in enumerate(groups) if shown >> hull & 1)
    return Variant(relabeling, need, mask_of(group for hull, group in enumerate(groups) if not shown >> hull & 1))


def _labels(example: Example, relabeling: Relabeling) -> list[str | None]:
    labels = [hull.label for hull in example.mesh.hulls]
    for index, to in relabeling.changes:
        labels[index] = to
    return labels
