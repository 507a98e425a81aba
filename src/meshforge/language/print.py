"""Rules, and every node below a program as text in canonical form; `parse` is the inverse."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass, field
from typing import assert_never

from meshforge.common import ProgramError
from meshforge.language import syntax
from meshforge.language.actions.base import Action
from meshforge.language.actions.basic import ACTIONS

WORD = re.compile(r"[^\W\d]\w*")
RESERVED = frozenset(syntax.OPERATORS) | frozenset(ACTIONS)

CommentLines = tuple[str | None, ...]
"""Comment lines without their `#`; None is an empty line."""


@dataclass(frozen=True, slots=True)
class Comments:
    """The lines above a statement and the comment at its end."""

    above: CommentLines = ()
    beside: str | None = None


@dataclass(frozen=True, slots=True)
class Rule:
    """One rule: what to select, what to do with it, and the label for what is made (None: that of the largest hull).

    Comments do not count when rules are compared.
    """

    extractor: syntax.Extractor
    action: Action
    label: str | None = None
    comments: Comments = field(default=Comments(), compare=False)

    def __post_init__(self) -> None:
        if self.label is None:
            return
        syntax.check_label(self.label)
        if not self.action.makes_hulls:
            raise ProgramError(f"{self.action} makes no hull that could take the label {self.label!r}")

    def __str__(self) -> str:
        return show(self)


SyntaxNode = syntax.Extractor | Action | syntax.LandmarkPair | syntax.Orient | Rule


def show(node: SyntaxNode) -> str:
    """A node as program text."""
    match node:
        case syntax.All():
            return "All"
        case syntax.Is(label):
            return f"Is({show_label(label)})"
        case syntax.Geo(base, direction):
            return f"Geo({show(base)}, {direction})"
        case (
            syntax.Attach(left, right)
            | syntax.Union(left, right)
            | syntax.Intersect(left, right)
            | syntax.Diff(left, right)
        ):
            return f"{type(node).__name__}({show(left)}, {show(right)})"
        case Action():
            return str(node)
        case syntax.LandmarkPair(axis, start, end):
            return f"{axis}: {show(start)} -> {show(end)}"
        case syntax.Orient(pairs, snap):
            return f"orient {'snap ' if snap else ''}{', '.join(map(show, pairs))}"
        case Rule():
            return show_rule(node, 0)
        case _:
            assert_never(node)


def show_label(label: str) -> str:
    """A label as it is written: bare where it is a word and no operator, else quoted."""
    plain = WORD.fullmatch(label) and label not in RESERVED
    return label if plain else json.dumps(label, ensure_ascii=False)


def show_rule(rule: Rule, width: int) -> str:
    """A rule on one line, its arrow behind `width` characters at least."""
    label = f" as {show_label(rule.label)}" if rule.label is not None else ""
    return f"{show(rule.extractor):<{width}} => {rule.action}{label}"
