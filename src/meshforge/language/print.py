"""Programs as text in canonical form; `parse` is the inverse."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import assert_never

from meshforge.language.actions import ACTIONS, Action
from meshforge.language.actions.arguments import show_number
from meshforge.language.program import Comments, Lines, Program, Rule
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
)

WORD = re.compile(r"[^\W\d]\w*")
RESERVED = frozenset(OPERATORS) | frozenset(ACTIONS)
_ALIGNED = 60  # a longer extractor does not push the arrows of the other rules to the right

Node = Extractor | Action | LandmarkPair | Orient | Rule


def show(node: Node) -> str:
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
            return _rule(node, 0)
        case _:
            assert_never(node)


def show_label(label: str) -> str:
    """A label as it is written: bare where it is a word and no operator, else quoted."""
    plain = WORD.fullmatch(label) and label not in RESERVED
    return label if plain else json.dumps(label, ensure_ascii=False)


def _rule(rule: Rule, width: int) -> str:
    label = f" as {show_label(rule.label)}" if rule.label is not None else ""
    return f"{show(rule.extractor):<{width}} => {rule.action}{label}"


def _program(program: Program) -> Iterator[str]:
    """The lines: header, orientation and rules as paragraphs, then the comments at the end."""
    lines: list[str] = []
    for text, comments, paragraph in _statements(program):
        blank = paragraph and bool(lines)
        above = comments.above[1:] if comments.above[:1] == (None,) else comments.above
        if lines and (blank or above != comments.above):
            lines.append("")
        lines += _lines(above)
        lines.append(f"{text}  #{comments.beside}" if comments.beside is not None else text)
    end = program.comments.end
    lines += _lines(end if lines else end[1:] if end[:1] == (None,) else end)
    yield from lines


def _statements(program: Program) -> Iterator[tuple[str, Comments, bool]]:
    """Text, comments, and whether it begins a paragraph, of every statement in canonical order."""
    notes = program.comments
    if program.labels:
        yield f"labels {', '.join(map(show_label, program.labels))}", notes.labels, False
    if program.contact is not None:
        yield f"contact {show_number(program.contact)}", notes.contact, False
    if program.extremity is not None:
        yield f"extremity {show_number(program.extremity)}", notes.extremity, False
    if program.orient:
        yield show(program.orient), notes.orient, True
    widths = [len(show(rule.extractor)) for rule in program.rules]
    width = max((w for w in widths if w <= _ALIGNED), default=0)
    for k, rule in enumerate(program.rules):
        yield _rule(rule, width), rule.comments, k == 0


def _lines(lines: Lines) -> list[str]:
    return ["" if line is None else f"#{line}" for line in lines]
