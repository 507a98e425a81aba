"""The orientation directives that are worth a try, in the order in which a person would rather have them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from itertools import combinations

import numpy as np

from meshforge.language import Base, Direction, LandmarkPair, Orient
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.frames.landmarks import Landmarks

_LETTERS = "ZXY"  # up and down first
_UPWARD: Mapping[str, Direction] = {"X": "+X", "Y": "+Y", "Z": "+Z"}


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

    def _pair(self, a: Base, b: Base, letters: str) -> LandmarkPair:
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
