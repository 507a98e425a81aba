"""The ways in which labels may be wrong, most believable first, and what leaves select under each."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from math import exp

from meshforge.label_model import LabelBeliefs
from meshforge.language import Extractor, HullTable
from meshforge.symbolic import Label, mask_of
from meshforge.synthesis.demonstration import Example, LabelChange, LabelFix
from meshforge.synthesis.options import Options
from meshforge.synthesis.search.observation_table import HullGroups
from meshforge.synthesis.search.terms import enumerate_leaves


@dataclass(frozen=True, slots=True)
class Relabeling:
    """Changes of the labels of one mesh, in the order of the hulls; none at all for the mesh as it is.

    cost: to propose them [nats]; chance: how probable they are, compared with the mesh as it is.
    """

    cost: float = 0.0
    chance: float = 1.0
    changes: tuple[LabelChange, ...] = ()


def enumerate_relabelings(
    example: Example,
    vocabulary: Sequence[str],
    labels: LabelBeliefs,
    allowed: int,
    rejected: Collection[LabelFix],
    within: float,
    limit: int,
) -> list[Relabeling]:
    """Return the mesh as it is, and every single correction and the cheapest of more within a cost, by cost.

    allowed: corrections at most; rejected: a label that a person did not want corrected stands, whatever else it might
    be; limit: relabelings of more than one correction stop there.
    """
    single = _single_changes(example, vocabulary, labels, rejected, within) if allowed > 0 else []
    every, latest = [Relabeling(), *single], single
    for _ in range(1, allowed):
        room = limit - len(every)
        if room <= 0:
            break
        latest = _sort_by_cost(_extend(latest, single, within))[:room]
        every += latest
    return _sort_by_cost(every)


def relabel(example: Example, changes: Sequence[LabelChange]) -> Example:
    """Return the example with labels changed."""
    if not changes:
        return example
    hulls = example.mesh.hulls
    mesh = example.mesh.with_labels({hulls[index].name: Label(to, source="repair") for index, to in changes})
    return Example(example.name, mesh, example.selection)


def _single_changes(
    example: Example, vocabulary: Sequence[str], labels: LabelBeliefs, rejected: Collection[LabelFix], within: float
) -> list[Relabeling]:
    found = []
    rejected_labels = {(one.hull, one.was) for one in rejected if one.asset == example.name}
    for index, hull in enumerate(example.mesh.hulls):
        if (hull.name, hull.label) in rejected_labels:
            continue
        for to in vocabulary:
            cost = labels.cost(example.name, hull, to)
            if cost <= within:
                chance = exp(-labels.odds(example.name, hull, to))
                found.append(Relabeling(cost, chance, ((index, to),)))
    return _sort_by_cost(found)


def _extend(some: Sequence[Relabeling], single: Sequence[Relabeling], within: float) -> list[Relabeling]:
    """Relabelings with one change more, of a hull after all that they change."""
    found = []
    for one in some:
        for other in single:
            if one.cost + other.cost > within:
                break
            if one.changes[-1][0] < other.changes[0][0]:
                found.append(Relabeling(one.cost + other.cost, one.chance * other.chance, one.changes + other.changes))
    return found


def _sort_by_cost(some: list[Relabeling]) -> list[Relabeling]:
    return sorted(some, key=lambda one: (one.cost, one.changes))


@dataclass(frozen=True, slots=True)
class Variant:
    """One mesh under one relabeling: the groups of hulls that are to be selected there, and those that are not."""

    relabeling: Relabeling
    need: int
    avoid: int


def build_hull_table(examples: Sequence[Example], ways: Sequence[Sequence[Relabeling]], extremity: float) -> HullTable:
    """Return the hulls of each example under each of its relabelings, in one row."""
    meshes, labels = [], list[str | None]()
    for example, some in zip(examples, ways, strict=True):
        own = [hull.label for hull in example.mesh.hulls]
        for one in some:
            changes = dict(one.changes)
            meshes.append(example.mesh)
            labels += [changes.get(index, label) for index, label in enumerate(own)]
    return HullTable(meshes, labels, extremity)


class Variants:
    """The variants of each example that an extractor may match, and the leaves as terms over their groups of hulls.

    A variant is left out where two hulls that no extractor tells apart were treated differently.
    """

    def __init__(
        self,
        examples: Sequence[Example],
        ways: Sequence[Sequence[Relabeling]],
        vocabulary: Sequence[str],
        options: Options,
    ) -> None:
        leaves = (*enumerate_leaves(tuple(vocabulary), options.layers), *options.leaves)
        self._groups = HullGroups(build_hull_table(examples, ways, options.geo_extremity), leaves, vocabulary)
        self.width, self.terms = self._groups.width, self._groups.terms
        self.by_example: list[list[Variant]] = []
        begin = 0
        for example, some in zip(examples, ways, strict=True):
            size = len(example.mesh.hulls)
            slices = [self._groups.of[begin + k * size : begin + (k + 1) * size] for k in range(len(some))]
            begin += len(some) * size
            variants = [_to_variant(example, one, part) for one, part in zip(some, slices, strict=True)]
            self.by_example.append([variant for variant in variants if not variant.need & variant.avoid])

    def relabelings_for(self, extractor: Extractor | None) -> list[list[Relabeling]]:
        """Return of each example the relabelings on which an extractor selects what was shown; all for None."""
        found = None if extractor is None else self._groups.term(extractor).bits
        return [
            [
                variant.relabeling
                for variant in variants
                if found is None or (found & variant.need == variant.need and not found & variant.avoid)
            ]
            for variants in self.by_example
        ]


def _to_variant(example: Example, relabeling: Relabeling, groups: Sequence[int]) -> Variant:
    shown = example.selection
    need = mask_of(group for hull, group in enumerate(groups) if shown >> hull & 1)
    return Variant(relabeling, need, mask_of(group for hull, group in enumerate(groups) if not shown >> hull & 1))
