"""What learning comes to: a closed union whose members share the attributes that callers read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Literal

from meshforge.language import Extractor, Program, Rule, size
from meshforge.synthesis.asking import Answer, Hint, Question, Repair
from meshforge.synthesis.frames import Suggested
from meshforge.synthesis.search import Tried


@dataclass(frozen=True, slots=True)
class Reading:
    """One extractor that agrees with all demonstrations of a rule.

    belief: its share, in 0..1, of the belief in all readings of the rule; differs_on: names of the assets where it
    selects something else than the reading that the program has.
    """

    id: str
    rule: int
    extractor: Extractor
    belief: float
    differs_on: tuple[str, ...] = ()

    @property
    def size(self) -> int:
        """Syntax nodes of the extractor."""
        return size(self.extractor)


@dataclass(frozen=True, slots=True)
class Nearest:
    """The extractor that came nearest for a rule that has none, and how it differs on one demonstrated mesh.

    extra: names of hulls it selects though they were not shown; missing: names of those it leaves out.
    """

    rule: int
    extractor: Extractor
    asset: str
    extra: tuple[str, ...]
    missing: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Outcome:
    """What all outcomes have.

    rules: those learned, in order; readings: of all of them, by rule, the most believable first; tried: how far the
    search of each rule went. seconds: under "search" and "replay".
    settled: whether all believable readings do the same on the whole batch; stale: answers that no longer fit, as
    their asset or hulls are gone; hint: what to demonstrate next; sample: the assets whose results tell best whether
    the program is what is meant, most telling first; overruled: assets whose result was accepted, which no program
    keeps. followed: what became of a program that was to be followed, a sentence each.
    """

    rules: tuple[Rule, ...]
    readings: tuple[Reading, ...]
    tried: tuple[Tried, ...]
    seconds: Mapping[str, float]
    settled: bool = False
    stale: tuple[Answer, ...] = ()
    hint: Hint | None = None
    sample: tuple[str, ...] = ()
    overruled: tuple[str, ...] = ()
    followed: tuple[str, ...] = ()
    repairs: tuple[Repair, ...] = ()
    question: Question | None = None
    nearest: Nearest | None = None
    program: Program | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Found(_Outcome):
    """A program that does on every demonstration what was shown; what is still open is not worth a question."""

    status: ClassVar[Literal["found"]] = "found"
    program: Program


@dataclass(frozen=True, slots=True, kw_only=True)
class Ambiguous(_Outcome):
    """A program that does what was shown, and a question that may change what it does elsewhere."""

    status: ClassVar[Literal["ambiguous"]] = "ambiguous"
    program: Program
    question: Question


@dataclass(frozen=True, slots=True, kw_only=True)
class NeedsRepair(_Outcome):
    """Labels that are probably wrong: with them corrected the rules have believable extractors.

    proposed: what the program would be then, as far as all rules were found; nearest: of a rule that still has none.
    """

    status: ClassVar[Literal["repair"]] = "repair"
    proposed: Program | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class NoProgram(_Outcome):
    """A rule that no extractor fits; why: one sentence about it; advice: what would help, a sentence each.

    suggested: an orientation in which every rule has an extractor.
    """

    status: ClassVar[Literal["none"]] = "none"
    nearest: Nearest
    why: str
    advice: tuple[str, ...] = ()
    suggested: Suggested | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class TimedOut(_Outcome):
    """The time ran out, or a person stopped it, while a rule was searched for; the rules before it are there."""

    status: ClassVar[Literal["timeout"]] = "timeout"


Outcome = Found | Ambiguous | NeedsRepair | NoProgram | TimedOut
