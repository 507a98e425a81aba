"""Seeded draws for generators."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

import numpy as np

T = TypeVar("T")


class Draw:
    """Draws numbers; the same seed, the same numbers.

    attempt: from 1 on, other numbers than the seed's first ones, for an asset that is drawn again.
    """

    def __init__(self, *seed: int, attempt: int = 0) -> None:
        self.rng = np.random.default_rng([*seed, attempt] if attempt else list(seed))
        self.attempt = attempt

    def chance(self, share: float) -> bool:
        """True in that share of the draws."""
        return bool(self.rng.random() < share)

    def number(self, low: int, high: int) -> int:
        """A whole number from low to high, both included."""
        return int(self.rng.integers(low, high + 1))

    def length(self, low: float, high: float) -> float:
        """Uniform from low to high."""
        return float(self.rng.uniform(low, high))

    def ratio(self, low: float, high: float) -> float:
        """Uniform in the logarithm: for proportions, so that half and twice are alike."""
        return float(np.exp(self.rng.uniform(np.log(low), np.log(high))))

    def one(self, choices: Sequence[T]) -> T:
        """One of the choices."""
        return choices[int(self.rng.integers(len(choices)))]
