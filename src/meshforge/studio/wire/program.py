"""Programs and what was learned, selections of extractors, and the language itself as forms and words."""

from __future__ import annotations

from typing import Literal

from meshforge.studio.wire import Wire

LearnStatus = Literal["found", "ambiguous", "repair", "none", "timeout", "error"]


class RuleView(Wire):
    """A rule of a program: its text and a sentence about it; readings: how many agree with all demonstrations."""

    rule: int
    text: str
    sentence: str
    readings: int = 1


class ReadingView(Wire):
    """An extractor that agrees with all demonstrations of a rule; belief: its share in 0..1; differs_on: assets where
    it selects something else than the program's."""

    id: str
    rule: int
    extractor: str
    sentence: str
    size: int
    belief: float
    differs_on: tuple[str, ...]


class ChoiceView(Wire):
    """One way to go on; select: names of hulls as the rule meets them."""

    reading: str
    extractor: str
    sentence: str
    select: tuple[str, ...]


class QuestionView(Wire):
    """Which hulls should a rule select on an asset? harm: share of the assets edited wrongly as things stand."""

    id: str
    rule: int
    asset: str
    choices: tuple[ChoiceView, ...]
    harm: float
    left: float


class RepairView(Wire):
    """A label that is probably wrong; was: null for none."""

    id: str
    rule: int
    asset: str
    hull: str
    was: str | None
    to: str
    belief: float
    why: str


class NearestView(Wire):
    """The extractor that came nearest for a rule that has none, and how it differs on one asset."""

    rule: int
    extractor: str
    asset: str
    extra: tuple[str, ...]
    missing: tuple[str, ...]


class HintView(Wire):
    """The asset that is best demonstrated next, and why."""

    asset: str
    why: str


class LessonView(Wire):
    """What a lesson came to. number: counts lessons; program: its text, null where there is none; looked_at: how many
    assets were looked at, of very many not all.

    error: a message in place of an outcome; seconds: the time it took. why, advice, suggested_orientation, nearest:
    where a rule has no extractor. stale: ids of answers that no longer fit. sample: the assets whose results tell best
    whether the program is what is meant, most telling first; overruled: those whose accepted result no program keeps.
    """

    number: int
    status: LearnStatus
    program: str | None = None
    looked_at: int = 0
    rules: tuple[RuleView, ...] = ()
    settled: bool = False
    readings: tuple[ReadingView, ...] = ()
    repairs: tuple[RepairView, ...] = ()
    question: QuestionView | None = None
    nearest: NearestView | None = None
    hint: HintView | None = None
    why: str | None = None
    advice: tuple[str, ...] = ()
    suggested_orientation: str | None = None
    stale: tuple[str, ...] = ()
    sample: tuple[str, ...] = ()
    overruled: tuple[str, ...] = ()
    error: str | None = None
    seconds: float = 0.0


class Reach(Wire):
    """What a program does on one asset: of each rule the positions of the asset's own hulls that it selects, or that
    what it selects was made of; and hulls before and after. error: why it does not run there."""

    asset: str
    rules: tuple[tuple[int, ...], ...] = ()
    before: int = 0
    after: int = 0
    error: str | None = None


class ProgramView(Wire):
    """The accepted program. by_hand: a person wrote or changed it; outdated: what it was learned from changed since.

    version: to be given back with an edit of the text. error: why the file does not parse.
    """

    text: str = ""
    version: str = ""
    by_hand: bool = False
    outdated: bool = False
    labels: tuple[str, ...] = ()
    orient_sentence: str = ""
    rules: tuple[RuleView, ...] = ()
    error: str | None = None


class Mark(Wire):
    """A place in a text, lines and columns from 1, and what is wrong there."""

    line: int
    column: int
    message: str


class ProgramCheck(Wire):
    """Whether a text is a program, and its rules in words if so."""

    mark: Mark | None = None
    rules: tuple[RuleView, ...] = ()
    orient_sentence: str = ""


class Selected(Wire):
    """What an extractor selects on an asset (names), or what is wrong with its text."""

    select: tuple[str, ...] = ()
    sentence: str = ""
    mark: Mark | None = None


class Generalised(Wire):
    """What an extractor selects on every asset, of very large families on those that are looked at while learning:
    positions of the asset's own hulls."""

    assets: dict[str, tuple[int, ...]]


class Guess(Wire):
    """What the program would select for a rule on an asset, given the steps that were shown before it."""

    rule: int
    action: str
    select: tuple[str, ...]
    sentence: str
    error: str | None = None


class Guesses(Wire):
    """A guess for each rule."""

    asset: str
    guesses: tuple[Guess, ...]


class Argument(Wire):
    """One argument of an action. kind: `words` are chosen from, a `flag` is there or not, a `file` is a template,
    `shape` is a primitive or a template, a `factor` a number above 0."""

    name: str
    kind: Literal["words", "flag", "file", "shape", "factor"]
    wants: str
    choices: tuple[str, ...] = ()
    required: bool = True


class ActionForm(Wire):
    """An action as a form; usage: how it is written; makes: whether `as LABEL` may follow."""

    name: str
    summary: str
    usage: str
    makes: bool
    arguments: tuple[Argument, ...]


class Operator(Wire):
    """An extractor's operator and its operands, for completion."""

    name: str
    usage: str
    summary: str


class LanguageView(Wire):
    """The language: actions (all but Each, which is a switch), operators, directions."""

    actions: tuple[ActionForm, ...]
    operators: tuple[Operator, ...]
    directions: tuple[str, ...]
