"""Tries directives one after the other, none further than it can still win."""

from __future__ import annotations

from collections.abc import Sequence

from meshforge.language import LandmarkPair, Orient
from meshforge.synthesis.frames.lesson import Lesson

Fit = tuple[Orient, tuple[int, ...]]
"""A directive, and the nodes of each rule's smallest extractor in its frame."""

_STEPS = (5, 9)
"""Sizes up to which all frames are searched before one is searched further: a good frame shows early."""


class Trials:
    """What became of the directives that were tried; most: nodes that an extractor may have."""

    def __init__(self, lesson: Lesson, most: int) -> None:
        self._search = lesson
        self._steps = sorted({min(step, most) for step in (*_STEPS, most)})

    def best(self, orients: Sequence[Orient], limit: int) -> Fit | None:
        """The directive with the fewest nodes in all, at most `limit`; of equals the first. Raises OutOfTime."""
        return self._best(orients, limit, self._steps)

    def best_of_small(self, orients: Sequence[Orient], limit: int) -> Fit | None:
        """The same among small extractors only."""
        return self._best(orients, limit, self._steps[:1])

    def _best(self, orients: Sequence[Orient], limit: int, steps: Sequence[int]) -> Fit | None:
        found: dict[tuple[int, int], Fit] = {}
        for most in steps:
            for place, orient in enumerate(orients):
                if found:
                    total, first = min(found)
                    limit = total - (place > first)
                course = self._search.attempt(orient) if limit >= sum(self._search.floors) else None
                if course and course.learn(limit, most):
                    found[sum(course.sizes), place] = orient, tuple(course.sizes)
        return found[min(found)] if found else None

    def is_optimal(self, fit: Fit) -> bool:
        """Whether no directive can need fewer nodes."""
        return sum(fit[1]) <= sum(self._search.floors)

    def farthest_pairs(self, orients: Sequence[Orient], count: int) -> list[LandmarkPair]:
        """The pairs of the directives that came farthest, of equals the first."""
        tried = [(orient, course) for orient in orients if (course := self._search.attempt(orient))]
        tried.sort(key=lambda row: (-len(row[1].sizes), row[1].strays))
        return list(dict.fromkeys(orient.pairs[0] for orient, _ in tried))[:count]
