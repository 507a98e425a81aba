"""The project, the cards of its assets in the gallery, how sure their edits are, and the question worth most."""

from pathlib import Path
from typing import Annotated, Literal

from pydantic import BeforeValidator, Field

from meshforge.checks.goals.base import GoalOutcome
from meshforge.language import Direction
from meshforge.project import NextStep, OutputState, PropagationState
from meshforge.signoff import ExclusionReason, Reason
from meshforge.signoff.question import QuestionKind
from meshforge.studio.wire import Wire
from meshforge.studio.wire.asset import Fault
from meshforge.studio.wire.program import ActionView
from meshforge.studio.wire.requests import HullOfAsset

Verdict = Literal["accepted", "wrong"]


NO_PART = -2
"""In `Card.labels`, of a hull that is none of the parts."""


class GoalResultView(Wire):
    """What is known of a goal on the result of an asset, as in `GoalStatus`; picture: the key of that of a failure."""

    name: str
    goal: str
    outcome: GoalOutcome | None = None
    why: str = ""
    hulls: tuple[str, ...] = ()
    before: GoalOutcome | None = None
    accepted: bool = False
    fails: bool = False
    is_open: bool = False
    picture: Annotated[str | None, BeforeValidator(lambda path: path and picture_key(path))] = None


def picture_key(path: Path) -> str:
    """Return the key of the picture of a failure."""
    return path.name.rsplit(".", 2)[1]


class GoalCall(Wire):
    """A goal as a form has it. name: the word that begins it; arguments: texts, those that are left out missing."""

    name: str
    arguments: dict[str, str] = Field(default_factory=dict)


class GoalView(Wire):
    """A goal of the project, or what a form comes to, with a proposal for its name. sentence: it in words; call: as a
    form has it, null where it is none; error: why, where in the text, and what helps."""

    name: str
    text: str
    sentence: str = ""
    call: GoalCall | None = None
    error: str | None = None


class ExtractorSuggestion(Wire):
    """An extractor that selects what a person selected on an asset, or more. places: positions of what it selects."""

    text: str
    sentence: str
    places: tuple[int, ...]


class Card(Wire):
    """One asset in the gallery.

    hulls: how many, null until the asset is read or where it cannot be read. labels: for each hull, in order, its
    place in the vocabulary, or one of `NO_LABEL` and `NO_PART`; confidence: as in `AssetStatus`, below 50 where it is
    unsure.
    after: how many hulls the output has; after_labels: like `labels`, empty where they are not known; stale: what
    changed since the output was made; excluded: why it is given up; manual_edits: how many edits by hand.
    sources: how many pieces and bodies have no hulls and can be decomposed; prepared: what was done before the program.
    picture, edited_picture: the digest that the address of the thumbnail takes, null where there is none yet.
    check: the digest of the output and of its inputs, null where there is no output; faults: what checks found, null
    where it was not checked; goals: what is known of those of the project on the result.
    """

    asset: str
    hulls: int | None = None
    labels: tuple[int, ...] = ()
    confidence: tuple[int, ...] = ()
    demonstrated: bool = False
    output: OutputState = "none"
    after: int | None = None
    after_labels: tuple[int, ...] = ()
    stale: tuple[str, ...] = ()
    error: str | None = None
    flags: tuple[str, ...] = ()
    review: Verdict | None = None
    note: str | None = None
    excluded: ExclusionReason | None = None
    manual_edits: int = 0
    sources: int = 0
    prepared: tuple[str, ...] = ()
    picture: str | None = None
    edited_picture: str | None = None
    check: str | None = None
    faults: tuple[Fault, ...] | None = None
    goals: tuple[GoalResultView, ...] = ()

    @property
    def is_open(self) -> bool:
        """Whether it changed since a person accepted it, or a goal is open that nobody accepted, as pages count it."""
        changed = any(reason != "software" for reason in self.stale)
        return changed if self.review == "accepted" else any(goal.is_open for goal in self.goals)


class VocabularyLabel(Wire):
    """A label of the vocabulary, or a class. text: as programs write it; color: `#rrggbb`, by its place; is_class:
    whether it stands for hulls that steps take."""

    name: str
    text: str
    color: str
    is_class: bool = False


class RuleLine(Wire):
    """A rule in the demonstrations. action: the first one; shown, nothing: assets where it selects hulls, or none."""

    rule: int
    action: ActionView
    shown: tuple[str, ...] = ()
    nothing: tuple[str, ...] = ()


class AnswerView(Wire):
    """An answer, or a repair of a label that was confirmed or refused; id: to take it back."""

    id: str
    kind: Literal["answer", "confirmed", "rejected"]
    asset: str
    text: str


class NewAssetsView(Wire):
    """The assets that came after the others were prepared, so that a run prepares them first. ids: of all of them;
    rebuilt: in how many hulls that span parts are looked for, and bodies rebuilt from a probability of
    `min_confidence` on; unclear: why they are not decomposed, null where it is clear how."""

    ids: tuple[str, ...]
    rebuilt: int = 0
    min_confidence: float | None = None
    unclear: str | None = None


class AxisLandmarks(Wire):
    """A direction that goes from some hulls to others, each by their label; null for all hulls."""

    axis: Direction
    start: str | None
    end: str | None


class OrientView(Wire):
    """The orientation. text: of the directive, empty for none; sentence: that in words."""

    text: str = ""
    sentence: str = ""
    snap: bool = False
    pairs: tuple[AxisLandmarks, ...] = ()


class ProjectView(Wire):
    """The project.

    rules: what is demonstrated, by rule; templates: hull templates that actions can name; propagation: the last one of
    labels, null where there was none; new: assets that a run prepares first, null for none; problem: why the program
    cannot be applied; lost: ids that files are kept for though there is no such asset; left_out: ids of assets that are
    kept, but not as part of the family; up: as in the settings; ask_up: an asset on which to ask what is up, null where
    that is known.
    """

    name: str
    folder: str
    vocabulary: tuple[VocabularyLabel, ...]
    orient: OrientView
    contact: float | None = None
    extremity: float | None = None
    rules: tuple[RuleLine, ...] = ()
    answers: tuple[AnswerView, ...] = ()
    templates: tuple[str, ...] = ()
    goals: tuple[GoalView, ...] = ()
    propagation: PropagationState | None = None
    next: NextStep
    new: NewAssetsView | None = None
    problem: str | None = None
    lost: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()
    up: Literal["", "Y", "Z"] = ""
    ask_up: str | None = None


class ConfidenceView(Wire):
    """One asset. probability: that its edit is right; reasons: the weightiest first; state: whether it is signed off,
    needs review, or is excluded; reviewed: whether a person demonstrated or accepted it."""

    asset: str
    probability: float
    reasons: tuple[Reason, ...] = ()
    state: Literal["signed", "needs review", "excluded"]
    reviewed: bool = False


class HullRef(HullOfAsset):
    """A hull of an asset. place: its position among the asset's own hulls."""

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
    those in question; goals: texts of those that fail on a result."""

    id: str
    kind: QuestionKind
    text: str
    seconds: float
    gain: float
    asset: str
    rule: int | None = None
    hulls: tuple[HullRef, ...] = ()
    choices: tuple[ReviewChoiceView, ...] = ()
    goals: tuple[str, ...] = ()


class AssessmentView(Wire):
    """A family as the last learning run left it. threshold: the probability from which on an asset is signed off;
    signed_off, need_review, excluded: how many assets; unseen: those of the family that nobody looked at, as there are
    too many, or they cannot be read; assets: the others in the family's order, empty while there is no program;
    question: null where nothing is left to ask."""

    threshold: float
    signed_off: int = 0
    need_review: int = 0
    excluded: int = 0
    unseen: int = 0
    assets: tuple[ConfidenceView, ...] = ()
    question: ReviewQuestionView | None = None
