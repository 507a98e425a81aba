"""The probability that the edit of each asset of a family is right, and what makes it doubtful: from readings, labels
and all that is odd about an asset to that of its program, that of its readings and that of its labels, each by a
logistic function (Platt 1999); and the threshold from which on an asset is signed off without a look, by conformal risk
control over families (Angelopoulos et al. 2024). All of it is fitted on sessions of calibration families
(`python -m benchmark.signoff fit`)."""

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any, Literal, Self

import numpy as np

from meshforge.checks.goals.base import GoalOutcome
from meshforge.common import format_share, join_names
from meshforge.geometry import Floats
from meshforge.language import Program, Template
from meshforge.signoff.question import ExclusionReason, ReviewQuestion, Selections
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Answer, Demonstration

WEIGHTS_FILE = "confidence.json"
WEIGHTS = (
    "readings, always",
    "candidates",
    "labels, always",
    "labels",
    "labels not demonstrated",
    "unlike the rest",
    "alarms",
)
"""What speaks for an edit: the first two for its readings, the others for its labels and all that is odd."""
LEAST, MOST = 0.0005, 0.9995
"""Bounds of what readings and labels say."""
BY_HAND = {"unlike the rest": -1.0, "alarms": -1.5}
"""Weights that are chosen, not fitted: calibration families hardly have such assets."""
NO_EDIT = 0.01
"""The probability of an edit that cannot be made."""
STANDS_OUT = 0.49
"""The most that the probability is of an edit that stands out: below any bar, so that a person looks at it first."""


@dataclass(frozen=True, eq=False, slots=True)
class Calibration:
    """weights: (len(WEIGHTS),); program, result: what speaks for a program as such, and for one that does what a person
    accepted or meant on an asset [nats]; threshold: the probability from which on an asset is signed off without a
    look; families: on which it rests; risk: the share of the assets of a family that are signed off and wrong, at most,
    as far as can be expected; goals: what speaks for an edit in a goal that then holds, by the one before [nats]."""

    weights: Floats
    program: float
    result: float
    threshold: float
    families: int
    risk: float
    goals: Mapping[str, float]


@cache
def read_calibration() -> Calibration:
    """Return what ships."""
    read = json.loads(files("meshforge.signoff").joinpath(WEIGHTS_FILE).read_text("utf-8"))
    weights = np.array([read["weights"][name] for name in WEIGHTS], dtype=float)
    weights.flags.writeable = False
    return Calibration(weights, *(read[one] for one in ("program", "result", "threshold", "families", "risk", "goals")))


def combine(features: Floats, weights: Floats) -> Floats:
    """Return the probability (n,) that edits are right under a program that is not wrong nearly everywhere: that each
    reading means there what it does, times that no other label would change it.

    features: (n, 5), of edits; weights: (len(WEIGHTS),).
    """
    candidates = weights[0] + weights[1] * features[..., 0]
    labels = weights[2] + features[..., 1:] @ weights[3:]
    found: Floats = 1 / (1 + np.exp(-candidates)) / (1 + np.exp(-labels))
    return found


@dataclass(frozen=True, slots=True)
class AssetEvidence:
    """What speaks for one edit.

    candidates: the probability that each rule means there what it does; labels: that no other labels would change the
    edit; unseen_labels: whether it has labels that no demonstration shows; outlier_score: how much farther than usual
    its strangest hull is from all hulls of other assets of which something is said; alarms: how many there are;
    program: the probability that the program is not wrong nearly everywhere.
    """

    candidates: float
    labels: float
    unseen_labels: float = 0.0
    outlier_score: float = 0.0
    alarms: float = 0.0
    program: float = 1.0

    @property
    def features(self) -> Floats:
        """The log odds of readings and labels, then what is odd (5,)."""
        return np.array(
            [_log_odds(self.candidates), _log_odds(self.labels), self.unseen_labels, self.outlier_score, self.alarms]
        )

    @property
    def probability(self) -> float:
        """That the edit is right."""
        found = self.program * float(combine(self.features, read_calibration().weights))
        return min(found, STANDS_OUT) if self.alarms else found

    def credit(self, *, candidates: float = 1.0, labels: float = 1.0, program: float = 1.0) -> float:
        """Return what it is worth to tell some of it, in edits that are right: the probability that this one is wrong,
        times the share of the doubt [nats] that is gone. What decides an edit is a conjunction: the last doubt of many
        alone makes it right, and yet each has to go.

        candidates, labels, program: by which these probabilities grow, as factors.
        """
        reason = -_log_of(self.candidates) - _log_of(self.labels) - _log_of(self.program)
        gone = math.log(candidates * labels * program)
        return (1 - self.probability) * min(1.0, gone / reason) if reason > 0 else 0.0


def _log_of(share: float) -> float:
    return math.log(max(LEAST, share))


def _log_odds(share: float) -> float:
    bounded = min(MOST, max(LEAST, share))
    return float(np.log(bounded / (1 - bounded)))


@dataclass(frozen=True, slots=True)
class ReviewState:
    """All that is known of a family.

    meshes: of the family, by name, with the labels that they have; lost: why others cannot be read; frame: the program
    without its rules; templates: by the paths that actions name; demos: of some of the meshes, by name; by_hand:
    whether a person wrote the program;
    answers: to questions of learning; meant: what each rule is to select by what a person said of results, by asset;
    failed: what it did select on results that they called wrong; accepted, corrected: assets whose result they accepted
    as it is now, or said what it is to be; wrong: those of which they only said that it is wrong; edited: those with
    edits by hand after the program; changed: those whose result is not the one that a person accepted; excluded: those
    that are given up; unconfirmed: sentences on what was shown on an
    asset and follows hulls that took the place of others, while no person has confirmed that; snoozed: ids of questions
    that are not asked again.
    """

    meshes: Mapping[str, SymbolicMesh]
    frame: Program
    templates: Mapping[str, Template] = field(default_factory=dict)
    demos: Mapping[str, Demonstration] = field(default_factory=dict)
    by_hand: bool = False
    answers: tuple[Answer, ...] = ()
    meant: Mapping[str, Selections] = field(default_factory=dict)
    accepted: frozenset[str] = frozenset()
    corrected: frozenset[str] = frozenset()
    failed: Mapping[str, Selections] = field(default_factory=dict)
    wrong: frozenset[str] = frozenset()
    edited: frozenset[str] = frozenset()
    changed: frozenset[str] = frozenset()
    excluded: Mapping[str, ExclusionReason] = field(default_factory=dict)
    snoozed: frozenset[str] = frozenset()
    lost: Mapping[str, str] = field(default_factory=dict)
    unconfirmed: Mapping[str, Sequence[str]] = field(default_factory=dict)

    @property
    def reviewed_assets(self) -> frozenset[str]:
        """The assets of which a person saw what the edit makes of them, or said what it is to make."""
        return frozenset((*self.demos, *self.accepted, *self.corrected))


THRESHOLD = read_calibration().threshold
"""The probability from which on an asset is signed off without being looked at, unless a person chooses another."""
MOST_REASONS = 6
"""Doubts of an asset that are named."""

_DIGITS = 4

ReasonKind = Literal["candidate", "label", "orientation", "outlier", "alarm", "goal"]


@dataclass(frozen=True, slots=True)
class Reason:
    """Why an edit may be wrong.

    text: one sentence; hulls: names of those concerned, on the asset; rule: its number, from 1, where it is about one;
    share: the probability, in 0..1, that the edit is wrong for this alone.
    """

    kind: ReasonKind
    text: str
    hulls: tuple[str, ...] = ()
    rule: int | None = None
    share: float = 0.0

    def to_json(self) -> dict[str, Any]:
        return {"kind": self.kind, "text": self.text, "hulls": list(self.hulls), "rule": self.rule}


@dataclass(frozen=True, slots=True)
class GoalStatus:
    """What is known of a goal on the result of an asset, as that is now.

    goal: its text; outcome: None where it was not tried; why, hulls: see `GoalResult`; before: its outcome before the
    edit; accepted: whether a person accepted the result though it fails; picture: the file of one, where it fails.
    """

    name: str
    goal: str
    outcome: GoalOutcome | None = None
    why: str = ""
    hulls: tuple[str, ...] = ()
    before: GoalOutcome | None = None
    accepted: bool = False
    picture: Path | None = None

    @property
    def fails(self) -> bool:
        """Whether it failed or broke, and nobody accepted that."""
        return self.outcome in ("failed", "broken") and not self.accepted

    @property
    def is_open(self) -> bool:
        """Whether it was not tried, or fails."""
        return self.outcome is None or self.fails

    def describe(self) -> str:
        """Return how it stands, in words."""
        if self.outcome is None:
            return f"goal {self.name} was not tried (meshforge apply)"
        words = {"failed": "fails", "broken": "could not be tried", "untried": "does not apply", "passed": "holds"}
        text = f"goal {self.name} {words[self.outcome]}{f': {self.why}' if self.why else ''}"
        return f"{text}; accepted all the same" if self.accepted else text

    def to_json(self) -> dict[str, Any]:
        """Return it as `status` says it in JSON."""
        names = ("name", "goal", "before", "why", "hulls", "accepted")
        found = {name: getattr(self, name) for name in names}
        picture = str(self.picture) if self.picture else None
        return {**found, "now": self.outcome, "hulls": list(self.hulls), "picture": picture}


ResultStatusWord = Literal["needs review", "sure", "signed off", "excluded"]
"""Sure: sure enough to be signed off, once its output is up to date."""
ResultState = ResultStatusWord | Literal["void", "unknown"]
"""Void: signed off, but something changed since; unknown: not reviewed as it is now."""


@dataclass(frozen=True, slots=True)
class ResultStatus:
    """How the result of one asset stands.

    probability: that its edit is right, in 0..1, None where that is not known; reasons: why it may be wrong, the
    weightiest first; state: whether it is signed off; by: by whom; void: what changed since it was; excluded: why it is
    given up; found_since: what was found after it was signed off, which stays so until a person answers; goals: what is
    known of them.
    """

    probability: float | None = None
    reasons: tuple[Reason, ...] = ()
    state: ResultState = "unknown"
    by: Literal["tool", "person"] | None = None
    void: tuple[str, ...] = ()
    excluded: ExclusionReason | None = None
    found_since: tuple[str, ...] = ()
    goals: tuple[GoalStatus, ...] = ()

    @property
    def open_goals(self) -> tuple[GoalStatus, ...]:
        """Those that fail or were not tried, and that nobody accepted."""
        return tuple(goal for goal in self.goals if goal.is_open)

    @property
    def confidence(self) -> float:
        """The probability, -1 where it is not known: what thresholds and orders compare."""
        return -1.0 if self.probability is None else self.probability

    @property
    def word(self) -> ResultStatusWord:
        """Its state, but that what is void or unknown needs review."""
        return "needs review" if self.state == "void" or self.state == "unknown" else self.state

    @property
    def needs_review(self) -> bool:
        """Whether it is to be looked at: neither sure enough nor excluded."""
        return self.word == "needs review"

    def with_reasons(self, more: Iterable[Reason]) -> Self:
        """Return the same with further doubts: it is at most as probable as that the weightiest of them is none."""
        more = list(more)
        known = self.probability
        probability = None if known is None else min([known, *(1 - one.share for one in more)])
        reasons = sorted([*self.reasons, *more], key=lambda one: -one.share)[:MOST_REASONS]
        return replace(self, probability=probability, reasons=tuple(reasons))

    def with_goals(self, goals: Sequence[GoalStatus]) -> Self:
        """Return the same with what is known of goals: one that fails is a doubt, and those that hold speak for it."""
        if not goals or self.excluded:
            return self
        weights, known, odds = read_calibration().goals, self.probability, 0.0
        for goal in goals:
            if goal.outcome == "passed" and goal.before:
                odds += weights.get(goal.before, 0.0)
        if known and odds and not any(reason.kind == "alarm" for reason in self.reasons):
            known = 1 / (1 + (1 - known) / known * math.exp(-odds))
        failing = [Reason("goal", one.describe(), one.hulls, share=1 - STANDS_OUT) for one in goals if one.fails]
        return replace(self, probability=known, goals=tuple(goals)).with_reasons(failing)

    def describe(self) -> str:
        """Return how it stands in words: how sure its result is, and whether it is signed off, and by whom."""
        if self.state == "void":
            return f"void, {join_names(self.void)} changed since it was signed off"
        if self.state == "unknown":
            return "not looked at as it is now (meshforge review)"
        share = "" if self.probability is None else f"{format_share(self.probability)} sure, "
        if self.state == "sure":
            return f"{share}signed off when its output is up to date (meshforge apply)"
        who = {"tool": " by MeshForge", "person": " by a person", None: ""}[self.by]
        since = f"; found since: {'; '.join(self.found_since)}" if self.found_since else ""
        goals = "".join(f"; {goal.describe()}" for goal in self.open_goals)
        return f"{share}{self.state}{who}{since}{goals}"

    def to_json(self) -> dict[str, Any]:
        """Return how sure its edit is, as `status`, `apply`, `review` and `info` say it in JSON."""
        share = None if self.probability is None else round(self.probability, _DIGITS)
        goals = {"goals": [goal.to_json() for goal in self.goals]} if self.goals else {}
        return {"probability": share, "reasons": [reason.to_json() for reason in self.reasons], **goals}


@dataclass(frozen=True, slots=True)
class Assessment:
    """A family as it stands. assets: by name, in the family's order; looked_at: those of which a person accepted the
    result, or said what it is; wrong: those of which they only said that it is wrong; excluded: those given up, those
    that are not of the family too; questions: all that could be asked now, what is worth most first; without_goals: the
    assets as they would stand if there were no goals.
    """

    assets: Mapping[str, ResultStatus]
    threshold: float = THRESHOLD
    looked_at: frozenset[str] = frozenset()
    wrong: frozenset[str] = frozenset()
    excluded: Mapping[str, ExclusionReason] = field(default_factory=dict)
    questions: tuple[ReviewQuestion, ...] = ()
    without_goals: Mapping[str, ResultStatus] = field(default_factory=dict)

    @property
    def question(self) -> ReviewQuestion | None:
        """The one that is worth most now, None where nothing is left to ask."""
        return next(iter(self.questions), None)

    @property
    def signed_off(self) -> tuple[str, ...]:
        """The assets at or above the bar, or looked at by a person; none that was called wrong or is given up."""
        away = {*self.excluded, *self.wrong}
        return tuple(
            name
            for name, one in self.assets.items()
            if name not in away and (name in self.looked_at or one.confidence >= self.threshold)
        )

    @property
    def need_review(self) -> tuple[str, ...]:
        """The assets that need a person's review, the least probable first."""
        rows = sorted((one.confidence, name) for name, one in self.assets.items())
        done = {*self.signed_off, *self.excluded}
        return tuple(name for _, name in rows if name not in done)

    @property
    def failures(self) -> Mapping[str, tuple[GoalStatus, ...]]:
        """Goals that fail on results, and that nobody accepted, by asset; not of those called wrong or given up."""
        rows = ((name, tuple(goal for goal in one.goals if goal.fails)) for name, one in self.assets.items())
        away = {*self.excluded, *self.wrong}
        return {name: goals for name, goals in rows if goals and name not in away}

    @property
    def is_done(self) -> bool:
        """Whether no asset needs review, and no goal fails."""
        return not self.need_review and not self.failures
