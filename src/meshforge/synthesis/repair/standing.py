"""How believable each label of the demonstrated meshes is: its source and confidence, and how similar hulls are."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from meshforge.geometry import Floats, Ints
from meshforge.symbolic import HUMAN_SOURCES, SOURCES, Hull, SymbolicMesh
from meshforge.synthesis.repair import weights
from meshforge.synthesis.repair.alike import Alike, alike


@dataclass(frozen=True, slots=True)
class Standing:
    """A hull's label among the labels that it could have.

    odds: for it against each other label of the vocabulary [nats]; similar: the labels of the most similar hulls, the
    most similar first.
    """

    hull: Hull
    odds: Mapping[str, float]
    similar: tuple[str, ...]


class Labels:
    """How believable the labels of demonstrated meshes are, judged by all meshes.

    demonstrated: by the names that examples have, in the frame to reason in, before any rule; batch: all other
    meshes, in that frame as far as they have one; those that are demonstrated too are left out.
    Hulls that rules made have no standing: what to correct is the label of what they were made from.
    """

    def __init__(
        self, demonstrated: Mapping[str, SymbolicMesh], batch: Mapping[str, SymbolicMesh], vocabulary: Sequence[str]
    ) -> None:
        shown = list(demonstrated.values())
        others = {name: mesh for name, mesh in batch.items() if not any(_same(mesh, other) for other in shown)}
        self._names, meshes = [*demonstrated, *others], [*shown, *others.values()]
        self._counts, self._vocabulary = [len(mesh.hulls) for mesh in meshes], vocabulary
        self._hulls = [hull for mesh in meshes for hull in mesh.hulls]
        self._votes = said = alike(meshes, vocabulary)
        self._accuracies = surest = _surest(self._hulls, said, vocabulary)
        places = [(name, hull) for name, mesh in demonstrated.items() for hull in mesh.hulls]
        self._odds_by_hull = {
            (name, hull.name): _standing(hull, said.chances[row], said.nearest[row], surest, vocabulary)
            for row, (name, hull) in enumerate(places)
        }

    @cached_property
    def errors(self) -> Mapping[str, float]:
        """How many labels of each mesh are wrong or missing, as far as can be expected."""
        places = {label: place for place, label in enumerate(self._vocabulary)}
        right = np.array([sureness(hull, self._accuracies) if hull.label in places else 0.0 for hull in self._hulls])
        codes = np.array([places.get(hull.label or "", 0) for hull in self._hulls], dtype=np.int64)
        own = self._votes.chances[np.arange(len(codes)), codes] if places else np.zeros(len(codes))
        wrong = (1 - own) * (1 - right) / max(1, len(places) - 1)
        shares = np.where(right > 0, wrong / np.maximum(own * right + wrong, 1e-300), 1.0)
        ends = np.cumsum([0, *self._counts])
        sums = (float(shares[first:end].sum()) for first, end in pairwise(ends))
        return dict(zip(self._names, sums, strict=True))

    def odds_of(self, asset: str, hull: Hull) -> Standing | None:
        """Of a hull as a rule meets it; None for one that was made, or relabelled, on the way."""
        found = self._odds_by_hull.get((asset, hull.name))
        return found if found and found.hull.annotation == hull.annotation and hull.parent is None else None

    def odds(self, asset: str, hull: Hull, to: str) -> float:
        """The odds for the hull's label against the label `to` [nats]; infinite where it has no standing."""
        found = self.odds_of(asset, hull)
        return found.odds.get(to, math.inf) if found else math.inf

    def cost(self, asset: str, hull: Hull, to: str) -> float:
        """What it costs to believe that the hull is to be labelled `to` [nats], never below 0."""
        odds = self.odds(asset, hull, to)
        return odds if odds > 30 else math.log1p(math.exp(odds)) + weights.SERVING


def _same(mesh: SymbolicMesh, other: SymbolicMesh) -> bool:
    """Whether two meshes come from one asset."""
    if mesh is other:
        return True
    return mesh.asset is not None and other.asset is not None and mesh.asset.path == other.asset.path


def _surest(hulls: Sequence[Hull], said: Alike, vocabulary: Sequence[str]) -> Mapping[str, float]:
    """The share of right labels of each source, as far as similar hulls that agree among themselves tell."""
    right, total = Counter[str](), Counter[str]()
    if vocabulary:
        for hull, best, chance in zip(hulls, said.chances.argmax(axis=1), said.chances.max(axis=1), strict=True):
            if hull.annotation and chance >= weights.AGREED:
                total[hull.annotation.source] += 1
                right[hull.annotation.source] += hull.annotation.name == vocabulary[best]
    before, among = weights.RIGHT_BEFORE
    return {source: (right[source] + before * among) / (total[source] + among) for source in SOURCES}


def _standing(
    hull: Hull, chances: Floats, nearest: Ints, surest: Mapping[str, float], vocabulary: Sequence[str]
) -> Standing:
    by_label = dict(zip(vocabulary, chances.tolist(), strict=True))
    others = [label for label in vocabulary if label != hull.label]
    odds = {label: max(-weights.SUREST, _odds(hull, label, by_label, surest, len(others))) for label in others}
    return Standing(hull, odds, tuple(vocabulary[place] for place in nearest))


def _odds(hull: Hull, to: str, chances: Mapping[str, float], surest: Mapping[str, float], others: int) -> float:
    """The logarithm of the odds of the hull's label, or of having none, against another label."""
    if hull.annotation is None:
        return weights.UNLABELLED - math.log(chances[to])
    right = sureness(hull, surest)
    agreement = chances.get(hull.annotation.name, min(chances.values()))
    return math.log(right / (1 - right) * others) + math.log(agreement / chances[to])


def sureness(hull: Hull, surest: Mapping[str, float]) -> float:
    """The probability that a hull's label is right, looking at its source and confidence only."""
    assert hull.annotation
    if is_human(hull):
        return weights.HUMAN
    low, high = weights.SURE
    most = min(high, max(low, surest[hull.annotation.source]))
    return min(most, max(weights.UNSURE, hull.annotation.confidence))


def is_human(hull: Hull) -> bool:
    """Whether a person gave the label."""
    return hull.source in HUMAN_SOURCES
