"""The ways in which labels of one mesh may be wrong, the most believable first."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from math import exp

from meshforge.symbolic import Hull, Label
from meshforge.synthesis.correction import Correction
from meshforge.synthesis.example import Example
from meshforge.synthesis.repair.standing import Labels

Change = tuple[int, str]
"""A hull by its index, and the label it gets."""


@dataclass(frozen=True, slots=True)
class Relabeling:
    """Changes of the labels of one mesh, in the order of the hulls; none at all for the mesh as it is.

    cost: to propose them [nats]; chance: how probable they are, compared with the mesh as it is.
    """

    cost: float = 0.0
    chance: float = 1.0
    changes: tuple[Change, ...] = ()


def relabelings(
    example: Example,
    vocabulary: Sequence[str],
    labels: Labels,
    allowed: int,
    rejected: Collection[Correction],
    within: float,
    limit: int,
) -> list[Relabeling]:
    """The mesh as it is, and every single correction and the cheapest of more within a cost, by cost.

    allowed: corrections at most; rejected: a label that a person did not want corrected stands, whatever else it might
    be; limit: relabelings of more than one correction stop there.
    """
    single = _single(example, vocabulary, labels, rejected, within) if allowed > 0 else []
    every, latest = [Relabeling(), *single], single
    for _ in range(1, allowed):
        room = limit - len(every)
        if room <= 0:
            break
        latest = _ordered(_extended(latest, single, within))[:room]
        every += latest
    return _ordered(every)


def correction(example: Example, change: Change) -> Correction:
    """A change as it is called outside."""
    hull = example.mesh.hulls[change[0]]
    return Correction(example.name, hull.name, hull.label, change[1])


def relabelled(example: Example, changes: Sequence[Change]) -> Example:
    """The example with labels changed."""
    if not changes:
        return example
    hulls = example.mesh.hulls
    mesh = example.mesh.with_labels({hulls[index].name: _label(hulls[index], to) for index, to in changes})
    return Example(example.name, mesh, example.selection)


def _label(hull: Hull, to: str) -> Label:
    return Label(to, source="repair")


def _single(
    example: Example, vocabulary: Sequence[str], labels: Labels, rejected: Collection[Correction], within: float
) -> list[Relabeling]:
    found = []
    standing = {(one.hull, one.was) for one in rejected if one.asset == example.name}
    for index, hull in enumerate(example.mesh.hulls):
        if (hull.name, hull.label) in standing:
            continue
        for to in vocabulary:
            cost = labels.cost(example.name, hull, to)
            if cost <= within:
                chance = exp(-labels.odds(example.name, hull, to))
                found.append(Relabeling(cost, chance, ((index, to),)))
    return _ordered(found)


def _extended(some: Sequence[Relabeling], single: Sequence[Relabeling], within: float) -> list[Relabeling]:
    """Relabelings with one change more, of a hull after all that they change."""
    found = []
    for one in some:
        for other in single:
            if one.cost + other.cost > within:
                break
            if one.changes[-1][0] < other.changes[0][0]:
                found.append(Relabeling(one.cost + other.cost, one.chance * other.chance, one.changes + other.changes))
    return found


def _ordered(some: list[Relabeling]) -> list[Relabeling]:
    return sorted(some, key=lambda one: (one.cost, one.changes))
