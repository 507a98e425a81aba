"""Looks for the orientation under which every rule has an extractor, and the extractors are smallest, among the
directives that a person would rather have first."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from meshforge import language
from meshforge.common import pluralize
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.options import TimeBudget
from meshforge.synthesis.orientation.attempts import OrientationSearch
from meshforge.synthesis.orientation.landmarks import Landmarks
from meshforge.synthesis.task import LearningTask

_LETTERS = "ZXY"  # up and down first
_UPWARD: Mapping[str, language.Direction] = {"X": "+X", "Y": "+Y", "Z": "+Z"}


class Directives:
    """Directives over a vocabulary whose landmarks are apart on every demonstrated mesh."""

    def __init__(self, shown: Sequence[SymbolicMesh], batch: Sequence[SymbolicMesh], vocabulary: Sequence[str]) -> None:
        demonstrated = {id(mesh) for mesh in shown}
        self._landmarks = Landmarks([*shown, *[mesh for mesh in batch if id(mesh) not in demonstrated]], vocabulary)
        self._shown = len(shown)
        ends = combinations(self._landmarks.bases, 2)
        self._ends = [(a, b) for a, b in ends if self._landmarks.apart(a, b)[: self._shown].all()]

    def with_one_pair(self) -> list[language.Orient]:
        """Return all with one pair, the preferred first."""
        pairs = [self._pair(a, b, _LETTERS) for a, b in self._ends]
        return self._sort(language.Orient((pair,), snap) for pair in pairs for snap in (False, True))

    def with_two_pairs(self, firsts: Iterable[language.LandmarkPair]) -> list[language.Orient]:
        """Return all with one of the given pairs and a second one, the preferred first."""
        both = [(first, second) for first in firsts for second in self._second_pairs(first)]
        return self._sort(language.Orient(pairs, snap) for pairs in both for snap in (False, True))

    def _second_pairs(self, first: language.LandmarkPair) -> list[language.LandmarkPair]:
        letters = _LETTERS.replace(first.axis[1], "")
        ends = [(a, b) for a, b in self._ends if {a, b} != {first.start, first.end}]
        return [self._pair(a, b, letters) for a, b in ends]

    def _pair(self, a: language.BaseExtractor, b: language.BaseExtractor, letters: str) -> language.LandmarkPair:
        """Two landmarks, with the axis of those letters that is nearest to their direction on most meshes.

        Both ways round give the same frame; the one with a positive axis is taken.
        """
        gaps = self._landmarks.directions(a, b)[self._landmarks.apart(a, b)]
        unit = np.round(gaps / np.linalg.norm(gaps, axis=1, keepdims=True), 9)[:, ["XYZ".index(k) for k in letters]]
        nearest = np.argmax(np.abs(unit), axis=1)
        votes = Counter(zip(nearest.tolist(), (unit[np.arange(len(unit)), nearest] >= 0).tolist(), strict=True))
        place, up = max(votes, key=lambda axis: (votes[axis], -axis[0], axis[1]))
        start, end = (a, b) if up else (b, a)
        return language.LandmarkPair(_UPWARD[letters[place]], start, end)

    def _sort(self, orients: Iterable[language.Orient]) -> list[language.Orient]:
        """Those that hold on every demonstrated mesh: plain before snap, then what holds on most of the batch."""
        rows = [
            (orient.snap, -int(holds[self._shown :].sum()), self._places(orient), orient)
            for orient, holds in [(orient, self._landmarks.holds(orient)) for orient in orients]
            if holds[: self._shown].all()
        ]
        return [orient for *_, orient in sorted(rows, key=lambda row: row[:3])]

    def _places(self, orient: language.Orient) -> list[list[int]]:
        """The places of the landmarks in the vocabulary, whichever way round they are written."""
        place = self._landmarks.place
        return [sorted([place(pair.start), place(pair.end)]) for pair in orient.pairs]


MIN_SAVING = 3
"""Nodes that another frame must save where the present one will do: an orientation costs the reader a line."""

MAX_EXTENDED = 4
"""How many of the pairs that come farthest a second one is added to: the others are no nearer to a common frame."""

OrientationFit = tuple[language.Orient, tuple[int, ...]]
"""A directive, and the nodes of each rule's smallest extractor in its frame."""

_STEPS = (5, 9)
"""Sizes up to which all frames are searched before one is searched further: a good frame shows early."""


@dataclass(frozen=True, slots=True)
class OrientationSuggestion:
    """An orientation that makes the demonstrations consistent, or the program clearly smaller.

    sizes: nodes of each rule's extractor in that frame; before: of each as it was learned now, empty where some rule
    has none; differs_on: names of the assets where the rules select something else than now; why: one sentence for
    the user.
    """

    orient: language.Orient
    sizes: tuple[int, ...]
    why: str
    before: tuple[int, ...] = ()
    differs_on: tuple[str, ...] = ()


def suggest_orientation(
    task: LearningTask, budget: TimeBudget, known: Sequence[language.Extractor] = ()
) -> OrientationSuggestion | None:
    """Return the directive under which the extractors of all rules have the fewest nodes, if it is clearly better than
    now.

    known: what learning found in the present frame, empty where some rule has no extractor. A pair that is given is
    kept where a second one, or `snap`, is enough. Raises OutOfTime.
    """
    sizes, most = tuple(map(language.size_of, known)), task.options.max_size
    limit = sum(sizes) - MIN_SAVING if sizes else len(task.rules) * most
    if "G" not in task.options.layers:
        return None
    search = OrientationSearch(task, budget, known)
    if limit < sum(search.floors):
        return None
    steps = sorted({min(step, most) for step in (*_STEPS, most)})
    directives = Directives([demo.mesh for demo in task.demos], [*task.batch.values()], task.frame.labels)
    best, given = None, task.frame.orient
    if given:
        second = directives.with_two_pairs(given.pairs) if len(given.pairs) == 1 else []
        best = _find_best(search, [replace(given, snap=not given.snap), *second], limit, steps)
    if not best and not (given and len(given.pairs) == 2):
        ones = directives.with_one_pair()
        best = _find_best(search, ones, limit, steps[:1])
        if not best or sum(best[1]) > sum(search.floors):  # two pairs may save further
            best = _find_best(search, [*ones, *directives.with_two_pairs(_farthest_pairs(search, ones))], limit, steps)
    return OrientationSuggestion(*best, explain_orientation(*best, sizes), sizes) if best else None


def _find_best(
    search: OrientationSearch, orients: Sequence[language.Orient], limit: int, steps: Sequence[int]
) -> OrientationFit | None:
    """The directive with the fewest nodes in all, at most `limit`; of equals the first. steps: nodes that an extractor
    may have, in one round after the other."""
    found: dict[tuple[int, int], OrientationFit] = {}
    for most in steps:
        for place, orient in enumerate(orients):
            if found:
                total, first = min(found)
                limit = total - (place > first)
            attempt = search.attempt(orient) if limit >= sum(search.floors) else None
            if attempt and attempt.learn(limit, most):
                found[sum(attempt.sizes), place] = orient, tuple(attempt.sizes)
    return found[min(found)] if found else None


def _farthest_pairs(search: OrientationSearch, orients: Sequence[language.Orient]) -> list[language.LandmarkPair]:
    """The pairs of the directives that came farthest, of equals the first."""
    tried = [(orient, attempt) for orient in orients if (attempt := search.attempt(orient))]
    tried.sort(key=lambda row: (-len(row[1].sizes), row[1].strays))
    return list(dict.fromkeys(orient.pairs[0] for orient, _ in tried))[:MAX_EXTENDED]


def explain_orientation(orient: language.Orient, found: Sequence[int], before: Sequence[int], assets: int = 0) -> str:
    """Return `in the frame where +Z points from the leg hulls to the panel hulls, every rule has an extractor, of ...`.

    found, before: nodes of each rule in that frame and now; assets: on which the rules select something else there.
    """
    nearly = "of quarter turns where, as nearly as can be," if orient.snap else "where"
    ends = [(pair.axis, *map(_describe_base, (pair.start, pair.end))) for pair in orient.pairs]
    frame = " and ".join(f"{axis} points from {start} to {end}" for axis, start, end in ends)
    now = f", instead of {_describe_sizes(before)} now" if before and tuple(before) != tuple(found) else ""
    rules = "the rule" if len(found) == 1 else "every rule"
    differs = f", and selects something else than now on {pluralize(assets, 'asset')}" if assets else ""
    return f"in the frame {nearly} {frame}, {rules} has an extractor, of {_describe_sizes(found)}{now}{differs}"


def _describe_base(base: language.BaseExtractor) -> str:
    return "the middle of all hulls" if isinstance(base, language.All) else base.phrase


def _describe_sizes(sizes: Sequence[int]) -> str:
    *others, last = sizes
    return f"{', '.join(map(str, others))} and {last} nodes" if others else pluralize(last, "node")
