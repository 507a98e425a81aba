"""Another name for a label, wherever a program or an orientation says it."""

from __future__ import annotations

from dataclasses import replace
from typing import assert_never

from meshforge.language.program import Program
from meshforge.language.syntax import All, Attach, Base, Diff, Extractor, Geo, Intersect, Is, Orient, Union


def rename_in_program(program: Program, old: str, new: str) -> Program:
    """The program with a label by another name; declared twice by that, it is declared once."""
    rules = (
        replace(
            rule,
            extractor=_extractor(rule.extractor, old, new),
            label=new if rule.label == old else rule.label,
        )
        for rule in program.rules
    )
    labels = dict.fromkeys(new if label == old else label for label in program.labels)
    orient = rename_in_orient(program.orient, old, new) if program.orient else None
    return replace(program, labels=tuple(labels), orient=orient, rules=tuple(rules))


def rename_in_orient(orient: Orient, old: str, new: str) -> Orient:
    """The orientation with a label by another name."""
    pairs = (replace(pair, start=_base(pair.start, old, new), end=_base(pair.end, old, new)) for pair in orient.pairs)
    return replace(orient, pairs=tuple(pairs))


def _base(base: Base, old: str, new: str) -> Base:
    return Is(new) if base == Is(old) else base


def _extractor(node: Extractor, old: str, new: str) -> Extractor:
    match node:
        case All() | Is():
            return _base(node, old, new)
        case Geo(base, direction):
            return Geo(_base(base, old, new), direction)
        case Attach(selected, anchor):
            return Attach(_base(selected, old, new), _base(anchor, old, new))
        case Union(left, right) | Intersect(left, right) | Diff(left, right):
            return type(node)(_extractor(left, old, new), _extractor(right, old, new))
        case _:
            assert_never(node)
