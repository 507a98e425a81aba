"""What all that is known of a family says about the label of each hull."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property, lru_cache
from typing import Literal

import numpy as np

from meshforge.geometry import Floats, Ints
from meshforge.label_model.consensus import infer_chances
from meshforge.label_model.describe import SHAPE_COLUMNS, MeshDescriber, describe_mesh, digest_mesh
from meshforge.label_model.sides import choose_sides, find_doubtful_sides
from meshforge.label_model.similar import estimate_seconds
from meshforge.label_model.table import NO_LABEL, Bools, FamilyTable, Observations, evidence_of, read_weights
from meshforge.label_model.ties import first_greatest, pick_evenly
from meshforge.symbolic import LABEL_SOURCES, Label, LabelSource, SymbolicMesh

_HULLS, _MESHES = 3000, 2000  # that are compared at most, evenly chosen of more
_NEAR = 0.35  # of the median distance of hulls, within which they stand for each other
_AT_LEAST = 0.1  # what a hull counts whose label is certain; one about which nothing is known counts so much and one

_DIGITS = 3
CONFIDENCE_FILE = "confidence.json"
MOST_LIKELY = 0.89
"""How sure a label is at most that follows from hulls of another family alone."""
_FREE_ODDS = 1.5  # odds of what was said from which on another label must be surer [nats]
_ALIKE = 0.6  # probability of each of two labels on hulls called the other, together, from which they look alike
_BOTH = 0.1  # of the meshes that have the rarer of them, those that may have both
_TINY = 1e-12
_REMEMBERED = 2000  # meshes whose other sides are not described again


def to_confidence(chances: Floats, by: Literal["family", "like"] = "family") -> Floats:
    """Return how often labels of such chances are right in families that the model was not fitted on (logistic
    regression on the log odds, Platt 1999): beside labelled assets of the same family, or of another one."""
    level, slope = read_weights(CONFIDENCE_FILE)[int(by == "like")]
    bounded = np.clip(chances, _TINY, 1 - _TINY)
    found: Floats = 1 / (1 + np.exp(-level - slope * np.log(bounded / (1 - bounded))))
    return found


@dataclass(frozen=True, eq=False)
class FamilyPosterior:
    """The probability of each label for each hull. seen: what is said of labels; chances: (hulls of all meshes,
    labels of `seen`); by_others: the same but for what is said of the hull itself.
    """

    table: FamilyTable
    seen: Observations
    chances: Floats
    by_others: Floats

    @staticmethod
    def of(table: FamilyTable, seen: Observations) -> "FamilyPosterior":
        """Return that of a family whose meshes stand upright."""
        if not seen.labels or not len(table.owner):
            nothing = np.zeros((len(table.owner), 0))
            return FamilyPosterior(table, seen, nothing, nothing)
        return FamilyPosterior(table, seen, *infer_chances(table, seen))

    def discount_rebuilt(self) -> "FamilyPosterior":
        """Return the same, with the label of a rebuilt hull no surer than the rebuild was, or than others make it.

        Labels of a rebuild follow from one inference over the family: where it errs, they agree in their error.
        """
        rebuilt = self.seen.rebuilt
        if not rebuilt.any():
            return self
        without = replace(self.seen, codes=np.where(rebuilt, NO_LABEL, self.seen.codes))
        others = infer_chances(self.table, without)[0]
        return replace(self, chances=_bound_rebuilt(self.seen, self.chances, others))

    def weigh(self, evidence: Floats) -> "FamilyPosterior":
        """Return the same with more evidence (n, labels) [nats] on labels, which counts for look-alikes too."""
        chances, by_others = infer_chances(self.table, self.seen, evidence=evidence)
        return replace(self, chances=chances, by_others=by_others)

    def chances_of(self, mesh: int) -> Floats:
        """Return those of the hulls of one mesh, in their order."""
        return self.chances[self.table.spans.get(mesh, slice(0, 0))]

    def labels(self, mesh: int, source: LabelSource = "propagated") -> list[Label | None]:
        """Return the likeliest label of each hull of a mesh, with its confidence; None where no label is known."""
        rows = self.chances_of(mesh)
        if not self.seen.labels:
            return [None] * len(rows)
        found = zip(first_greatest(rows).tolist(), np.minimum(to_confidence(rows), self._most), strict=True)
        return [Label(self.seen.labels[place], round(float(row[place]), _DIGITS), source) for place, row in found]

    @cached_property
    def _most(self) -> Floats:
        """How sure each label may be (labels,)."""
        like, count = self.seen.sources == LABEL_SOURCES.index("like"), len(self.seen.labels)
        theirs, ours = (np.bincount(self.seen.codes[self.seen.known & one], minlength=count) for one in (like, ~like))
        return np.where((theirs > 0) & (ours == 0), MOST_LIKELY, 1.0)

    @cached_property
    def margin(self) -> float:
        """By how much another label must be more probable than the one that was said to take its place [nats]: the more
        the fewer of those that were said are wrong, so that right labels are left alone."""
        free = self.seen.known & ~self.seen.fixed
        if not free.any():
            return 0.0
        right = float(self.chances[np.flatnonzero(free), self.seen.codes[free]].mean())
        return max(0.0, math.log(right / max(1 - right, 1e-9)) - _FREE_ODDS)

    def agree(self, observed: Sequence[Label | None]) -> list[Label | None]:
        """Return the labels of all hulls by all that is known: what was said, but where another label is surer, and
        where nothing was said. What a person said stays, and a label of a file that no other mesh has.

        said: the annotations of all hulls, as `seen` was made from.
        """
        best = first_greatest(self.chances) if self.seen.labels else np.zeros(len(observed), dtype=np.int64)
        rows = zip(best.tolist(), observed, strict=True)
        return [self._agree_on(hull, place, label) for hull, (place, label) in enumerate(rows)]

    @cached_property
    def _presence(self) -> Floats:
        """Whether each label is said of a hull of each mesh of which anything is said (meshes, labels)."""
        known = self.seen.known
        _, mesh = np.unique(self.table.owner[known], return_inverse=True)
        found = np.zeros((int(mesh.max(initial=-1)) + 1, len(self.seen.labels)))
        found[mesh, self.seen.codes[known]] = 1.0
        return found

    @cached_property
    def _is_fixed(self) -> Bools:
        """Whether what was said of each hull stays whatever others say (n,): a person's label; that of a rebuilt hull,
        of which the surface says more than the shape; and of those in files one that a single mesh has, since hulls of
        other meshes cannot speak for it."""
        alone = self._presence.sum(axis=0) == 1
        fixed_hulls: Bools = self.seen.fixed | self.seen.rebuilt | (self.seen.given & alone[self.seen.codes])
        return fixed_hulls

    def _agree_on(self, hull: int, best: int, observed: Label | None) -> Label | None:
        code = int(self.seen.codes[hull])
        given = evidence_of(observed) if code != NO_LABEL else None
        if not self.seen.labels or best == code or self._is_fixed[hull]:
            return given or observed
        chance = float(self.chances[hull, best])
        if code != NO_LABEL and math.log(chance / max(float(self.chances[hull, code]), 1e-12)) < self.margin:
            return given or observed
        sure = min(float(to_confidence(self.chances[hull, best])), float(self._most[best]))
        return Label(self.seen.labels[best], round(sure, _DIGITS), "propagated", given)

    def find_alike_labels(self) -> tuple[tuple[str, str], ...]:
        """Return pairs of labels on hulls that look alike, of which hardly any mesh has both: two names of one part?"""
        codes, has = self.seen.codes, self._presence
        taken = np.zeros((has.shape[1], has.shape[1]))
        for code in range(len(taken)):
            taken[code] = self.by_others[codes == code].mean(axis=0)
        fewer = np.minimum.outer(has.sum(axis=0), has.sum(axis=0))
        is_alike = (taken + taken.T > _ALIKE) & (has.T @ has <= _BOTH * fewer) & (fewer > 1)
        return tuple(
            (self.seen.labels[one], self.seen.labels[other])
            for one, other in np.argwhere(np.triu(is_alike, 1)).tolist()
        )

    def next_to_label(self, count: int = 1, below: int | None = None) -> list[int]:
        """Return the meshes to label next, the best first: those that tell most for each second that labelling takes.

        None whose hulls all have given labels, and none of a number of `below` or more.
        """
        from scipy.spatial.distance import cdist  # lazy: 0.5 s, half of all imports

        table, seen = self.table, self.seen
        numbers = np.unique(table.owner[~seen.given])
        open_meshes = pick_evenly(numbers if below is None else numbers[numbers < below], _MESHES)
        rows = table.rows[:, SHAPE_COLUMNS]
        compared = pick_evenly(np.arange(len(rows)), _HULLS)
        some, reason = rows[compared], 1 + _AT_LEAST - self.chances[compared].max(axis=1, initial=0.0)
        if not len(open_meshes):
            return []
        near = max(float(np.median(cdist(some, some), overwrite_input=True)) * _NEAR, 1e-9)

        def alike(hulls: slice | Ints) -> Floats:
            """How much the best of some hulls is like each that is compared."""
            found: Floats = np.exp(-((cdist(rows[hulls], some) / near) ** 2) / 2).max(axis=0, initial=0.0)
            return found

        covered = alike(pick_evenly(np.flatnonzero(seen.given), _HULLS))
        spans = [table.spans[mesh] for mesh in open_meshes.tolist()]
        stands = np.stack([alike(span) for span in spans])
        seconds = [estimate_seconds(table, span.start + np.flatnonzero(~seen.given[span])) for span in spans]
        found: list[int] = []
        for _ in range(min(count, len(open_meshes))):
            more = stands - covered
            gains = np.multiply(np.maximum(more, 0.0, out=more), reason, out=more).sum(axis=1) / seconds
            gains[found] = -1.0
            found.append(int(first_greatest(gains)))
            covered = np.maximum(covered, stands[found[-1]])
        return [int(open_meshes[place]) for place in found]


def _bound_rebuilt(seen: Observations, chances: Floats, others: Floats) -> Floats:
    """Chances (n, labels) with those of rebuilt hulls at most what the rebuild had, or others (n, labels) have."""
    bounded, rows = chances.copy(), np.flatnonzero(seen.rebuilt)
    codes = seen.codes[rows]
    observed, most = chances[rows, codes], np.maximum(seen.confidence[rows], others[rows, codes])
    less = observed > most
    rows, codes, observed, most = rows[less], codes[less], observed[less], most[less]
    bounded[rows] *= ((1 - most) / np.maximum(1 - observed, _TINY))[:, None]
    bounded[rows, codes] = most
    return bounded


class FamilyModel:
    """Meshes of one kind, described once; what is said of their labels can then be weighed again and again.

    metric: the weight of each column of a description, None for the one that ships.
    """

    def __init__(self, meshes: Sequence[SymbolicMesh], metric: Floats | None = None) -> None:
        descriptors = [describe_mesh(mesh) for mesh in meshes]
        self.table = FamilyTable.of([(one.rows, one.touching) for one in descriptors], metric)
        self._sides = [one.sides for one in descriptors]
        self._closely = lru_cache(_REMEMBERED)(lambda mesh: cache(MeshDescriber(meshes[mesh]).describe_side))
        self._turned: dict[tuple[tuple[int, int], ...], FamilyTable] = {}
        self._inferred: dict[tuple[tuple[Label | None, ...], tuple[str, ...]], FamilyPosterior] = {}

    def infer(self, labels: Sequence[Label | None], vocabulary: Sequence[str] = ()) -> FamilyPosterior:
        """Return what labels, one or None for each hull of all meshes, say about all hulls, these included.

        vocabulary: labels that hulls may have though nothing says so yet.

        The same family in the same order gives the same, bit for bit, on any processor. Meshes may lie anyhow about the
        upright axis of their files, at any size and place, tilted by up to some 40 degrees, or on their side. What was
        inferred last is kept.
        """
        key = tuple(labels), tuple(vocabulary)
        if key not in self._inferred:
            seen = Observations.of(*key)
            self._inferred = {key: FamilyPosterior.of(self._set_upright(seen), seen)}
        return self._inferred[key]

    def _set_upright(self, seen: Observations) -> FamilyTable:
        """The table with fallen meshes turned; the one made last is kept, with the look-alikes found in it."""
        found = find_doubtful_sides(self.table, seen, self._sides.__getitem__)
        doubtful = {mesh: sides for mesh, sides in found if sides}
        rows = {mesh: [self._closely(mesh)(side) for side in sides] for mesh, sides in doubtful.items()}
        chosen = choose_sides(self.table, seen, rows)
        if not chosen:
            return self.table
        key = tuple((mesh, doubtful[mesh][place]) for mesh, place in chosen.items())
        if key not in self._turned:
            turned = ((self.table.spans[mesh], self.table.scale(rows[mesh][place])) for mesh, place in chosen.items())
            self._turned = {key: self.table.turn(turned)}
        return self._turned[key]


def model_family(meshes: Sequence[SymbolicMesh]) -> FamilyModel:
    """Return the model of some meshes; that of the same hulls with other labels is not made again, of the last few
    families.

    What it keeps of meshes holds for these, whatever their labels.
    """
    key = tuple(map(digest_mesh, meshes))
    if key not in _models:
        if len(_models) >= _FAMILIES:
            del _models[next(iter(_models))]
        _models[key] = FamilyModel(meshes)
    return _models[key]


_FAMILIES = 4  # whose models are kept
_models: dict[tuple[bytes, ...], FamilyModel] = {}
