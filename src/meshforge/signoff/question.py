"""What a person is asked about a family, how they reply, and what is known of the family so far."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from hashlib import blake2b
from typing import Any, Literal, NamedTuple

from meshforge.language import Orient, Program, Template
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Answer, Demonstration

QuestionKind = Literal[
    "group", "repair", "reading", "label", "selection", "orientation", "result", "demonstrate", "span"
]
"""A group of look-alike hulls and what they are; one hull's label; what a rule means; whether a rule is meant for a
label that no demonstration shows; whether what was shown or said was a slip; an orientation; whether a
result is right; an asset to demonstrate; whether a hull that likely spans parts is to be split."""

Selections = tuple[frozenset[str], ...]
"""What each rule selects on an asset, names of hulls."""

RIGHT, WRONG, ASIDE = "right", "wrong", "set aside"
"""The choices of a question about a result."""
CORRECT = "correct it"
"""In place of the first two of them where the program cannot run."""
SPLIT, ONE_PART = "split so", "no, it is one part"
"""The choices of a question about a hull that likely spans parts; which parts follows the first."""


class HullPlace(NamedTuple):
    """A hull of an asset, both by name."""

    asset: str
    hull: str


@dataclass(frozen=True, slots=True)
class ReviewChoice:
    """One reply. text: what it says; label: that the hulls then get; select: names of the hulls of the asset that the
    rule then selects; orient: how assets are turned then."""

    text: str
    label: str | None = None
    select: tuple[str, ...] | None = None
    orient: Orient | None = None


@dataclass(frozen=True, slots=True)
class ReviewQuestion:
    """One question. id: bound to all that it is about; text: the question in plain words; seconds: of a person, by the
    keystroke-level model; gain: assets that an answer makes right, as far as can be expected; asset: where to look;
    hulls: those in question; refused: what each choice would have selected is in `choices`.
    """

    id: str
    kind: QuestionKind
    text: str
    seconds: float
    gain: float
    asset: str
    rule: int | None = None
    hulls: tuple[HullPlace, ...] = ()
    choices: tuple[ReviewChoice, ...] = ()

    @property
    def worth(self) -> float:
        """What an answer makes right a second of a person's time; equal where nobody could tell a difference."""
        return round(self.gain / self.seconds, 9)

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
            "choices": [
                {
                    "text": choice.text,
                    "label": choice.label,
                    "select": None if choice.select is None else list(choice.select),
                }
                for choice in self.choices
            ],
        }


def identify(draft: ReviewQuestion, bound: Sequence[str] = ()) -> ReviewQuestion:
    """A question with its id, which all that it is about decides. bound: what else it is about."""
    words = [draft.kind, draft.asset, str(draft.rule), *(f"{one.asset}#{one.hull}" for one in draft.hulls), *bound]
    words += [f"{one.text} {one.label} {one.select}" for one in draft.choices]
    name = blake2b("\n".join(words).encode(), digest_size=6).hexdigest()
    return replace(draft, id=f"{draft.kind}-{name}")


@dataclass(frozen=True, slots=True)
class ReviewReply:
    """What a person said to a question. choice: the place among its choices, None for none of them; exceptions: hulls
    of a group that are something else, with their labels; mended: what each rule should have selected where a result
    is wrong; later: the question is put off."""

    question: str
    choice: int | None = None
    exceptions: Mapping[HullPlace, str] = field(default_factory=dict)
    mended: Selections | None = None
    later: bool = False


@dataclass(frozen=True, slots=True)
class ReviewState:
    """All that is known of a family.

    meshes: by name, with the labels that they have; frame: the program without its rules; templates: by the paths that
    actions name; demos: of some of the meshes, by name; answers: to questions of learning; accepted: what each rule
    selected on results that a person found right, by asset; mended: what it should have selected on results that were
    wrong; failed: what it did select there; aside: assets that a person flagged or set aside; later: ids of questions
    that were put off.
    """

    meshes: Mapping[str, SymbolicMesh]
    frame: Program
    templates: Mapping[str, Template] = field(default_factory=dict)
    demos: Mapping[str, Demonstration] = field(default_factory=dict)
    answers: tuple[Answer, ...] = ()
    accepted: Mapping[str, Selections] = field(default_factory=dict)
    mended: Mapping[str, Selections] = field(default_factory=dict)
    failed: Mapping[str, Selections] = field(default_factory=dict)
    aside: frozenset[str] = frozenset()
    later: frozenset[str] = frozenset()

    @property
    def reviewed_assets(self) -> frozenset[str]:
        """The assets of which a person saw what the edit makes of them."""
        return frozenset((*self.demos, *self.accepted, *self.mended))
