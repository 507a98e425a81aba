"""How believable each label is: the odds against every other label, from its source and confidence and from look-
alikes.

Costs are in nats. Tuned on families of box furniture; `script/bench repairs` judges it on families
that nothing was tuned on.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from scipy.spatial import cKDTree

from meshforge.geometry import Floats, Ints
from meshforge.symbolic import HUMAN_SOURCES, LABEL_SOURCES, Hull, SymbolicMesh, descriptors

PERSON_PROBABILITY = 0.9995
"""How much a person's label is believed."""

MAX_MACHINE_PROBABILITY = (0.85, 0.98)
"""The most that a label of confidence 1 is believed lies between these; where, the batch says for each source."""

MIN_MACHINE_PROBABILITY = 0.5
"""A machine's label is believed so much at least, whatever its confidence, before look-alikes are asked."""

AGREEMENT = 0.85
"""Similar hulls that give a label such a chance show whether others of the source are right."""

PRIOR_ACCURACY = (0.96, 20.0)
"""The share of right labels that is assumed beforehand, and how many hulls that counts for."""

MAX_ODDS_FOR_CORRECTION = 5.0
"""What may speak for a correction at most; look-alikes err too."""

NO_LABEL_COST = 1.5
"""Filling in a label where the hull has none, before look-alikes are asked."""

CORRECTION_COST = 0.5
"""A correction, besides its improbability: so those are proposed that serve."""

NEIGHBOURS = 20
"""Hulls asked how a hull like them is labelled: the most similar ones."""

REACH, FALLOFF = 1.0, 3.0
"""A vote counts (1 + (d / REACH)^2)^-FALL at a distance of d standard deviations: what is far counts little, but where
nothing is near it is better than nothing (log loss of the true label 0.39 on two meshes instead of 0.64 for a Gaussian
that falls to nothing, 0.14 instead of 0.22 on 25)."""

SMOOTHING = 0.05
"""The share of the votes that is spread evenly over all labels."""

MAX_MENTIONED = 6
"""Of the most similar hulls so many are mentioned to the user."""


@dataclass(frozen=True, slots=True)
class LabelOdds:
    """A hull's label among the labels that it could have.

    odds: for it against each other label of the vocabulary [nats]; similar: the labels of the most similar hulls, the
    most similar first.
    """

    hull: Hull
    odds: Mapping[str, float]
    similar: tuple[str, ...]


class LabelBeliefs:
    """How believable the labels of demonstrated meshes are, judged by all meshes.

    demonstrated: by the names that examples have, in the frame to reason in, before any rule; batch: all other
    meshes, in that frame as far as they have one; those that are demonstrated too are left out.
    Hulls that rules made have no odds: what to correct is the label of what they were made from.
    """

    def __init__(
        self, demonstrated: Mapping[str, SymbolicMesh], batch: Mapping[str, SymbolicMesh], vocabulary: Sequence[str]
    ) -> None:
        shown = list(demonstrated.values())
        others = {name: mesh for name, mesh in batch.items() if not any(_is_same_asset(mesh, other) for other in shown)}
        self._names, meshes = [*demonstrated, *others], [*shown, *others.values()]
        self._counts, self._vocabulary = [len(mesh.hulls) for mesh in meshes], vocabulary
        self._hulls = [hull for mesh in meshes for hull in mesh.hulls]
        self._votes = votes = vote_by_lookalikes(meshes, vocabulary)
        self._accuracies = accuracies = _source_accuracies(self._hulls, votes, vocabulary)
        places = [(name, hull) for name, mesh in demonstrated.items() for hull in mesh.hulls]
        self._odds_by_hull = {
            (name, hull.name): _odds_of_hull(hull, votes.chances[row], votes.nearest[row], accuracies, vocabulary)
            for row, (name, hull) in enumerate(places)
        }

    @cached_property
    def errors(self) -> Mapping[str, float]:
        """How many labels of each mesh are wrong or missing, as far as can be expected."""
        places = {label: place for place, label in enumerate(self._vocabulary)}
        right = np.array(
            [label_probability(hull, self._accuracies) if hull.label in places else 0.0 for hull in self._hulls]
        )
        codes = np.array([places.get(hull.label or "", 0) for hull in self._hulls], dtype=np.int64)
        own = self._votes.chances[np.arange(len(codes)), codes] if places else np.zeros(len(codes))
        wrong = (1 - own) * (1 - right) / max(1, len(places) - 1)
        shares = np.where(right > 0, wrong / np.maximum(own * right + wrong, 1e-300), 1.0)
        sums = (float(shares[first:end].sum()) for first, end in pairwise(np.cumsum([0, *self._counts])))
        return dict(zip(self._names, sums, strict=True))

    def odds_of(self, asset: str, hull: Hull) -> LabelOdds | None:
        """Of a hull as a rule meets it; None for one that was made, or relabelled, on the way."""
        found = self._odds_by_hull.get((asset, hull.name))
        return found if found and found.hull.annotation == hull.annotation and hull.parent is None else None

    def odds(self, asset: str, hull: Hull, to: str) -> float:
        """The odds for the hull's label against the label `to` [nats]; infinite where it has none."""
        found = self.odds_of(asset, hull)
        return found.odds.get(to, math.inf) if found else math.inf

    def cost(self, asset: str, hull: Hull, to: str) -> float:
        """The cost of the hypothesis that the hull is to be labelled `to` [nats], never below 0."""
        odds = self.odds(asset, hull, to)
        return odds if odds > 30 else math.log1p(math.exp(odds)) + CORRECTION_COST


def _is_same_asset(mesh: SymbolicMesh, other: SymbolicMesh) -> bool:
    """Whether two meshes come from one asset."""
    if mesh is other:
        return True
    return mesh.asset is not None and other.asset is not None and mesh.asset.path == other.asset.path


def _source_accuracies(hulls: Sequence[Hull], votes: LookalikeVotes, vocabulary: Sequence[str]) -> Mapping[str, float]:
    """The share of right labels of each source, as far as similar hulls that agree among themselves show."""
    right, total = Counter[str](), Counter[str]()
    if vocabulary:
        for hull, best, chance in zip(hulls, votes.chances.argmax(axis=1), votes.chances.max(axis=1), strict=True):
            if hull.annotation and chance >= AGREEMENT:
                total[hull.annotation.source] += 1
                right[hull.annotation.source] += hull.annotation.name == vocabulary[best]
    before, among = PRIOR_ACCURACY
    return {source: (right[source] + before * among) / (total[source] + among) for source in LABEL_SOURCES}


def _odds_of_hull(
    hull: Hull, chances: Floats, nearest: Ints, accuracies: Mapping[str, float], vocabulary: Sequence[str]
) -> LabelOdds:
    by_label = dict(zip(vocabulary, chances.tolist(), strict=True))
    others = [label for label in vocabulary if label != hull.label]
    log_odds = {label: _log_odds(hull, label, by_label, accuracies, len(others)) for label in others}
    odds = {label: max(-MAX_ODDS_FOR_CORRECTION, one) for label, one in log_odds.items()}
    return LabelOdds(hull, odds, tuple(vocabulary[place] for place in nearest))


def _log_odds(hull: Hull, to: str, chances: Mapping[str, float], accuracies: Mapping[str, float], others: int) -> float:
    """The logarithm of the odds of the hull's label, or of having none, against another label."""
    if hull.annotation is None:
        return NO_LABEL_COST - math.log(chances[to])
    right = label_probability(hull, accuracies)
    agreement = chances.get(hull.annotation.name, min(chances.values()))
    return math.log(right / (1 - right) * others) + math.log(agreement / chances[to])


def label_probability(hull: Hull, accuracies: Mapping[str, float]) -> float:
    """The probability that a hull's label is right, looking at its source and confidence only."""
    assert hull.annotation
    if is_human(hull):
        return PERSON_PROBABILITY
    low, high = MAX_MACHINE_PROBABILITY
    most = min(high, max(low, accuracies[hull.annotation.source]))
    return min(most, max(MIN_MACHINE_PROBABILITY, hull.annotation.confidence))


def is_human(hull: Hull) -> bool:
    """Whether a person gave the label."""
    return hull.source in HUMAN_SOURCES


@dataclass(frozen=True, eq=False, slots=True)
class LookalikeVotes:
    """What similar hulls say about each of n hulls; none is asked about itself.

    chances: the probability of each label of the vocabulary, (n, labels); nearest: the labels of the most similar
    hulls as places in the vocabulary, the most similar first, (n, m).
    """

    chances: Floats
    nearest: Ints


def vote_by_lookalikes(meshes: Sequence[SymbolicMesh], vocabulary: Sequence[str]) -> LookalikeVotes:
    """What the hulls with labels of the vocabulary say about each hull of the meshes, in order."""
    hulls = [hull for mesh in meshes for hull in mesh.hulls]
    places = {label: place for place, label in enumerate(vocabulary)}
    codes = np.array([places.get(hull.label or "", -1) for hull in hulls], dtype=np.int64)
    voting = np.flatnonzero(codes >= 0)
    if len(voting) < 2:
        even = np.full((len(hulls), len(vocabulary)), 1 / max(1, len(vocabulary)))
        return LookalikeVotes(even, np.zeros((len(hulls), 0), dtype=np.int64))
    sure = np.array([0.0 if h.confidence is None else min(1.0, max(0.05, h.confidence)) for h in hulls])
    rows = _standardize(descriptors(meshes))
    gaps, found = cKDTree(rows[voting]).query(rows, k=range(1, min(NEIGHBOURS + 1, len(voting)) + 1))
    near, gaps = _drop_self(voting[found], np.asarray(gaps))
    votes = (1 + (gaps / REACH) ** 2) ** -FALLOFF * sure[near]
    return LookalikeVotes(_vote_shares(codes[near], votes, len(vocabulary)), codes[near][:, :MAX_MENTIONED])


def _drop_self(near: Ints, gaps: Floats) -> tuple[Ints, Floats]:
    """The neighbours of each hull but itself, or but the last where it is not among them: one less."""
    own = near == np.arange(len(near))[:, None]
    own[~own.any(axis=1), -1] = True
    shape = (len(near), near.shape[1] - 1)
    return near[~own].reshape(shape), gaps[~own].reshape(shape)


def _vote_shares(labels: Ints, votes: Floats, count: int) -> Floats:
    counted = np.zeros((len(labels), count))
    np.add.at(counted, (np.arange(len(labels))[:, None], labels), votes)
    shares: Floats = counted / counted.sum(axis=1, keepdims=True)
    return (1 - SMOOTHING) * shares + SMOOTHING / count


def _standardize(rows: Floats) -> Floats:
    """Columns about their medians, in units of their spread; far values count as three of these."""
    low, middle, high = np.quantile(rows, [0.25, 0.5, 0.75], axis=0)
    spread = np.maximum(np.maximum((high - low) / 1.35, 0.3 * rows.std(axis=0)), 0.05)
    scaled: Floats = np.clip((rows - middle) / spread, -3.0, 3.0)
    return scaled
