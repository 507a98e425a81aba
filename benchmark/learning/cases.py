"""Rules to be learned: a hidden extractor, the meshes it is meant for, and which of them are demonstrated."""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache

from benchmark.learning.families import FAMILIES, VOCABULARIES, family
from benchmark.learning.targets import extractors_of
from meshforge.language import Extractor, select_mask, show
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.candidates.rank import RankedCandidates, enumerate_consistent
from meshforge.synthesis.demonstration import Example
from meshforge.synthesis.options import Options, TimeBudget
from meshforge.synthesis.search.smallest import Hit, Search

FAMILY = 30
"""Meshes of a family."""
_LONG = 120.0  # seconds that a search may take


@dataclass(frozen=True, eq=False)
class Case:
    """One rule; masks: what its hidden extractor selects on each mesh; shown: places of the demonstrated meshes."""

    family: str
    hidden: Extractor
    vocabulary: tuple[str, ...]
    meshes: tuple[SymbolicMesh, ...]
    masks: tuple[int, ...]
    shown: tuple[int, ...]

    def examples(self, also: Iterable[int] = ()) -> list[Example]:
        """What is known: the demonstrated meshes, and others by their places."""
        return [Example(name_of(k), self.meshes[k], self.masks[k]) for k in (*self.shown, *also)]

    def rest(self, also: Iterable[int] = ()) -> list[int]:
        """The places of the meshes about which nothing is known."""
        known = {*self.shown, *also}
        return [k for k in range(len(self.meshes)) if k not in known]

    def search(self, also: Sequence[int] = (), options: Options | None = None, batch: bool = True) -> Search:
        """The search for the rule's extractor; batch: False leaves the meshes out that nothing is known about."""
        rest = [self.meshes[k] for k in self.rest(also)] if batch else []
        return Search(self.examples(also), self.vocabulary, TimeBudget(_LONG), options or Options(), batch=rest)


def name_of(place: int) -> str:
    """How a mesh is called; names sort as places do."""
    return f"mesh {place:04}"


def learn(search: Search) -> RankedCandidates:
    """The readings of a rule, as learning makes them."""
    found = search.run()
    assert isinstance(found, Hit), "there is an extractor: the hidden one"
    return RankedCandidates(search, enumerate_consistent(search, found.extractor, search.options.above))


@cache
def read_family(name: str, seed: int, count: int = FAMILY) -> tuple[SymbolicMesh, ...]:
    """The meshes of a family with their contacts known."""
    meshes = family(name, count, seed)
    assert all(mesh.contacts is not None for mesh in meshes)
    return meshes


def case(
    name: str,
    extractor: Extractor,
    vocabulary: tuple[str, ...],
    meshes: tuple[SymbolicMesh, ...],
    count: int,
    seed: int,
) -> Case | None:
    """A rule demonstrated on so many meshes, drawn of those where it selects something; None where it never does."""
    masks = tuple(select_mask(extractor, mesh) for mesh in meshes)
    able = [k for k, mask in enumerate(masks) if mask]
    draw = random.Random(f"{seed}{name}{show(extractor)}")
    shown = tuple(draw.sample(able, min(count, len(able))))
    return Case(name, extractor, vocabulary, meshes, masks, shown) if shown else None


def cases(seeds: Iterable[int], count: int, only: Sequence[str] = tuple(FAMILIES)) -> Iterator[Case]:
    """All rules of the families, with families of these seeds, each demonstrated on so many meshes."""
    for seed in seeds:
        for name in only:
            for extractor in extractors_of(name):
                found = case(name, extractor, VOCABULARIES[name], read_family(name, seed), count, seed)
                if found:
                    yield found
