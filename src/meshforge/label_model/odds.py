"""How believable each label is against every other one, as hypotheses of repair see it.

Costs are in nats.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from meshforge.geometry import Floats
from meshforge.label_model.consensus import PERSON
from meshforge.label_model.lookalikes import PER_MESH
from meshforge.label_model.posterior import FamilyPosterior, model_family
from meshforge.symbolic import CERTAIN_SOURCES, GIVEN_SOURCES, NO_PART, Hull, SymbolicMesh

MAX_ODDS_FOR_FIX = 5.0
"""What may speak for a correction at most; look-alikes err too."""

PERSON_ODDS, FILE_ODDS = 1.5, 2.0
"""What speaks for a person's label, and for one in a file that somebody made, besides its probability [nats]."""

OTHERS_ON_PERSON = (2.0, 3.0)
"""What look-alikes say for or against a person's label counts so many times, and so much at most [nats]."""

NO_LABEL_COST = 1.5
"""Filling in a label where the hull has none, before look-alikes are asked."""

FIX_COST = 0.5
"""A correction, besides its improbability: so those are proposed that serve."""

SURE_ENOUGH = 0.2
"""A label that is wrong with no more than this probability does not count among those that are expected to be wrong: so
many of them add up where nothing is wrong."""

SMOOTHING = 0.0005
"""The share of each probability that is spread evenly over the vocabulary, so that no label is out of question."""

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

    demonstrated: by the names that examples have, before any rule; batch: all other meshes; those that are demonstrated
    too are left out.
    Hulls that rules made have no odds: what to correct is the label of what they were made from.
    """

    def __init__(
        self, demonstrated: Mapping[str, SymbolicMesh], batch: Mapping[str, SymbolicMesh], vocabulary: Sequence[str]
    ) -> None:
        shown = list(demonstrated.values())
        others = {name: mesh for name, mesh in batch.items() if not any(_is_same_asset(mesh, other) for other in shown)}
        every = {**demonstrated, **others}
        self._meshes = {name: every[name] for name in sorted(every)}
        annotations = (hull.annotation for mesh in self._meshes.values() for hull in mesh.hulls)
        has_none = any(label and label.name == NO_PART for label in annotations)
        self._vocabulary = (*vocabulary, NO_PART) if has_none else tuple(vocabulary)
        self._places = {name: place for place, name in enumerate(self._meshes)}
        self._shown = frozenset(demonstrated)
        self._known: dict[tuple[str, str], LabelOdds] = {}

    @cached_property
    def posterior(self) -> FamilyPosterior:
        """Of all meshes, by name."""
        meshes = list(self._meshes.values())
        words = set(self._vocabulary)
        observed = [hull.annotation for mesh in meshes for hull in mesh.hulls]
        return model_family(meshes).infer([label if label and label.name in words else None for label in observed])

    @cached_property
    def errors(self) -> Mapping[str, float]:
        """How many labels of each mesh are wrong or missing, as far as can be expected."""
        columns = {label: place for place, label in enumerate(self._vocabulary)}
        found = {}
        for name, mesh in self._meshes.items():
            chances = self._over_vocabulary(name, self.posterior.chances)
            own = [columns.get(hull.label or NO_PART) for hull in mesh.hulls]
            found[name] = sum(
                1.0 if place is None else _error(hull, float(row[place]))
                for hull, row, place in zip(mesh.hulls, chances, own, strict=True)
            )
        return found

    def odds_of(self, asset: str, hull: Hull) -> LabelOdds | None:
        """Return of a hull as a rule meets it; None for one that was made, or relabelled, on the way."""
        if asset not in self._shown or hull.parent is not None:
            return None
        mesh = self._meshes[asset]
        row = mesh.index.get(hull.name)
        if row is None or mesh.hulls[row].annotation != hull.annotation:
            return None
        if (asset, hull.name) not in self._known:
            self._known[asset, hull.name] = self._compute_odds(asset, mesh.hulls[row], row)
        return self._known[asset, hull.name]

    def odds(self, asset: str, hull: Hull, to: str) -> float:
        """Return the odds for the hull's label against the label `to` [nats]; infinite where it has none."""
        found = self.odds_of(asset, hull)
        return found.odds.get(to, math.inf) if found else math.inf

    def cost(self, asset: str, hull: Hull, to: str) -> float:
        """Return the cost of the hypothesis that the hull is to be labelled `to` [nats], never below 0."""
        odds = self.odds(asset, hull, to)
        return odds if odds > 30 else math.log1p(math.exp(odds)) + FIX_COST

    def _over_vocabulary(self, asset: str, chances: Floats) -> Floats:
        """Probabilities of the hulls of an asset over the vocabulary (hulls, labels), none of which is 0."""
        posterior = self.posterior
        rows = chances[posterior.table.spans.get(self._places[asset], slice(0, 0))]
        count = max(1, len(self._vocabulary))
        found = np.full((len(rows), count), SMOOTHING / count)
        if rows.shape[1]:
            columns = [self._vocabulary.index(label) for label in posterior.seen.labels]
            found[:, columns] += (1 - SMOOTHING) * rows
        else:
            found[:] = 1 / count
        return found

    def _compute_odds(self, asset: str, hull: Hull, row: int) -> LabelOdds:
        posterior = self.posterior
        chances = self._over_vocabulary(asset, posterior.by_others if is_human(hull) else posterior.chances)[row]
        by_label = dict(zip(self._vocabulary, chances.tolist(), strict=True))
        own = by_label.get(hull.label or NO_PART, min(by_label.values(), default=1.0))
        others = [label for label in self._vocabulary if label != (hull.label or NO_PART)]
        log_odds = {label: _log_odds(hull, own / by_label[label], len(others)) for label in others}
        odds = {label: max(-MAX_ODDS_FOR_FIX, one) for label, one in log_odds.items()}
        return LabelOdds(hull, odds, self._similar(asset, row))

    def _similar(self, asset: str, row: int) -> tuple[str, ...]:
        posterior = self.posterior
        seen, place = posterior.seen, posterior.table.spans[self._places[asset]].start + row
        found = posterior.table.find_lookalikes(seen).nearest_of(place, seen.known, MAX_MENTIONED, PER_MESH)
        return tuple(seen.labels[seen.codes[other]] for other in found)


def _log_odds(hull: Hull, ratio: float, others: int) -> float:
    """The odds for the hull's label, or none, against another [nats]; ratio: of their probabilities."""
    if hull.annotation is None:
        return NO_LABEL_COST + math.log(ratio)
    if not is_human(hull):
        return math.log(ratio) + FILE_ODDS * (hull.source in GIVEN_SOURCES)
    times, most = OTHERS_ON_PERSON
    return math.log(PERSON / (1 - PERSON) * others) + PERSON_ODDS + min(most, max(-most, times * math.log(ratio)))


def _error(hull: Hull, own: float) -> float:
    """How much a label counts as wrong; own: its probability."""
    if is_human(hull):
        return 1 - PERSON
    return max(0.0, 1 - own - SURE_ENOUGH) / (1 - SURE_ENOUGH)


def _is_same_asset(mesh: SymbolicMesh, other: SymbolicMesh) -> bool:
    if mesh is other:
        return True
    return mesh.asset is not None and other.asset is not None and mesh.asset.path == other.asset.path


def is_human(hull: Hull) -> bool:
    """Return whether a person gave the label, or showed what the hull is."""
    return hull.source in CERTAIN_SOURCES
