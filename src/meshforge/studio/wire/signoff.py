"""How sure the edit of each asset is, why it may be wrong, and the question that is worth most."""

from __future__ import annotations

from typing import Literal

from meshforge.studio.wire import Wire

ReasonKind = Literal["candidate", "label", "orientation", "outlier", "alarm"]
QuestionKind = Literal["group", "repair", "candidate", "label", "selection", "orientation", "result", "demonstrate"]
SignoffState = Literal["signed", "needs review", "excluded"]


class ReasonView(Wire):
    """Why an edit may be wrong. hulls: names of those concerned; rule: its number, null where it is about none."""

    kind: ReasonKind
    text: str
    hulls: tuple[str, ...] = ()
    rule: int | None = None


class ConfidenceView(Wire):
    """One asset. probability: that its edit is right; doubts: the weightiest first; state: whether it is signed off,
    held below the bar, or excluded; told: whether a person demonstrated or accepted it."""

    asset: str
    probability: float
    reasons: tuple[ReasonView, ...] = ()
    state: SignoffState
    remarks: bool = False


class HullRef(Wire):
    """A hull of an asset. place: its position among the asset's own hulls."""

    asset: str
    hull: str
    place: int


class ReviewChoiceView(Wire):
    """One reply. id: among those of its question; label: that the hulls then get; select: names of the hulls that the
    rule then selects; sentence: that reading in words; orient: the directive that the family then gets."""

    id: str
    text: str
    label: str | None = None
    select: tuple[str, ...] | None = None
    sentence: str = ""
    orient: str | None = None


class ReviewQuestionView(Wire):
    """A question. seconds: of a person; gain: assets that an answer makes right, as far as can be expected; hulls:
    those in question."""

    id: str
    kind: QuestionKind
    text: str
    seconds: float
    gain: float
    asset: str
    rule: int | None = None
    hulls: tuple[HullRef, ...] = ()
    choices: tuple[ReviewChoiceView, ...] = ()


class AssessmentView(Wire):
    """A family as the last learning run left it. number: of that run; bar: the probability from which on an asset is
    signed off; signed_off, held, excluded: how many assets; unseen: those of the family that nobody looked at, as there
    are too many, or they cannot be read; assets: the others in the family's order, empty while there is no program;
    question: null where nothing is left to ask."""

    number: int
    threshold: float
    signed_off: int = 0
    need_review: int = 0
    excluded: int = 0
    unseen: int = 0
    assets: tuple[ConfidenceView, ...] = ()
    question: ReviewQuestionView | None = None
