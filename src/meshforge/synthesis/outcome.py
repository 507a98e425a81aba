"""What learning results in: a closed union whose members share the attributes that callers read, and its JSON."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Literal, Self

from meshforge.language import Extractor, Program, Rule, show, size_of
from meshforge.synthesis.demonstration import Answer, OpenRule, Repair
from meshforge.synthesis.orientation.suggest import OrientationSuggestion
from meshforge.synthesis.search.smallest import NearestExtractor, SearchEffort


@dataclass(frozen=True, slots=True)
class CandidateProgram:
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
        return size_of(self.extractor)


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

    @classmethod
    def of(cls, rule: int, miss: NearestExtractor) -> Self:
        return cls(rule, miss.extractor, miss.asset, miss.extra, miss.missing)


@dataclass(frozen=True, slots=True, kw_only=True)
class _OutcomeBase:
    """What all outcomes have.

    rules: those learned, in order; readings: of all of them, by rule, the most believable first; tried: how far the
    search of each rule went. seconds: under "search" and "replay".
    settled: whether all believable readings do the same on the whole batch; stale: answers that no longer fit, as
    their asset or hulls are gone; overruled: assets whose result was accepted, which no program keeps. suggested: an
    orientation that makes the rules simpler, or in which every rule has an extractor where now some rule has none.
    """

    rules: tuple[Rule, ...]
    candidates: tuple[CandidateProgram, ...]
    tried: tuple[SearchEffort, ...]
    seconds: Mapping[str, float]
    unambiguous: bool = False
    stale: tuple[Answer, ...] = ()
    overruled: tuple[str, ...] = ()
    repairs: tuple[Repair, ...] = ()
    open_rule: OpenRule | None = None
    nearest: Nearest | None = None
    program: Program | None = None
    suggested: OrientationSuggestion | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Found(_OutcomeBase):
    """A program that does on every demonstration what was shown; what is still open is not worth an answer."""

    status: ClassVar[Literal["found"]] = "found"
    program: Program


@dataclass(frozen=True, slots=True, kw_only=True)
class Ambiguous(_OutcomeBase):
    """A program that does what was shown, and a rule that may mean something else on other assets."""

    status: ClassVar[Literal["ambiguous"]] = "ambiguous"
    program: Program
    open_rule: OpenRule


@dataclass(frozen=True, slots=True, kw_only=True)
class NeedsRepair(_OutcomeBase):
    """Labels that are probably wrong: with them corrected the rules have believable extractors.

    proposed: what the program would be then, as far as all rules were found; nearest: of a rule that still has none.
    """

    status: ClassVar[Literal["repair"]] = "repair"
    proposed: Program | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class NoProgram(_OutcomeBase):
    """A rule that no extractor fits; why: one sentence about it; advice: what would help, a sentence each."""

    status: ClassVar[Literal["none"]] = "none"
    nearest: Nearest
    why: str
    advice: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class TimedOut(_OutcomeBase):
    """The time ran out, or a person stopped it, while a rule was searched for; the rules before it are there."""

    status: ClassVar[Literal["timeout"]] = "timeout"


LearningOutcome = Found | Ambiguous | NeedsRepair | NoProgram | TimedOut


def outcome_to_json(outcome: LearningOutcome) -> dict[str, Any]:
    """Return the outcome as `synthesize --json` prints it."""
    one = outcome.open_rule
    asked = one and {"rule": one.rule, "asset": one.asset, "selections": [sorted(some) for some in one.selections]}
    return {
        "status": outcome.status,
        "program": str(outcome.program) if outcome.program else None,
        "unambiguous": outcome.unambiguous,
        "candidates": [_candidate_json(candidate) for candidate in outcome.candidates],
        "repairs": [_repair_json(repair) for repair in outcome.repairs],
        "open_rule": asked,
        "nearest": _nearest_json(outcome.nearest) if outcome.nearest else None,
        "overruled": list(outcome.overruled),
        "stale_answers": [{"rule": answer.rule, "asset": answer.asset} for answer in outcome.stale],
        **({"why": outcome.why, "advice": list(outcome.advice)} if isinstance(outcome, NoProgram) else {}),
        **_suggestion_json(outcome.suggested),
        "seconds": dict(outcome.seconds),
    }


def _suggestion_json(suggested: OrientationSuggestion | None) -> dict[str, Any]:
    """The directive as text; its reason and its sizes beside it, where there is one."""
    if not suggested:
        return {"suggested_orientation": None}
    return {
        "suggested_orientation": show(suggested.orient),
        "suggested_because": {
            "why": suggested.why,
            "sizes": list(suggested.sizes),
            "sizes_before": list(suggested.before),
            "differs_on": list(suggested.differs_on),
        },
    }


def _candidate_json(candidate: CandidateProgram) -> dict[str, Any]:
    return {
        "id": candidate.id,
        "rule": candidate.rule,
        "extractor": show(candidate.extractor),
        "size": candidate.size,
        "belief": round(candidate.belief, 6),
        "differs_on": list(candidate.differs_on),
    }


def _repair_json(repair: Repair) -> dict[str, Any]:
    wrong = repair.fix
    return {
        "rule": repair.rule,
        "asset": wrong.asset,
        "hull": wrong.hull,
        "from": wrong.was,
        "to": wrong.to,
        "belief": round(repair.belief, 6),
        "why": repair.why,
    }


def _nearest_json(nearest: Nearest) -> dict[str, Any]:
    return {
        "rule": nearest.rule,
        "extractor": show(nearest.extractor),
        "asset": nearest.asset,
        "extra": list(nearest.extra),
        "missing": list(nearest.missing),
    }
