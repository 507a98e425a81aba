"""Rules, and every node below a program as text in canonical form; `parse` is the inverse."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass, field
from typing import assert_never

from meshforge.common import ProgramError
from meshforge.language.actions.base import Action
from meshforge.language.actions.basic import ACTIONS
from meshforge.language.syntax import (
    OPERATORS,
    All,
    Attach,
    Diff,
    Extractor,
    Geo,
    Intersect,
    Is,
    LandmarkPair,
    Orient,
    Union,
    check_label,
)

WORD = re.compile(r"[^\W\d]\w*")
RESERVED = frozenset(OPERATORS) | frozenset(ACTIONS)

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

    extractor: Extractor
    action: Action
    label: str | None = None
    comments: Comments = field(default=Comments(), compare=False)

    def __post_init__(self) -> None:
        if self.label is None:
            return
        check_label(self.label)
        if not self.action.makes_hulls:
            raise ProgramError(f"{self.action} makes no hull that could take the label {self.label!r}")

    def __str__(self) -> str:
        return show(self)


SyntaxNode = Extractor | Action | LandmarkPair | Orient | Rule


def show(node: SyntaxNode) -> str:
    """A node as program text."""
    match node:
        case All():
            return "All"
        case Is(label):
            return f"Is({show_label(label)})"
        case Geo(base, direction):
            return f"Geo({show(base)}, {direction})"
        case Attach(left, right) | Union(left, right) | Intersect(left, right) | Diff(left, right):
            return f"{type(node).__name__}({show(left)}, {show(right)})"
        case Action():
            return str(node)
        case LandmarkPair(axis, start, end):
            return f"{axis}: {show(start)} -> {show(end)}"
        case Orient(pairs, snap):
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
