"""What learning is given: answers to the questions that a person is asked, corrections of labels, the options of a
search, and the budget of time that it checks as it goes."""

from __future__ import annotations

import time
from collections.abc import Callable, Collection, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Literal, get_args

from meshforge.common import DemonstrationError
from meshforge.language import EXTREMITY, Program


@dataclass(frozen=True, slots=True, order=True)
class LabelCorrection:
    """One hull of a demonstrated mesh gets another label; was: None where it has none.

    asset: how messages call the mesh.
    """

    asset: str
    hull: str
    was: str | None
    to: str

    @property
    def reverse(self) -> LabelCorrection | None:
        """The correction that undoes this one, None where the hull had no label."""
        return None if self.was is None else LabelCorrection(self.asset, self.hull, self.to, self.was)


@dataclass(frozen=True, slots=True)
class Choice:
    """One way to go on; reading: the id of the most believable reading that does so; select: names of hulls."""

    reading: str
    select: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Question:
    """Which hulls should a rule select on an asset? One of the choices, or neither.

    harm: the share of the assets that the program is expected to edit wrongly as it stands; left: after an answer.
    """

    rule: int
    asset: str
    choices: tuple[Choice, ...]
    harm: float
    left: float

    @property
    def id(self) -> str:
        return f"{self.rule}:{self.asset}"

    def answer_with(self, choice: int | None) -> Answer:
        """The answer that takes a choice, counted from 0, or None for neither.

        Raises DemonstrationError where there is no such choice.
        """
        if choice is not None and not 0 <= choice < len(self.choices):
            raise DemonstrationError(f"the question has {len(self.choices)} choices, and none at place {choice}")
        if choice is None:
            return Answer(self.rule, self.asset, None, [other.select for other in self.choices])
        return Answer(self.rule, self.asset, self.choices[choice].select)


@dataclass(frozen=True, slots=True, init=False)
class Answer:
    """What a person said: the hulls that a rule selects on an asset; None: neither of the choices.

    refused: where it is neither, the choices there were.
    """

    rule: int
    asset: str
    select: frozenset[str] | None
    refused: tuple[frozenset[str], ...] = ()

    def __init__(
        self, rule: int, asset: str, select: Iterable[str] | None, refused: Iterable[Iterable[str]] = ()
    ) -> None:
        if isinstance(select, str):
            problem = f"rule {rule}: an answer is a set of hull names, not the text {select!r}"
            raise DemonstrationError(problem, remedy=f"Write {{{select!r}}}.")
        object.__setattr__(self, "rule", rule)
        object.__setattr__(self, "asset", asset)
        object.__setattr__(self, "select", None if select is None else frozenset(select))
        object.__setattr__(self, "refused", tuple(map(frozenset, refused)))


@dataclass(frozen=True, slots=True)
class Repair:
    """A label that is probably wrong, with what would be right.

    rule: the first one that needs it; belief: that it is right, in 0..1; why: one sentence.
    """

    correction: LabelCorrection
    rule: int
    belief: float
    why: str


@dataclass(frozen=True, slots=True)
class Hint:
    """The asset that is best demonstrated next, and why, in a sentence."""

    asset: str
    why: str


Layers = Literal["S", "S+T", "S+G", "S+T+G"]
LAYERS: tuple[Layers, ...] = get_args(Layers)
Strategy = Literal["default", "paper"]
STRATEGIES: tuple[Strategy, ...] = get_args(Strategy)

Clock = Callable[[], float]
"""Seconds from any fixed moment."""


@dataclass(frozen=True, slots=True)
class Shortcuts:
    """Ways of doing less for the same answer; each can be switched off, to see that the answer stays the same.

    merge: of the extractors that select the same, only the first in the order is built upon.
    group: hulls that no extractor can tell apart count as one.
    complete: the missing operand of a set operator is looked up by what it must hold and avoid.
    help: an operand that brings its goal no nearer is passed over.
    stored: up to this size every selection is kept in an index, beyond only goals are followed.
    few: the search begins with this many of the demonstrated groups of hulls; those that refute its answer join
    (0: all at once).
    """

    merge: bool = True
    group: bool = True
    complete: bool = True
    help: bool = True
    stored: int = 5
    few: int = 48


@dataclass(frozen=True, slots=True)
class Options:
    """How to learn, and its limits.

    strategy: `paper` follows the algorithms of the paper to the letter, as a yardstick.
    layers: which extractors it may use besides set operators: semantic, topological, geometric (paper, ablation).
    repair: whether wrong labels are looked for; eta: corrections a mesh, over all rules, at most.
    max_size: in syntax nodes; budget: for the whole program [s].
    above: readings have up to so many nodes more than the smallest; effort: how many operands they may take to find.
    contact, extremity: thresholds that the program is to set.
    rejected: corrections that a person refused, so the labels stand.
    follow: a program somebody had in mind; the outcome says what became of each of its rules.
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
    shortcuts: Shortcuts = Shortcuts()
    contact: float | None = None
    extremity: float | None = None
    rejected: Collection[LabelCorrection] = ()
    follow: Program | None = None
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
        """While a person thinks, no time passes."""
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
