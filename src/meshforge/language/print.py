"""Rules, and every node below a program in words: as text in canonical form, of which `parse` is the inverse, and in
plain sentences for people who do not read the language."""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import assert_never

from meshforge.common import ProgramError, blame
from meshforge.language.actions.base import Action
from meshforge.language.actions.basic import Each
from meshforge.language.extractors.base import Diff, Extractor, Intersect, Leaf, Union
from meshforge.language.orient import LandmarkPair, Orient
from meshforge.language.words import check_label, quote_label, show_label

CommentLines = tuple[str | None, ...]
"""Comment lines without their `#`; None is an empty line."""
_TEXT_OR_COMMENT = re.compile(r'"(?:[^"\\\n]|\\.)*"|#(?P<comment>[^\n]*)')


@dataclass(frozen=True, slots=True)
class Comments:
    """The lines above a statement and the comment at its end."""

    above: CommentLines = ()
    beside: str | None = None


def attach_comments(text: str, lines: Sequence[int]) -> tuple[list[Comments], CommentLines]:
    """Return the comments of the statements on some lines (from 1, rising), and those after the last one.

    A comment alone on its line belongs to the next statement; empty lines between are kept, several as one.
    """
    found = [_comment_of(line) for line in text.split("\n")]
    comments, done = [], 0
    for line in lines:
        comments.append(Comments(_squeeze_blanks(found[done : line - 1], first=done == 0), found[line - 1]))
        done = line
    end = _squeeze_blanks(found[done:], first=done == 0)
    return comments, end[:-1] if end[-1:] == (None,) else end


def _comment_of(line: str) -> str | None:
    for match in _TEXT_OR_COMMENT.finditer(line):
        if match["comment"] is not None:
            return match["comment"].rstrip()
    return None


def _squeeze_blanks(lines: Iterable[str | None], *, first: bool) -> CommentLines:
    out: list[str | None] = []
    for line in lines:
        if line is not None or (out[-1] is not None if out else not first):
            out.append(line)
    return tuple(out)


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
        return show_rule(self, 0)


SyntaxNode = Extractor | Action | LandmarkPair | Orient | Rule


def show(node: SyntaxNode) -> str:
    """Return a node as program text."""
    return str(node)


def show_rule(rule: Rule, width: int) -> str:
    """Return a rule on one line, its arrow behind `width` characters at least."""
    label = f" as {show_label(rule.label)}" if rule.label is not None else ""
    return f"{rule.extractor!s:<{width}} => {rule.action}{label}"


def explain(node: Rule | Orient | Extractor) -> str:
    """Return a sentence for a rule or an orientation, a noun phrase for an extractor."""
    match node:
        case Rule(extractor, action, label):
            relabel = f"; what is made is labelled {quote_label(label)}" if label is not None else ""
            comma = "," * isinstance(extractor, Intersect | Diff)  # which closes an insertion
            sentence = f"{_action_sentence(action, explain(extractor) + comma)}{relabel}."
            return sentence[0].upper() + sentence[1:]
        case Orient():
            return _explain_orient(node)
        case Leaf():
            with blame(node.plugin):
                return f"{explain(node.bases[0])} {node.phrase}" if node.bases else node.phrase
        case Union(left, right):
            return f"{_operand_phrase(left)} and {_operand_phrase(right)}"
        case Intersect(left, right):
            return f"{_operand_phrase(left)}, but only {_operand_phrase(right, left)}"
        case Diff(left, right):
            return f"{_operand_phrase(left)}, except {_operand_phrase(right, left)}"
        case _:
            assert_never(node)


def _operand_phrase(part: Extractor, of: Extractor | None = None) -> str:
    """The phrase for one side of a set operator, in brackets where it is one itself; `of`: the side before it."""
    if isinstance(part, Leaf) and part.bases[:1] == (of,):
        return f"those {part.phrase}"
    return f"({explain(part)})" if isinstance(part, Union | Intersect | Diff) else explain(part)


def _explain_orient(orient: Orient) -> str:
    ways = [f"{pair.axis} points from {pair.start.phrase} to {pair.end.phrase}" for pair in orient.pairs]
    how = "by quarter turns, so that, as nearly as they allow, " if orient.snap else "so that "
    return f"For reasoning, turn every asset {how}{' and '.join(ways)}."


def _action_sentence(action: Action, hulls: str) -> str:
    if isinstance(action, Each):
        return f"each connected group of {hulls.removeprefix('the ')} is {action.action.phrase('its')}"
    parts = ", one for each body" if action.by_body else ""
    return f"{hulls} are {action.phrase('their')}{parts}"
