"""How a search is limited: the options of learning, and the budget of time that a search checks as it goes."""

import time
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Literal, get_args

from meshforge.language import EXTREMITY, Leaf
from meshforge.synthesis.demonstration import LabelFix

Layers = Literal["S", "S+T", "S+G", "S+T+G"]
LAYERS: tuple[Layers, ...] = get_args(Layers)
Strategy = Literal["default", "paper"]
STRATEGIES: tuple[Strategy, ...] = get_args(Strategy)
Clock = Callable[[], float]
"""Seconds from any fixed moment."""


@dataclass(frozen=True, slots=True)
class Options:
    """How to learn, and its limits.

    strategy: `paper` follows the algorithms of the paper to the letter, as a yardstick.
    layers: which extractors it may use besides set operators: semantic, topological, geometric (paper, ablation).
    repair: whether wrong labels are looked for; eta: corrections a mesh, over all rules, at most.
    max_size: in syntax nodes; budget: for the whole program [s].
    above: readings have up to so many nodes more than the smallest; effort: how many operands they may take to find.
    stored: up to this size every selection is kept in an index, beyond only goals are followed.
    few: the search begins with this many of the demonstrated groups of hulls; those that refute its answer join
    (0: all at once).
    contact, extremity: thresholds that the program is to set.
    suggest_orientation: whether landmarks that would help are looked for where no program fits.
    rejected: corrections that a person refused, so the labels stand.
    extractors: names of leaf extractors of plug-ins that rules may use, too; leaves: what `synthesize` enumerates of
    these for the family.
    stop: asked now and then; when it says so, what was found so far is returned, as when the time runs out.
    """

    strategy: Strategy = "default"
    layers: Layers = "S+T+G"
    repair: bool = True
    eta: int = 2
    max_size: int = 13
    budget: float = 120.0
    above: int = 4
    effort: int = 100_000
    stored: int = 5
    few: int = 48
    contact: float | None = None
    extremity: float | None = None
    suggest_orientation: bool = True
    rejected: Collection[LabelFix] = ()
    extractors: tuple[str, ...] = ()
    leaves: tuple[Leaf, ...] = ()
    clock: Clock = time.monotonic
    stop: Callable[[], bool] | None = None

    @property
    def geo_extremity(self) -> float:
        """The threshold of `Geo`: the language's own where none is set."""
        return EXTREMITY if self.extremity is None else self.extremity


class OutOfTime(Exception):  # noqa: N818 (not an error: the search's way out)
    """The budget is spent, or a person does not want to wait; caught by the learner."""


class TimeBudget:
    """Counts down from the moment it is made; stop: says whether to stop before."""

    __slots__ = ("_clock", "_end", "_start", "_stop")

    def __init__(self, budget: float, clock: Clock = time.monotonic, stop: Callable[[], bool] | None = None) -> None:
        self._clock, self._stop = clock, stop
        self._start = clock()
        self._end = self._start + budget

    def check(self) -> None:
        """Raise OutOfTime when the budget is spent."""
        if self._clock() >= self._end or (self._stop and self._stop()):
            raise OutOfTime

    @contextmanager
    def pause(self) -> Iterator[None]:
        """Stop the time while a person thinks."""
        began = self._clock()
        try:
            yield
        finally:
            away = self._clock() - began
            self._start, self._end = self._start + away, self._end + away

    @property
    def elapsed(self) -> float:
        """Time since the start [s]."""
        return self._clock() - self._start
