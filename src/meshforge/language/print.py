"""Rules, and every node below a program in words: as text in canonical form, of which `parse` is the inverse, and in
plain sentences for people who do not read the language."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import assert_never

from meshforge.common import ProgramError
from meshforge.language import syntax
from meshforge.language.actions.base import PRIMITIVES, Action, show_number
from meshforge.language.actions.basic import Add, Delete, Each, Merge, Replace, Scale, Shrink
from meshforge.language.labels import WORD, check_label, show_label
from meshforge.language.syntax import All, Attach, BaseExtractor, Diff, Extractor, Geo, Intersect, Is, Orient, Union

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
        check_label(self.label)
        if not self.action.makes_hulls:
            raise ProgramError(f"{self.action} makes no hull that could take the label {self.label!r}")

    def __str__(self) -> str:
        return show(self)


SyntaxNode = syntax.Extractor | Action | syntax.LandmarkPair | syntax.Orient | Rule


def show(node: SyntaxNode) -> str:
    """A node as program text."""
    match node:
        case All() | Is() | Geo() | Attach() | Union() | Intersect() | Diff():
            return str(node)
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


def show_rule(rule: Rule, width: int) -> str:
    """A rule on one line, its arrow behind `width` characters at least."""
    label = f" as {show_label(rule.label)}" if rule.label is not None else ""
    return f"{show(rule.extractor):<{width}} => {rule.action}{label}"


_SOLID_WORDS = {"box": "box", "cylinder": "cylinder", "capsule": "capsule", "sphere": "sphere or ellipsoid"}


def explain(node: Rule | Orient | Extractor) -> str:
    """A sentence for a rule or an orientation, a noun phrase for an extractor."""
    match node:
        case Rule(extractor, action, label):
            relabel = f"; what is made is labelled {_quote_label(label)}" if label is not None else ""
            sentence = f"{_action_sentence(action, _subject_phrase(extractor))}{relabel}."
            return sentence[0].upper() + sentence[1:]
        case Orient():
            return _explain_orient(node)
        case All() | Is():
            return _all_phrase(node)
        case Attach(selected) | Geo(selected):
            return f"{_all_phrase(selected)} {_condition_phrase(node)}"
        case Union(left, right):
            return f"{_operand_phrase(left)} and {_operand_phrase(right)}"
        case Intersect(left, right):
            return f"{_operand_phrase(left)}, but only {_operand_phrase(right, left)}"
        case Diff(left, right):
            return f"{_operand_phrase(left)}, except {_operand_phrase(right, left)}"
        case _:
            assert_never(node)


def _subject_phrase(extractor: Extractor) -> str:
    """The phrase before a verb: an insertion is closed by a comma."""
    return explain(extractor) + "," * isinstance(extractor, Intersect | Diff)


def _condition_phrase(part: Attach | Geo) -> str:
    match part:
        case Attach(selected, anchor):
            return f"that touch {_one_phrase(anchor, other=selected)}"
        case Geo(_, direction):
            return f"that reach farthest along {direction}"
        case _:
            assert_never(part)


def _operand_phrase(part: Extractor, of: Extractor | None = None) -> str:
    """The phrase for one side of a set operator, in brackets where it is one itself; `of`: the side before it."""
    if (isinstance(part, Attach) and part.selected == of) or (isinstance(part, Geo) and part.base == of):
        return f"those {_condition_phrase(part)}"
    return f"({explain(part)})" if isinstance(part, Union | Intersect | Diff) else explain(part)


def _all_phrase(base: BaseExtractor) -> str:
    return f"the {_quote_label(base.label)} hulls" if isinstance(base, Is) else "all hulls"


def _one_phrase(anchor: BaseExtractor, other: BaseExtractor) -> str:
    """The phrase for a hull that is touched; `other` are those that touch it: none is its own neighbour."""
    if isinstance(anchor, All):
        return "any other hull"
    word = _quote_label(anchor.label)
    article = "another" if anchor == other else "an" if word[0].lower() in "aeiou" else "a"
    return f"{article} {word} hull"


def _quote_label(label: str) -> str:
    return label if WORD.fullmatch(label) else f"“{label}”"


def _explain_orient(orient: Orient) -> str:
    ways = [f"{pair.axis} points from {_all_phrase(pair.start)} to {_all_phrase(pair.end)}" for pair in orient.pairs]
    how = "by quarter turns, so that, as nearly as they allow, " if orient.snap else "so that "
    return f"For reasoning, turn every asset {how}{' and '.join(ways)}."


def _action_sentence(action: Action, hulls: str) -> str:
    """What an action does to `hulls`; a sentence without its end."""
    if isinstance(action, Each):
        return f"each connected group of {hulls.removeprefix('the ')} is {_action_phrase(action.action, 'its')}"
    parts = ", one for each body" if action.by_body else ""
    return f"{hulls} are {_action_phrase(action, 'their')}{parts}"


def _action_phrase(action: Action, whose: str) -> str:
    match action:
        case Delete():
            return "deleted"
        case Merge():
            return "merged into one convex hull"
        case Replace():
            return f"replaced by {_substitute_phrase(action, whose)}"
        case Add():
            size = "in its own size" if action.keep else "as large as fits"
            return f"given “{action.template}” at {whose} {action.direction} side, {size}"
        case Scale():
            where = "in every direction" if action.axis == "all" else f"along {action.axis}"
            return f"scaled by {show_number(action.factor)} {where}, about {whose} common centre"
        case Shrink():
            return f"made smaller all round by {show_number(action.distance)} m"
        case _:
            return f"edited by {action}"  # of a plug-in


def _substitute_phrase(action: Replace, whose: str) -> str:
    if action.geometry not in PRIMITIVES:
        turned = " turned lengthwise and" if action.fit == "longest" else ""
        return f"“{action.geometry}”,{turned} stretched to fill {whose} bounding box"
    solid, around = _SOLID_WORDS[action.geometry], f"around {'it' if whose == 'its' else 'them'}"
    along = f", along {action.axis}" if action.axis else ""
    if action.radius:
        size = f"radius {show_number(action.radius)} m"
        return f"a {action.geometry} of {size} at the middle of {whose} bounding box{along}"
    match action.fit:
        case "tight":
            return f"the smallest {solid} {around}, at any angle"
        case "native":
            return _native_phrase(action, whose, around)
        case "inscribed":
            return f"the largest {action.geometry} inside {whose} convex hull{along}"
        case "volume":
            return f"a {action.geometry} of {whose} volume{along}"
        case "longest":
            return f"a sphere as wide as the longest side of {whose} bounding box"
        case _:
            return f"a {solid} that fills {whose} bounding box{along}"


def _native_phrase(action: Replace, whose: str, around: str) -> str:
    if action.geometry == "sphere":
        return f"the smallest sphere {around}"
    if action.geometry == "cylinder" and not action.axis:
        return f"the smallest cylinder {around} along X, Y or Z"
    side = action.axis or f"the longest side of {whose} bounding box"
    return f"the thinnest {action.geometry} {around}, along {side}"
