"""The probability that the edit of each asset of a family is right, and what makes it doubtful."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

from meshforge.language import Program, Template
from meshforge.signoff.confidence import read_calibration
from meshforge.signoff.question import ExclusionReason, ReviewQuestion, Selections
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Answer, Demonstration


@dataclass(frozen=True, slots=True)
class ReviewState:
    """All that is known of a family.

    meshes: of the family, by name, with the labels that they have; lost: why others cannot be read; frame: the program
    without its rules; templates: by the paths that actions name; demos: of some of the meshes, by name; by_hand:
    whether a person wrote the program;
    answers: to questions of learning; meant: what each rule is to select by what a person said of results, by asset;
    failed: what it did select on results that they called wrong; accepted, corrected: assets whose result they accepted
    as it is now, or said what it is to be; wrong: those of which they only said that it is wrong; edited: those with
    edits by hand after the program; excluded: those that are given up; unconfirmed: sentences on what was shown on an
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

ReasonKind = Literal["candidate", "label", "orientation", "outlier", "alarm"]


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
class AssetConfidence:
    """One asset. probability: that its edit is right, in 0..1; doubts: the weightiest first."""

    asset: str
    probability: float
    reasons: tuple[Reason, ...] = ()

    def with_reasons(self, more: Iterable[Reason]) -> AssetConfidence:
        """Return the same with further doubts: it is at most as probable as that the weightiest of them is none."""
        more = list(more)
        probability = min([self.probability, *(1 - one.share for one in more)])
        reasons = sorted([*self.reasons, *more], key=lambda one: -one.share)[:MOST_REASONS]
        return AssetConfidence(self.asset, probability, tuple(reasons))

    def to_json(self) -> dict[str, Any]:
        return {
            "probability": round(self.probability, _DIGITS),
            "reasons": [reason.to_json() for reason in self.reasons],
        }


@dataclass(frozen=True, slots=True)
class Assessment:
    """A family as it stands. assets: by name, in the family's order; looked_at: those of which a person accepted the
    result, or said what it is; wrong: those of which they only said that it is wrong; excluded: those given up, those
    that are not of the family too; questions: all that could be asked now, what is worth most first.
    """

    assets: Mapping[str, AssetConfidence]
    threshold: float = THRESHOLD
    looked_at: frozenset[str] = frozenset()
    wrong: frozenset[str] = frozenset()
    excluded: Mapping[str, ExclusionReason] = field(default_factory=dict)
    questions: tuple[ReviewQuestion, ...] = ()

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
            if name not in away and (name in self.looked_at or one.probability >= self.threshold)
        )

    @property
    def need_review(self) -> tuple[str, ...]:
        """The assets that need a person's review, the least probable first."""
        rows = sorted((one.probability, name) for name, one in self.assets.items())
        done = {*self.signed_off, *self.excluded}
        return tuple(name for _, name in rows if name not in done)

    @property
    def is_done(self) -> bool:
        """Whether no asset needs review."""
        return not self.need_review
