"""How the hulls most similar to each hull are labelled: votes for each label, near ones counting more."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from meshforge.geometry import Floats, Ints
from meshforge.symbolic import SymbolicMesh, descriptors

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
    sure = np.array([_vote_weight(hull.confidence) for hull in hulls])
    rows = _standardize(descriptors(meshes))
    asked = min(NEIGHBOURS + 1, len(voting))
    gaps, found = cKDTree(rows[voting]).query(rows, k=range(1, asked + 1))
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


def _vote_weight(confidence: float | None) -> float:
    return 0.0 if confidence is None else min(1.0, max(0.05, confidence))


def _standardize(rows: Floats) -> Floats:
    """Columns about their medians, in units of their spread; far values count as three of these."""
    low, middle, high = np.quantile(rows, [0.25, 0.5, 0.75], axis=0)
    spread = np.maximum(np.maximum((high - low) / 1.35, 0.3 * rows.std(axis=0)), 0.05)
    scaled: Floats = np.clip((rows - middle) / spread, -3.0, 3.0)
    return scaled
