"""The project and the cards of its assets, as the gallery shows them; and what can be undone."""

from __future__ import annotations

from typing import Literal

from meshforge.studio.wire import Wire
from meshforge.studio.wire.asset import Fault
from meshforge.studio.wire.jobs import CarriedOver

CardOutput = Literal["none", "edited", "unchanged", "failed"]
Verdict = Literal["accepted", "flagged"]
Stage = Literal["label", "demonstrate", "learn", "review"]


class Card(Wire):
    """One asset in the gallery.

    hulls: how many, null while it is not read yet or where it cannot be read. labels: of each hull, in the order of
    the asset, its place in the vocabulary or -1 for none; unsure: positions of hulls whose label is not sure; given:
    how many have one that a person or a file gave.
    after: hulls of the output; after_labels: of each of them, as `labels`, empty where that is not known; stale: what
    changed since the output was made; corrections: edits by hand, a number.
    sources: pieces and bodies without hulls, which can be decomposed; prepared: what was done before the program.
    picture, edited_picture: the digest that the address of the thumbnail takes, null where there is none yet.
    check: the digest of the output and of what it was made from, null where there is no output; faults: what checks
    found of it, null where it was not checked.
    """

    asset: str
    hulls: int | None = None
    labels: tuple[int, ...] = ()
    unsure: tuple[int, ...] = ()
    given: int = 0
    demonstrated: bool = False
    output: CardOutput = "none"
    after: int | None = None
    after_labels: tuple[int, ...] = ()
    stale: tuple[str, ...] = ()
    error: str | None = None
    flags: tuple[str, ...] = ()
    review: Verdict | None = None
    note: str | None = None
    corrections: int = 0
    sources: int = 0
    prepared: tuple[str, ...] = ()
    picture: str | None = None
    edited_picture: str | None = None
    check: str | None = None
    faults: tuple[Fault, ...] | None = None


class VocabularyLabel(Wire):
    """A label of the vocabulary. color: `#rrggbb`, given by its place; used: hulls of the family that have it."""

    name: str
    color: str
    used: int = 0


class RuleLine(Wire):
    """A rule as the demonstrations have it: the action that is shown first, and the assets that say something."""

    rule: int
    action: str
    shown: tuple[str, ...] = ()
    nothing: tuple[str, ...] = ()


class Said(Wire):
    """An answer or a repair of a label that was confirmed or refused; id: by which it is taken back."""

    id: str
    kind: Literal["answer", "confirmed", "rejected"]
    asset: str
    text: str


class Next(Wire):
    """The next sensible step: the stage it belongs to, in words, and the asset to go to."""

    stage: Stage
    say: str
    asset: str | None = None


class ProjectView(Wire):
    """The project. orient: the directive's text, empty for none; orient_sentence: the same in words.

    rules: what is demonstrated, by rule; templates: hull templates that actions can name; carried: how it stands with
    labels that were carried over, null where none were; problem: why the program cannot be applied; lost: ids that
    something is kept for, though there is no such asset.
    """

    name: str
    folder: str
    vocabulary: tuple[VocabularyLabel, ...]
    orient: str = ""
    orient_sentence: str = ""
    contact: float | None = None
    extremity: float | None = None
    rules: tuple[RuleLine, ...] = ()
    said: tuple[Said, ...] = ()
    templates: tuple[str, ...] = ()
    carried: CarriedOver | None = None
    next: Next
    problem: str | None = None
    lost: tuple[str, ...] = ()


class HistoryView(Wire):
    """What can be undone and redone next, in words; null where there is nothing."""

    undo: str | None = None
    redo: str | None = None
    undoable: int = 0
    redoable: int = 0
