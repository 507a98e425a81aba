"""Actions as the page shows and sends them, programs, the outcome of learning, and the language as forms and words."""

from typing import Annotated, Literal

from pydantic import BeforeValidator, Field

from meshforge.language import ActionIcon, explain, show
from meshforge.project import LearnStatus
from meshforge.studio.wire import Wire

ArgumentKind = Literal[
    "words", "flag", "file", "shape", "factor", "length", "option", "text", "share", "label", "base", "extractor"
]
Value = bool | float | str
ExtractorText = Annotated[str, BeforeValidator(show)]


class ActionCall(Wire):
    """An action and its arguments by name, those that are left out missing. each: whether it is done to every connected
    part separately; label: what new hulls are labelled, null for the label of what they are made of."""

    name: str
    arguments: dict[str, Value] = Field(default_factory=dict)
    each: bool = False
    label: str | None = None


class ActionView(ActionCall):
    """An action as it is shown. text: as the language has it, with `as LABEL` where new hulls get a label; short: that
    without the label; icon: the name of its picture."""

    text: str
    short: str
    icon: ActionIcon


class Argument(Wire):
    """One argument of an action or an extractor. kind: one of some `words`, a `flag` that is there or not, the `file`
    of a template, a `shape` (a primitive or a template), a `factor` above 0, a `length` above 0 [m], an `option` with a
    length [m], a `text`, a `share` above 0 and at most 1, a `label`, a `base` extractor, or any `extractor`.

    title: its name in the form; wants: what it must be; words: longer texts for some choices; omitted: what happens
    without it; usual: what a form begins with.
    """

    name: str
    kind: ArgumentKind
    title: str
    wants: str
    choices: tuple[str, ...] = ()
    words: dict[str, str]
    omitted: str = "usual"
    required: bool = True
    usual: Value | None = None


class ArgumentValue(Wire):
    """A value of an argument; null for any that is none of its choices."""

    name: str
    value: Value | None


class ActionForm(Wire):
    """An action as a form. title: what it does to a selection, as a command; key: that begins it, empty for none;
    usage: its syntax; makes: whether new hulls can get a label; clashes: pairs of values that do not go together."""

    name: str
    title: str
    summary: str
    key: str
    icon: ActionIcon
    usage: str
    makes: bool
    arguments: tuple[Argument, ...]
    clashes: tuple[tuple[ArgumentValue, ArgumentValue], ...] = ()


class RuleView(Wire):
    """A rule of a program, as text and as a sentence."""

    rule: int
    text: str
    sentence: str


class CandidateView(Wire):
    """An extractor that agrees with all demonstrations of a rule; belief: its share in 0..1; differs_on: assets where
    it selects something else than the program's."""

    id: str
    rule: int
    extractor: ExtractorText
    sentence: Annotated[str, Field(validation_alias="extractor"), BeforeValidator(explain)]
    size: int
    belief: float
    differs_on: tuple[str, ...]


class NearestView(Wire):
    """The extractor that comes nearest, for a rule without any that fits, and how it differs on one asset."""

    rule: int
    extractor: ExtractorText
    asset: str
    extra: tuple[str, ...]
    missing: tuple[str, ...]


class OutcomeView(Wire):
    """The outcome of a learning run. number: counts the runs; program: its text, null where there is none; looked_at:
    how many assets the run looked at; unambiguous: whether the program is unambiguous; repairs: how many labels
    are probably wrong.

    error: a message in place of an outcome. why, advice, nearest: for a rule without an extractor. stale: ids of
    answers that no longer fit. overruled: assets whose accepted result no program keeps.
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
    why: str | None = None
    advice: tuple[str, ...] = ()
    stale: tuple[str, ...] = ()
    overruled: tuple[str, ...] = ()
    error: str | None = None


class Reach(Wire):
    """What a program does on one asset. rules: for each rule the positions of the asset's own hulls that it selects, or
    that the hulls it selects were made of; error: why it does not run there."""

    asset: str
    rules: tuple[tuple[int, ...], ...] = ()
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


class Operator(Wire):
    """An extractor's operator and its operands, for completion, or a goal and its arguments: `words`, an `extractor` or
    a `text`, with their defaults as `omitted`; base: whether it is a base extractor."""

    name: str
    usage: str
    summary: str
    base: bool
    arguments: tuple[Argument, ...]


class LanguageView(Wire):
    """The language: actions (without Each, a switch in the page), operators, directions; goals."""

    actions: tuple[ActionForm, ...]
    operators: tuple[Operator, ...]
    directions: tuple[str, ...]
    goals: tuple[Operator, ...]
