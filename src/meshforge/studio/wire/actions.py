"""Actions as the page shows them, as forms, and as the page sends them; the page never reads or writes their text."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from meshforge.language import ActionIcon
from meshforge.studio.wire import Wire

ArgumentKind = Literal[
    "words", "flag", "file", "shape", "factor", "length", "option", "text", "share", "label", "base", "extractor"
]
Value = bool | float | str


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
