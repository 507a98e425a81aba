"""What the page needs to know of the language: actions as forms, words for completion."""

from __future__ import annotations

from typing import Literal

from meshforge.studio.wire.base import Wire


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
