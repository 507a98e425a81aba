"""What a rule does, in a plain sentence for people who do not read the language."""

from __future__ import annotations

from typing import assert_never

from meshforge.language.actions import PRIMITIVES, Action, Add, Delete, Each, Merge, Replace, Scale
from meshforge.language.actions.arguments import show_number
from meshforge.language.print import WORD
from meshforge.language.program import Rule
from meshforge.language.syntax import All, Attach, Base, Diff, Extractor, Geo, Intersect, Is, Orient, Union

_SOLIDS = {"box": "box", "cylinder": "cylinder", "capsule": "capsule", "sphere": "sphere or ellipsoid"}


def explain(node: Rule | Orient | Extractor) -> str:
    """A sentence for a rule or an orientation, a noun phrase for an extractor."""
    match node:
        case Rule(extractor, action, label):
            given = f"; what is made is labelled {_word(label)}" if label is not None else ""
            sentence = f"{_deed(action, _subject(extractor))}{given}."
            return sentence[0].upper() + sentence[1:]
        case Orient():
            return _turn(node)
        case All() | Is():
            return _all_of(node)
        case Attach(selected) | Geo(selected):
            return f"{_all_of(selected)} {_that(node)}"
        case Union(left, right):
            return f"{_operand(left)} and {_operand(right)}"
        case Intersect(left, right):
            return f"{_operand(left)}, but only {_operand(right, left)}"
        case Diff(left, right):
            return f"{_operand(left)}, except {_operand(right, left)}"
        case _:
            assert_never(node)


def _subject(extractor: Extractor) -> str:
    """The phrase before a verb: an insertion is closed by a comma."""
    return explain(extractor) + "," * isinstance(extractor, Intersect | Diff)


def _that(part: Attach | Geo) -> str:
    """What is asked of the hulls of a base."""
    match part:
        case Attach(selected, anchor):
            return f"that touch {_one_of(anchor, other=selected)}"
        case Geo(_, direction):
            return f"that reach farthest along {direction}"
        case _:
            assert_never(part)


def _operand(part: Extractor, of: Extractor | None = None) -> str:
    """The phrase for one side of a set operator, in brackets where it is one itself; `of`: the side before it."""
    if (isinstance(part, Attach) and part.selected == of) or (isinstance(part, Geo) and part.base == of):
        return f"those {_that(part)}"
    return f"({explain(part)})" if isinstance(part, Union | Intersect | Diff) else explain(part)


def _all_of(base: Base) -> str:
    return f"the {_word(base.label)} hulls" if isinstance(base, Is) else "all hulls"


def _one_of(anchor: Base, other: Base) -> str:
    """The phrase for a hull that is touched; `other` are those that touch it: none is its own neighbour."""
    if isinstance(anchor, All):
        return "any other hull"
    word = _word(anchor.label)
    article = "another" if anchor == other else "an" if word[0].lower() in "aeiou" else "a"
    return f"{article} {word} hull"


def _word(label: str) -> str:
    return label if WORD.fullmatch(label) else f"“{label}”"


def _turn(orient: Orient) -> str:
    ways = [f"{pair.axis} points from {_all_of(pair.start)} to {_all_of(pair.end)}" for pair in orient.pairs]
    how = "by quarter turns, so that, as nearly as they allow, " if orient.snap else "so that "
    return f"For reasoning, turn every asset {how}{' and '.join(ways)}."


def _deed(action: Action, hulls: str) -> str:
    """What an action does to `hulls`; a sentence without its end."""
    if isinstance(action, Each):
        return f"each connected group of {hulls.removeprefix('the ')} is {_done(action.action, 'its')}"
    parts = ", one for each body" if action.by_body else ""
    return f"{hulls} are {_done(action, 'their')}{parts}"


def _done(action: Action, whose: str) -> str:
    match action:
        case Delete():
            return "deleted"
        case Merge():
            return "merged into one convex hull"
        case Replace():
            return f"replaced by {_substitute(action, whose)}"
        case Add():
            size = "in its own size" if action.keep else "as large as fits"
            return f"given “{action.template}” at {whose} {action.direction} side, {size}"
        case Scale():
            where = "in every direction" if action.axis == "all" else f"along {action.axis}"
            return f"scaled by {show_number(action.factor)} {where}, about {whose} common centre"
        case _:
            raise TypeError(f"no words for {type(action).__name__}")


def _substitute(action: Replace, whose: str) -> str:
    if action.geometry not in PRIMITIVES:
        turned = " turned lengthwise and" if action.fit == "longest" else ""
        return f"“{action.geometry}”,{turned} stretched to fill {whose} bounding box"
    solid = _SOLIDS[action.geometry]
    if action.fit == "tight":
        return f"the smallest {solid} around {'it' if whose == 'its' else 'them'}, at any angle"
    return f"a {solid} that fills {whose} bounding box"
