"""Programs, the outcome of learning, selections of extractors, and the language as forms and words."""

from __future__ import annotations

from meshforge.project import LearnStatus
from meshforge.studio.wire import Wire
from meshforge.studio.wire.actions import ActionForm, ActionView, Argument


class RuleView(Wire):
    """A rule of a program, as text and as a sentence; readings: how many extractors agree with all demonstrations."""

    rule: int
    text: str
    sentence: str
    candidates: int = 1


class CandidateView(Wire):
    """An extractor that agrees with all demonstrations of a rule; belief: its share in 0..1; differs_on: assets where
    it selects something else than the program's."""

    id: str
    rule: int
    extractor: str
    sentence: str
    size: int
    belief: float
    differs_on: tuple[str, ...]


class NearestView(Wire):
    """The extractor that comes nearest, for a rule without any that fits, and how it differs on one asset."""

    rule: int
    extractor: str
    asset: str
    extra: tuple[str, ...]
    missing: tuple[str, ...]


class HintView(Wire):
    """The asset to demonstrate next, and why."""

    asset: str
    why: str


class OutcomeView(Wire):
    """The outcome of a learning run. number: counts the runs; program: its text, null where there is none; looked_at:
    how many assets the run looked at; settled: whether the program is unambiguous; repairs: how many labels
    are probably wrong.

    error: a message in place of an outcome; seconds: the time it took. why, advice, nearest: for a rule without an
    extractor. stale: ids of answers that no longer fit. sample: the assets whose results show best whether the program
    is right, best first; overruled: those whose accepted result no program keeps.
    """

    number: int
    status: LearnStatus
    program: str | None = None
    looked_at: int = 0
    rules: tuple[RuleView, ...] = ()
    unambiguous: bool = False
    candidates: tuple[CandidateView, ...] = ()
    repairs: int = 0
    nearest: NearestView | None = None
    hint: HintView | None = None
    why: str | None = None
    advice: tuple[str, ...] = ()
    stale: tuple[str, ...] = ()
    sample: tuple[str, ...] = ()
    overruled: tuple[str, ...] = ()
    error: str | None = None
    seconds: float = 0.0


class Reach(Wire):
    """What a program does on one asset. rules: for each rule the positions of the asset's own hulls that it selects, or
    that the hulls it selects were made of; before, after: how many hulls; error: why it does not run there."""

    asset: str
    rules: tuple[tuple[int, ...], ...] = ()
    before: int = 0
    after: int = 0
    error: str | None = None


class ProgramView(Wire):
    """The accepted program. by_hand: a person wrote or changed it; outdated: what it was learned from changed since;
    version: to be sent back with an edit of the text; error: why the file does not parse."""

    text: str = ""
    version: str = ""
    by_hand: bool = False
    outdated: bool = False
    labels: tuple[str, ...] = ()
    orient_sentence: str = ""
    rules: tuple[RuleView, ...] = ()
    error: str | None = None


class Mark(Wire):
    """An error at a place in a text; line, column: from 1."""

    line: int
    column: int
    message: str


class ProgramCheck(Wire):
    """Whether a text is a program, and its rules in words if so."""

    mark: Mark | None = None
    rules: tuple[RuleView, ...] = ()
    orient_sentence: str = ""


class SelectionView(Wire):
    """The names of the hulls that an extractor selects on an asset; mark: what is wrong with its text."""

    select: tuple[str, ...] = ()
    sentence: str = ""
    mark: Mark | None = None


class CoverageView(Wire):
    """What an extractor selects on every asset, by positions of the asset's own hulls; in very large families on those
    assets that learning looks at."""

    assets: dict[str, tuple[int, ...]]


class Guess(Wire):
    """What the program would select for a rule on an asset, after the steps demonstrated before it."""

    rule: int
    action: ActionView
    select: tuple[str, ...]
    sentence: str
    error: str | None = None


class Guesses(Wire):
    """A guess for each rule."""

    asset: str
    guesses: tuple[Guess, ...]


class Operator(Wire):
    """An extractor's operator and its operands, for completion; base: whether it is a base extractor."""

    name: str
    usage: str
    summary: str
    base: bool
    arguments: tuple[Argument, ...]


class LanguageView(Wire):
    """The language: actions (without Each, a switch in the page), operators, directions."""

    actions: tuple[ActionForm, ...]
    operators: tuple[Operator, ...]
    directions: tuple[str, ...]
