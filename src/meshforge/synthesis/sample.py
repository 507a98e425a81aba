"""Which results to look at before a program is kept: those that would show best that something else is meant."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import islice

import numpy as np

from meshforge.synthesis.readings import Weighed

SAMPLE = 12
"""So many results a person looks at before keeping a program (paper, protocol)."""

_NOTHING = 1e-12  # belief that is none

Known = tuple[Weighed, Sequence[str]]
"""The readings of a rule, and the names of the meshes of their field."""


def sample(learned: Sequence[Known], trust: Mapping[str, float]) -> tuple[str, ...]:
    """The assets whose results to look at, the most telling first; none of which every rule is known.

    First each time the asset on which most belief is in readings that none before it would refute, then the one that
    stands for most hulls unlike any before. trust: how much each tells; where labels are doubtful less, since what is
    wrong there may be a label.
    """
    known = [set(names[: len(weighed.examples)]) for weighed, names in learned]
    every = {name for _, names in learned for name in names}
    names = sorted(name for name in every if not all(name in some for some in known))
    chosen = list(islice(_differing(learned, names, trust), SAMPLE))
    for name in _unlike(*learned[0], [name for name in names if name not in chosen], chosen, trust) if learned else ():
        if len(chosen) == SAMPLE:
            break
        chosen.append(name)
    return tuple(chosen)


def _differing(learned: Sequence[Known], names: Sequence[str], trust: Mapping[str, float]) -> Iterator[str]:
    """Assets one by one, each the one on which most belief is in readings that do as the program on all before it."""
    if not learned or not names:
        return
    place = {name: k for k, name in enumerate(names)}
    tables = []
    for weighed, called in learned:
        table = np.zeros((len(weighed.compared), len(names)))
        for row, reading in enumerate(weighed.compared):
            others = [place[called[k]] for k in weighed.differences(reading) if called[k] in place]
            table[row, others] = weighed.beliefs[reading]
        tables.append(table)
    at_stake = np.concatenate(tables)
    weights = np.array([trust[name] for name in names])
    while True:
        gains = at_stake.sum(axis=0)
        best = int(np.argmax(np.round(gains, 12) * weights))
        if gains[best] <= _NOTHING:
            return
        yield names[best]
        at_stake = at_stake[at_stake[:, best] == 0]


def _unlike(
    weighed: Weighed, called: Sequence[str], names: Sequence[str], before: Sequence[str], trust: Mapping[str, float]
) -> Iterator[str]:
    """Assets one by one, each the one whose hulls stand for most hulls of the batch that are unlike any before."""
    groups = {name: frozenset(some) for name, some in zip(called, weighed.field.groups, strict=True)}
    many = Counter(group for some in groups.values() for group in some)
    seen = {group for name in [*called[: len(weighed.examples)], *before] for group in groups.get(name, ())}
    rest = [name for name in names if name in groups]
    while rest:
        best = max(rest, key=lambda name: trust[name] * sum(many[group] for group in groups[name] - seen))
        yield best
        rest.remove(best)
        seen |= groups[best]
