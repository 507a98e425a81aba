"""Keeps the complete program that comes nearest to what was shown."""

from __future__ import annotations

from collections.abc import Sequence

from meshforge.language import Extractor
from meshforge.symbolic import bits
from meshforge.synthesis.paper.demo import Demo
from meshforge.synthesis.search.miss import NearMiss


class Nearest:
    """The extractor with the fewest differing hulls so far; of several, the first met."""

    def __init__(self, demos: Sequence[Demo]) -> None:
        self._demos = demos
        self._best: tuple[int, Extractor] | None = None

    def offer(self, extractor: Extractor) -> int:
        """In how many hulls an extractor differs from what was shown: 0 is a match."""
        count = sum(demo.differences(extractor).bit_count() for demo in self._demos)
        if self._best is None or count < self._best[0]:
            self._best = (count, extractor)
        return count

    def miss(self) -> NearMiss | None:
        """How the nearest differs on the mesh where it differs most, None when nothing was offered."""
        if self._best is None:
            return None
        extractor = self._best[1]
        worst = max(self._demos, key=lambda demo: demo.differences(extractor).bit_count())
        wrong = worst.differences(extractor)
        return NearMiss(
            extractor, worst.name, _names(worst, wrong & ~worst.target), _names(worst, wrong & worst.target)
        )


def _names(demo: Demo, mask: int) -> tuple[str, ...]:
    return tuple(demo.mesh.hulls[index].name for index in sorted(bits(mask)))
