"""What a person is asked about a family, how they reply, and what a reply costs a person [s], by the
keystroke-level model (Card, Moran and Newell 1980)."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from hashlib import blake2b
from typing import Any, Literal, NamedTuple, Self, get_args

from meshforge.label_model.similar import CLICK, LOOK, THINK
from meshforge.language import Orient, Program, show
from meshforge.synthesis import Demonstration

QuestionKind = Literal["group", "repair", "candidate", "label", "selection", "orientation", "result", "demonstrate"]
ExclusionReason = Literal["not of this family", "not solved"]
"""Why an asset is given up: it is not edited, not counted and never asked about; or it is counted, and not written."""
NOT_OF_FAMILY: ExclusionReason = "not of this family"
NOT_SOLVED: ExclusionReason = "not solved"
RIGHT, WRONG, YES, NO = "right", "wrong", "yes", "no"
EXCLUDE: Mapping[str, ExclusionReason] = {"not-of-family": NOT_OF_FAMILY, "not-solved": NOT_SOLVED}
"""Ids of choices; those of labels are the labels, those of selections a, b, c."""

Selections = tuple[frozenset[str], ...]
"""What each rule selects on an asset, names of hulls."""


class HullPlace(NamedTuple):
    """A hull of an asset, both by name."""

    asset: str
    hull: str


@dataclass(frozen=True, slots=True)
class ReviewChoice:
    """One reply. id: among the choices of its question; text: what it says; label: that the hulls then get; select:
    names of the hulls of the asset that the rule then selects; orient: how assets are turned then."""

    id: str
    text: str
    label: str | None = None
    select: tuple[str, ...] | None = None
    orient: Orient | None = None

    @classmethod
    def of_label(cls, label: str) -> Self:
        return cls(label, label, label)

    def to_json(self) -> dict[str, Any]:
        select = None if self.select is None else list(self.select)
        turned = {"orient": show(self.orient).removeprefix("orient ")} if self.orient else {}
        return {"id": self.id, "text": self.text, "label": self.label, "select": select, **turned}


@dataclass(frozen=True, slots=True)
class ReviewQuestion:
    """One question. kind: `label` is a candidate with a label that no demonstration shows, `selection` a likely mistake
    in what a rule was shown or answered to select; text: in plain words; seconds: of a person, by the keystroke-level
    model; gain: assets that an answer makes right, as far as can be expected; asset: where to look; hulls: those in
    question; choices: the first one leaves things as they are; id: bound to all that it is about; goals: texts of those
    that fail on a result, and do not count there once it is called right.
    """

    kind: QuestionKind
    text: str
    seconds: float
    gain: float
    asset: str
    rule: int | None = None
    hulls: tuple[HullPlace, ...] = ()
    choices: tuple[ReviewChoice, ...] = ()
    id: str = ""
    goals: tuple[str, ...] = ()

    @property
    def worth(self) -> float:
        """What an answer makes right a second of a person's time; equal where nobody could tell a difference."""
        return round(self.gain / self.seconds, 9)

    def choice(self, wanted: str | None) -> ReviewChoice | None:
        """Return the choice of an id, None where there is none."""
        return next((one for one in self.choices if one.id == wanted), None)

    def to_json(self) -> dict[str, Any]:
        return {
            "id": self.id,
            "kind": self.kind,
            "text": self.text,
            "seconds": round(self.seconds, 2),
            "gain": round(self.gain, 4),
            "asset": self.asset,
            "rule": self.rule,
            "hulls": [{"asset": place.asset, "hull": place.hull} for place in self.hulls],
            "choices": [choice.to_json() for choice in self.choices],
            **({"goals": list(self.goals)} if self.goals else {}),
        }


def question_of(asked: Mapping[str, Any]) -> ReviewQuestion | None:
    """Return the question that was asked; asked: as `to_json` writes it; None for a kind that is gone."""
    if asked["kind"] not in get_args(QuestionKind):
        return None
    choices = tuple(
        ReviewChoice(
            one["id"],
            one["text"],
            one["label"],
            None if one["select"] is None else tuple(one["select"]),
            Program.parse(f"orient {one['orient']}\n").orient if one.get("orient") else None,
        )
        for one in asked["choices"]
    )
    hulls = tuple(HullPlace(one["asset"], one["hull"]) for one in asked["hulls"])
    rest = {name: asked[name] for name in ("kind", "text", "seconds", "gain", "asset", "rule", "id")}
    return ReviewQuestion(hulls=hulls, choices=choices, goals=tuple(asked.get("goals", ())), **rest)


def identify(draft: ReviewQuestion, bound: Sequence[str] = ()) -> ReviewQuestion:
    """Return a question with its id, which all that it is about decides. bound: what else it is about."""
    words = [draft.kind, draft.asset, str(draft.rule), *(f"{one.asset}#{one.hull}" for one in draft.hulls), *bound]
    words += [f"{one.id} {one.label} {one.select}" for one in draft.choices]
    name = blake2b("\n".join(words).encode(), digest_size=6).hexdigest()
    return replace(draft, id=f"{draft.kind}-{name}")


@dataclass(frozen=True, slots=True)
class ReviewReply:
    """What a person said to a question.

    choice: the id of one of its choices, None for none of them; exceptions: hulls of a group that are something else,
    with their labels; selections, labels: where a result is wrong, the hulls that rules should have selected, by their
    numbers, and labels that hulls of the asset should have; later: the question is snoozed; by: the person's name.
    """

    question: str
    choice: str | None = None
    exceptions: Mapping[HullPlace, str] = field(default_factory=dict)
    selections: Mapping[int, frozenset[str]] = field(default_factory=dict)
    labels: Mapping[str, str] = field(default_factory=dict)
    later: bool = False
    by: str | None = None

    def to_json(self) -> dict[str, Any]:
        """Return it as an entry of a file of replies, without its id; what is empty is left out."""
        exceptions = {f"{place.asset}#{place.hull}": label for place, label in sorted(self.exceptions.items())}
        selections = {str(rule): sorted(hulls) for rule, hulls in sorted(self.selections.items())}
        parts = {"exceptions": exceptions, "selections": selections, "labels": dict(sorted(self.labels.items()))}
        more = {"later": True} if self.later else {}
        return {"choice": self.choice, **{name: row for name, row in parts.items() if row}, **more}


CANDIDATE = 2 * THINK + CLICK
"""Pictures compared, and one taken."""
YES_OR_NO = THINK + CLICK
"""A result or a label looked at, and one click."""
_OPEN, _STEP = THINK + CLICK, THINK + CLICK
_USUAL_DEMONSTRATION = (2.0, 4.0)  # steps and hulls, where nothing was demonstrated yet


def price_group(hulls: int, exceptions: float = 0.0) -> float:
    """Return a group of look-alike hulls looked at and confirmed, but for some that are clicked."""
    return THINK + LOOK * hulls + CLICK * (1 + exceptions)


def price_demonstration(demos: Iterable[Demonstration]) -> float:
    """Return an asset demonstrated, as those before were on average."""
    steps = [[step.select for step in demo.steps if step.select] for demo in demos]
    if not steps:
        count, hulls = _USUAL_DEMONSTRATION
    else:
        count = sum(map(len, steps)) / len(steps)
        hulls = sum(len(select) for some in steps for select in some) / len(steps)
    return _OPEN + _STEP * count + CLICK * hulls
