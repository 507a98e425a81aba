"""The chance of each label for each hull of a family, a table of comparable rows: by hulls that look alike, then by
hulls that touch."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.spatial.distance import cdist

from meshforge.geometry import Floats, Ints
from meshforge.rendering import UNSURE
from meshforge.symbolic import GIVEN_SOURCES, HUMAN_SOURCES, Label

NO_LABEL = -1
"""The code of a hull whose label is not known."""
_LEAST_SPREAD = 1e-3  # spread of a column below which it counts as constant
_MOST_SPREADS = 3.0  # spreads from the median beyond which nothing is farther


@dataclass(frozen=True, eq=False, slots=True)
class ColumnScale:
    """What brings columns to a common spread. middle, spread: (columns,)."""

    middle: Floats
    spread: Floats

    @staticmethod
    def of(rows: Floats) -> ColumnScale:
        """The medians and spreads of some rows (n, columns)."""
        if not len(rows):
            return ColumnScale(np.zeros(rows.shape[1]), np.ones(rows.shape[1]))
        return ColumnScale(np.median(rows, axis=0), np.maximum(rows.std(axis=0), _LEAST_SPREAD))

    def of_columns(self, columns: slice) -> ColumnScale:
        """That of some columns."""
        return ColumnScale(self.middle[columns], self.spread[columns])

    def __call__(self, rows: Floats) -> Floats:
        """Rows about the middle in units of the spread, far values drawn in."""
        return np.clip((rows - self.middle) / self.spread, -_MOST_SPREADS, _MOST_SPREADS)


@dataclass(frozen=True, eq=False)
class FamilyTable:
    """Hulls of all meshes, in order.

    rows: (n, columns), described and brought to a common spread by `scale`; owner: (n,) the mesh of each; codes: (n,)
    the place of its label among `labels`, NO_LABEL where it is not known; touching: pairs (m, 2) of hulls of one mesh
    that are in contact.
    """

    rows: Floats
    scale: ColumnScale
    owner: Ints
    codes: Ints
    labels: tuple[str, ...]
    touching: Ints

    @cached_property
    def labelled(self) -> Ints:
        """The hulls whose label is known."""
        return np.flatnonzero(self.codes != NO_LABEL)

    def with_labels(self, known: Sequence[str | None]) -> FamilyTable:
        """The table with other known labels; known: that of each hull, None where it is not."""
        labels = tuple(sorted({label for label in known if label is not None}))
        places = {label: place for place, label in enumerate(labels)}
        codes = np.array([NO_LABEL if label is None else places[label] for label in known], dtype=np.int64)
        return replace(self, codes=codes, labels=labels)


def pick_evenly(items: Ints, most: int) -> Ints:
    """Of very many some, evenly."""
    return items if len(items) <= most else items[np.arange(most) * len(items) // most]


def reference_label(label: Label | None) -> str | None:
    """The label that others may be taken from: one that a person gave, or that came in a file and is not unsure."""
    if label is None or label.source not in GIVEN_SOURCES:
        return None
    return label.name if label.source in HUMAN_SOURCES or label.confidence >= UNSURE else None


EQUAL = 1e-9
"""Numbers about one that differ by less differ by rounding; that of linear algebra is another on each processor."""

_HELPER_ROUNDS = 2  # times that hulls which are nearly certain help with the others
_CERTAIN = 0.8  # from which chance on they do
_HELP = 0.5  # what such a hull counts beside one whose label is known
_VOTERS = 6000  # hulls at most whose label is known, so that labelling grows with the family, not with its square
_HELPERS = 3000  # such hulls at most, evenly chosen
_AT_ONCE = 2000  # hulls that are compared at a time
_FARTHEST = 1e6  # beyond any distance of two hulls

_NEIGHBORS_WEIGHT = 0.3  # what all neighbours together say, beside the hull itself
_PRIOR_COUNT = 0.5  # pairs of labels count as having touched so often before any are seen
_NEIGHBOR_ROUNDS = 5
_LEAST_CHANCE = 1e-3  # chance that nothing falls below before neighbours are asked


def first_greatest(values: Floats, within: float = EQUAL) -> Ints:
    """The place (...) of the first of those values (..., n) that are the greatest but for `within`."""
    found: Ints = np.argmax(values >= values.max(axis=-1, keepdims=True) - within, axis=-1)
    return found


def greatest_first(values: Floats) -> list[int]:
    """The places of values (n,), the greatest first; those that are equal in their order."""
    left, found = values.astype(float), list[int]()
    for _ in values:
        found.append(int(first_greatest(left)))
        left[found[-1]] = -np.inf
    return found


def share_ranks(values: Floats) -> Floats:
    """How many of some values (n,), none negative, are greater than each; of those that are equal, half."""
    greater = values[None] > values[:, None] * (1 + EQUAL)
    found: Floats = (len(values) - 1 + greater.sum(axis=1) - greater.sum(axis=0)) / 2
    return found


def vote_by_similarity(family: FamilyTable, metric: Floats) -> Floats:
    """The chance of each label (hulls, labels); of a hull whose label is known, what its look-alikes say, too.

    metric: the weight of each column (columns,).
    """
    rows = family.rows * metric
    labelled, stands_for = _choose_voters(family)
    known = np.eye(len(family.labels))[family.codes[labelled]]
    helpers = np.zeros(0, dtype=np.int64)
    chances = np.zeros((len(rows), len(family.labels)))
    for _ in range(1 + _HELPER_ROUNDS):
        voters = np.concatenate([labelled, helpers])
        counts = np.concatenate([stands_for, np.full(len(helpers), _HELP)])
        chances = _vote(rows, family.owner, voters, counts, np.concatenate([known, chances[helpers]]))
        helpers = _choose_helpers(family, chances)
    return chances


def _choose_voters(family: FamilyTable) -> tuple[Ints, Floats]:
    """The hulls whose label is known, of very many of one label some, evenly, and how many each stands for."""
    most = max(1, _VOTERS // max(1, len(family.labels)))
    of_labels = [family.labelled[family.codes[family.labelled] == code] for code in range(len(family.labels))]
    chosen = [pick_evenly(hulls, most) for hulls in of_labels]
    voters = np.concatenate([np.zeros(0, dtype=np.int64), *chosen])
    shares = [len(hulls) / len(some) for hulls, some in zip(of_labels, chosen, strict=True)]
    order = np.argsort(voters)
    return voters[order], np.repeat(shares, [len(some) for some in chosen])[order]


def _choose_helpers(family: FamilyTable, chances: Floats) -> Ints:
    """Hulls whose label is not known and that are nearly certain, of very many some, evenly."""
    sure = (family.codes == NO_LABEL) & (chances.max(axis=1, initial=0.0) > _CERTAIN + EQUAL)
    return pick_evenly(np.flatnonzero(sure), _HELPERS)


def _vote(rows: Floats, owner: Ints, voters: Ints, counts: Floats, votes: Floats) -> Floats:
    """The chances (n, labels) of all hulls by the votes (m, labels) of some, the nearer the more.

    No hull votes on itself, and helpers, which count less than one, do not vote on hulls of their own mesh.
    """
    chances = np.empty((len(rows), votes.shape[1]))
    for start in range(0, len(rows), _AT_ONCE):
        some = np.arange(start, min(start + _AT_ONCE, len(rows)))
        apart = cdist(rows[some], rows[voters], "cityblock")
        kin = owner[some][:, None] == owner[voters][None]
        apart[(some[:, None] == voters[None]) | (kin & (counts < 1)[None])] = np.inf
        nearest = np.minimum(apart.min(axis=1, keepdims=True, initial=np.inf), _FARTHEST)
        chances[some] = (np.exp(nearest - apart) * counts) @ votes
    total = chances.sum(axis=1, keepdims=True)
    even = np.full_like(chances, 1 / max(1, votes.shape[1]))
    shares: Floats = np.divide(chances, total, out=even, where=total > 0)
    return shares


def refine_by_neighbors(family: FamilyTable, chances: Floats) -> Floats:
    """Chances (hulls, labels) after each hull has taken in its neighbours, a few times over (mean field).

    A pair of labels speaks for itself as much as it touches more often than by accident where labels are known.
    """
    bond = _label_bonds(family)
    a, b = family.touching.T
    degree = np.maximum(np.bincount(family.touching.ravel(), minlength=len(chances)), 1)[:, None]
    own = np.log(chances + _LEAST_CHANCE)
    for _ in range(_NEIGHBOR_ROUNDS):
        messages = chances @ bond.T
        received = np.zeros_like(chances)
        np.add.at(received, a, messages[b])
        np.add.at(received, b, messages[a])
        evidence = own + _NEIGHBORS_WEIGHT * received / degree
        chances = np.exp(evidence - evidence.max(axis=1, keepdims=True))
        chances /= chances.sum(axis=1, keepdims=True)
    return chances


def _label_bonds(family: FamilyTable) -> Floats:
    """For each pair of labels, how much more often they touch than by accident, as a logarithm (labels, labels)."""
    count = len(family.labels)
    seen = np.full((count, count), _PRIOR_COUNT)
    codes = family.codes[family.touching]
    for one, other in codes[(codes >= 0).all(axis=1)]:
        seen[one, other] += 1
        seen[other, one] += 1
    joint = seen / seen.sum()
    alone = joint.sum(axis=1)
    bonds: Floats = np.log(joint / (alone[:, None] * alone[None]))
    return bonds
