"""The orientation directives that are worth a try, in the order in which a person would rather have them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from itertools import combinations

import numpy as np
import numpy.typing as npt

from meshforge.geometry import Floats
from meshforge.language import All, BaseExtractor, Direction, Is, LandmarkPair, Orient
from meshforge.symbolic import SymbolicMesh

_LETTERS = "ZXY"  # up and down first
_UPWARD: Mapping[str, Direction] = {"X": "+X", "Y": "+Y", "Z": "+Z"}

APART = 0.02
"""Landmarks nearer than this share of the diagonal are not paired: how the hulls were cut may move them as far."""

Bools = npt.NDArray[np.bool_]


class Directives:
    """Directives over a vocabulary whose landmarks are apart on every demonstrated mesh."""

    def __init__(self, shown: Sequence[SymbolicMesh], batch: Sequence[SymbolicMesh], vocabulary: Sequence[str]) -> None:
        demonstrated = {id(mesh) for mesh in shown}
        others = [mesh for mesh in batch if id(mesh) not in demonstrated]
        self._landmarks = Landmarks([*shown, *others], vocabulary)
        self._shown = len(shown)
        ends = combinations(self._landmarks.bases, 2)
        self._ends = [(a, b) for a, b in ends if self._landmarks.apart(a, b)[: self._shown].all()]

    def with_one_pair(self) -> list[Orient]:
        """All with one pair, the preferred first."""
        pairs = [self._pair(a, b, _LETTERS) for a, b in self._ends]
        return self._sort(Orient((pair,), snap) for pair in pairs for snap in (False, True))

    def with_two_pairs(self, firsts: Iterable[LandmarkPair]) -> list[Orient]:
        """All with one of the given pairs and a second one, the preferred first."""
        both = [(first, second) for first in firsts for second in self._second_pairs(first)]
        return self._sort(Orient(pairs, snap) for pairs in both for snap in (False, True))

    def _second_pairs(self, first: LandmarkPair) -> list[LandmarkPair]:
        letters = _LETTERS.replace(first.axis[1], "")
        ends = [(a, b) for a, b in self._ends if {a, b} != {first.start, first.end}]
        return [self._pair(a, b, letters) for a, b in ends]

    def _pair(self, a: BaseExtractor, b: BaseExtractor, letters: str) -> LandmarkPair:
        """Two landmarks, with the axis of those letters that is nearest to their direction on most meshes.

        Both ways round give the same frame; the one with a positive axis is taken.
        """
        gaps = self._landmarks.directions(a, b)[self._landmarks.apart(a, b)]
        unit = np.round(gaps / np.linalg.norm(gaps, axis=1, keepdims=True), 9)[:, ["XYZ".index(k) for k in letters]]
        nearest = np.argmax(np.abs(unit), axis=1)
        upward = unit[np.arange(len(unit)), nearest] >= 0
        votes = Counter(zip(nearest.tolist(), upward.tolist(), strict=True))
        place, up = max(votes, key=lambda axis: (votes[axis], -axis[0], axis[1]))
        start, end = (a, b) if up else (b, a)
        return LandmarkPair(_UPWARD[letters[place]], start, end)

    def _sort(self, orients: Iterable[Orient]) -> list[Orient]:
        """Those that hold on every demonstrated mesh: plain before snap, then what holds on most of the batch."""
        held = [(orient, self._landmarks.holds(orient)) for orient in orients]
        rows = [
            (orient.snap, -int(holds[self._shown :].sum()), self._places(orient), orient)
            for orient, holds in held
            if holds[: self._shown].all()
        ]
        return [orient for *_, orient in sorted(rows, key=lambda row: row[:3])]

    def _places(self, orient: Orient) -> list[list[int]]:
        """The places of the landmarks in the vocabulary, whichever way round they are written."""
        place = self._landmarks.place
        return [sorted([place(pair.start), place(pair.end)]) for pair in orient.pairs]


class Landmarks:
    """The centres of all landmarks of some meshes, in the frames in which they came.

    bases: the labels in their order, then `All`.
    """

    def __init__(self, meshes: Sequence[SymbolicMesh], vocabulary: Sequence[str]) -> None:
        self.bases: tuple[BaseExtractor, ...] = (*map(Is, vocabulary), All())
        centres = [_centres(mesh, vocabulary) for mesh in meshes]
        self._centres = np.array(centres).reshape(len(meshes), len(self.bases), 3)
        self._least = APART * np.array([mesh.diagonal for mesh in meshes])

    def place(self, base: BaseExtractor) -> int:
        """The position of a base in their order."""
        return self.bases.index(base)

    def directions(self, start: BaseExtractor, end: BaseExtractor) -> Floats:
        """From the centre of one landmark to that of another on each mesh (n, 3) [m]; NaN where one is missing."""
        gap: Floats = self._centres[:, self.place(end)] - self._centres[:, self.place(start)]
        return gap

    def apart(self, start: BaseExtractor, end: BaseExtractor) -> Bools:
        """On which meshes both landmarks are present, and apart (n,)."""
        far: Bools = np.linalg.norm(self.directions(start, end), axis=1) >= self._least
        return far

    def holds(self, orient: Orient) -> Bools:
        """On which meshes the landmarks of a directive are apart, those of a second pair across the first (n,)."""
        first = orient.pairs[0]
        held = self.apart(first.start, first.end)
        for second in orient.pairs[1:]:
            held = held & self._across(first, second)
        return held

    def _across(self, first: LandmarkPair, second: LandmarkPair) -> Bools:
        one, other = (self.directions(pair.start, pair.end) for pair in (first, second))
        area = np.linalg.norm(np.cross(one, other), axis=1)
        far: Bools = area >= self._least * np.linalg.norm(one, axis=1)
        return far


def _centres(mesh: SymbolicMesh, vocabulary: Sequence[str]) -> Floats:
    """The volume-weighted centre of the hulls with each label, and of all (labels + 1, 3); NaN where there is none."""
    volumes = np.array([hull.volume for hull in mesh.hulls])
    moments = volumes[:, None] * np.array([hull.shape.centroid for hull in mesh.hulls]).reshape(-1, 3)
    labels = np.array([hull.label or "" for hull in mesh.hulls], dtype=np.str_)
    masks = [*(labels == label for label in vocabulary), np.ones(len(labels), dtype=np.bool_)]
    return np.array([_centre(volumes[mask], moments[mask]) for mask in masks])


def _centre(volumes: Floats, moments: Floats) -> Floats:
    total = float(volumes.sum())
    centre: Floats = moments.sum(axis=0) / total if total > 0 else np.full(3, np.nan)
    return centre
