"""Several meshes side by side as the search sees them: hulls that no leaf tells apart are one group, one bit."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from itertools import pairwise

from meshforge.language import EXTREMITY, Extractor
from meshforge.symbolic import SymbolicMesh, mask_of
from meshforge.synthesis.options import Layers
from meshforge.synthesis.search.arrays import Hulls
from meshforge.synthesis.search.groups import Groups
from meshforge.synthesis.search.term import Term


class Field:
    """All leaf extractors over a vocabulary, as terms over the groups of hulls of some meshes.

    Groups are numbered by their first hull, so those of the first meshes come first. An extractor selects a group
    wholly or not at all, whatever its size, on all meshes alike; so there are far fewer bits than hulls.
    vocabulary: labels in the order in which they are preferred; group: False makes every hull a group of its own.
    """

    def __init__(
        self,
        meshes: Sequence[SymbolicMesh],
        vocabulary: Sequence[str],
        layers: Layers = "S+T+G",
        extremity: float = EXTREMITY,
        group: bool = True,
    ) -> None:
        self.meshes = tuple(meshes)
        hulls = Hulls(meshes)
        self._groups = Groups(hulls, vocabulary, layers, extremity, group)
        spans = list(pairwise(hulls.starts.tolist()))
        self.groups = [self._groups.of[low:high] for low, high in spans]
        self._signatures = [self._groups.signatures[low:high] for low, high in spans]
        self.width, self.terms = self._groups.width, self._groups.terms

    def width_of(self, count: int) -> int:
        """How many groups the first `count` meshes have."""
        return 1 + max((group for groups in self.groups[:count] for group in groups), default=-1)

    @cached_property
    def present(self) -> tuple[int, ...]:
        """The groups that have hulls on each mesh, as bit sets."""
        return tuple(mask_of(groups) for groups in self.groups)

    def on(self, bits: int, mesh: int) -> int:
        """The hulls of one mesh that are in a set of groups, as a bit set."""
        return mask_of(hull for hull, group in enumerate(self.groups[mesh]) if bits >> group & 1)

    def groups_in(self, selections: Sequence[int]) -> int:
        """The groups that selections of hulls, one for each of the first meshes, touch."""
        rows = zip(selections, self.groups, strict=False)
        return mask_of(group for mask, groups in rows for hull, group in enumerate(groups) if mask >> hull & 1)

    def term(self, extractor: Extractor) -> Term:
        """An extractor over the leaves as a term, operands in the order that terms have."""
        return self._groups.term(extractor)

    def bits(self, extractor: Extractor) -> int:
        """The groups that an extractor over the leaves selects."""
        return self.term(extractor).bits

    def find_conflict(self, selections: Sequence[int]) -> tuple[tuple[int, int], tuple[int, int]] | None:
        """Two hulls, each as (mesh, hull), that no extractor tells apart though only the first is selected.

        selections: of the first meshes, one bit set of hulls each. None where there are no such hulls.
        """
        first: dict[tuple[bytes, bool], tuple[int, int]] = {}
        for mesh, mask in enumerate(selections):
            for hull, look in enumerate(self._signatures[mesh]):
                first.setdefault((look, bool(mask >> hull & 1)), (mesh, hull))
        for (look, selected), place in first.items():
            if selected and (look, False) in first:
                return place, first[look, False]
        return None
