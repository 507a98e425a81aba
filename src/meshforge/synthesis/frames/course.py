"""How far learning comes in one frame."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from meshforge.errors import MeshForgeError
from meshforge.language import Extractor, size
from meshforge.synthesis.frames.sight import Met
from meshforge.synthesis.replay import Replay

if TYPE_CHECKING:
    from meshforge.synthesis.frames.lesson import Lesson


class Course:
    """One frame's rules, learned one by one, each with its smallest extractor.

    sizes: nodes of those learned so far; strays: hulls that no extractor of the next rule can get right.
    """

    def __init__(self, lesson: Lesson, replays: Sequence[Replay]) -> None:
        self._search, self._replays = lesson, list(replays)
        self._next: Met | None = None
        self.sizes: list[int] = []
        self.strays = 0
        self._over = False

    @property
    def is_done(self) -> bool:
        """Whether every rule has an extractor."""
        return len(self.sizes) == len(self._search.rules)

    def learn(self, limit: int, most: int) -> bool:
        """Learn on; whether every rule has an extractor, of at most `limit` nodes in all and `most` each."""
        while not self._over and not self.is_done:
            others = sum(self._search.floors[len(self.sizes) + 1 :])
            room = min(most, limit - sum(self.sizes) - others)
            if room < self._search.floors[len(self.sizes)] or not self._learn_next(room):
                break
        return self.is_done and sum(self.sizes) <= limit

    def _learn_next(self, most: int) -> bool:
        """Whether the next rule has an extractor of at most so many nodes; if so, it is applied."""
        rule = self._search.rules[len(self.sizes)]
        try:
            self._next = self._next or self._search.analyze(rule, self._replays)
            extractor = self._search.find_smallest(self._next, most)
            if extractor:
                self._apply(extractor)
            elif self._next.strays:
                self.strays = self._next.strays
                self._stop()
        except MeshForgeError:  # what was shown cannot be done in this frame
            self._stop()
            return False
        return extractor is not None

    def _apply(self, extractor: Extractor) -> None:
        rule, self._next = self._search.rules[len(self.sizes)], None
        self._replays = self._search.advance(self._replays, rule, extractor)
        self.sizes.append(size(extractor))

    def _stop(self) -> None:
        self._over, self._next, self._replays = True, None, []  # there may be hundreds of courses
