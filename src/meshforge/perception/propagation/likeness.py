"""Which label a hull has by the hulls that are most like it, among those whose label is told or nearly certain."""

from __future__ import annotations

import numpy as np
from scipy.spatial.distance import cdist

from meshforge.geometry import Floats, Ints
from meshforge.perception.propagation.family import UNTOLD, Family, evenly
from meshforge.perception.propagation.ties import EQUAL

_ROUNDS = 2  # times that hulls which are nearly certain help with the others
_CERTAIN = 0.8  # from which chance on they do
_HELP = 0.5  # what such a hull counts beside one that is told
_TOLD = 6000  # hulls at most whose label is told, so that labelling grows with the family, not with its square
_HELPERS = 3000  # such hulls at most, evenly chosen
_AT_ONCE = 2000  # hulls that are compared at a time
_FARTHEST = 1e6  # beyond any distance of two hulls


def by_likeness(family: Family, metric: Floats) -> Floats:
    """The chance of each label (hulls, labels); of a hull that is told, what its look-alikes say, too.

    metric: the weight of each column (columns,).
    """
    rows = family.rows * metric
    told, stands_for = _told(family)
    known = np.eye(len(family.labels))[family.codes[told]]
    helpers = np.zeros(0, dtype=np.int64)
    chances = np.zeros((len(rows), len(family.labels)))
    for _ in range(1 + _ROUNDS):
        voters = np.concatenate([told, helpers])
        counts = np.concatenate([stands_for, np.full(len(helpers), _HELP)])
        chances = _voted(rows, family.owner, voters, counts, np.concatenate([known, chances[helpers]]))
        helpers = _helpers(family, chances)
    return chances


def _told(family: Family) -> tuple[Ints, Floats]:
    """The hulls that are told, of very many of one label some, evenly, and how many each stands for."""
    most = max(1, _TOLD // max(1, len(family.labels)))
    of_labels = [family.labelled[family.codes[family.labelled] == code] for code in range(len(family.labels))]
    chosen = [evenly(hulls, most) for hulls in of_labels]
    voters = np.concatenate([np.zeros(0, dtype=np.int64), *chosen])
    shares = [len(hulls) / len(some) for hulls, some in zip(of_labels, chosen, strict=True)]
    order = np.argsort(voters)
    return voters[order], np.repeat(shares, [len(some) for some in chosen])[order]


def _helpers(family: Family, chances: Floats) -> Ints:
    """Hulls that nobody told and that are nearly certain, of very many some, evenly."""
    sure = (family.codes == UNTOLD) & (chances.max(axis=1, initial=0.0) > _CERTAIN + EQUAL)
    return evenly(np.flatnonzero(sure), _HELPERS)


def _voted(rows: Floats, owner: Ints, voters: Ints, counts: Floats, votes: Floats) -> Floats:
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
