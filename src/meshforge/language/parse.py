"""Program text to parse trees, comments and nodes; every error has its line, its column and a caret."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, cast

from meshforge.language.actions.base import Action
from meshforge.language.build import build_action, build_extractor, build_orient
from meshforge.language.print import CommentLines, Comments
from meshforge.language.syntax import Extractor, Orient
from meshforge.language.syntax_errors import syntax_error
from meshforge.language.text import ProgramText, TreeReader

if TYPE_CHECKING:
    from lark import Lark, Token, Tree


_TEXT_OR_COMMENT = re.compile(r'"(?:[^"\\\n]|\\.)*"|#(?P<comment>[^\n]*)')


def parse_extractor(text: str, name: str = "extractor") -> Extractor:
    """The extractor in a text; any label is known. Raises ProgramError at `name:line:column`."""
    source = ProgramText(text.strip(), name)
    return build_extractor(TreeReader(source), _only_child(parse_tree(source, "only_extractor")))


def parse_action(text: str, name: str = "action") -> Action:
    """The action in a text. Raises ProgramError at `name:line:column`."""
    source = ProgramText(text.strip(), name)
    return build_action(TreeReader(source), _only_child(parse_tree(source, "only_action")))


def parse_orient(text: str, name: str = "orient") -> Orient:
    """The orientation directive in a text, `orient ...` as in a program. Raises ProgramError at `name:line:column`."""
    source = ProgramText(text.strip(), name)
    return build_orient(TreeReader(source), _only_child(parse_tree(source, "only_orient")))


@cache
def _grammar() -> Lark:
    from lark import Lark

    return Lark(
        Path(__file__).with_name("grammar.lark").read_text(encoding="utf-8"),
        parser="lalr",
        start=["program", "only_extractor", "only_action", "only_orient"],
        propagate_positions=True,
        maybe_placeholders=True,
    )


def parse_tree(source: ProgramText, start: str) -> Tree[Token]:
    """The parse tree of a text. Raises ProgramError where it has none."""
    from lark import Token, UnexpectedCharacters, UnexpectedToken
    from lark.exceptions import UnexpectedInput

    parsing = _grammar().parse_interactive(source.text, start=start)
    before = ""
    try:
        for token in parsing.iter_parse():
            before = str(token)
        return cast("Tree[Token]", parsing.feed_token(Token("$END", "")))
    except UnexpectedInput as error:
        at_end = isinstance(error, UnexpectedToken) and error.token.type == "$END"
        assert isinstance(error, UnexpectedCharacters | UnexpectedToken)
        offset = len(source.text.rstrip("\n")) if at_end else int(error.pos_in_stream or 0)
        accepted: set[str] = parsing.accepts()  # type: ignore[no-untyped-call]  # lark leaves it untyped
        raise syntax_error(source, offset, accepted, before) from None


def _only_child(tree: Tree[Token]) -> Tree[Token]:
    from lark import Tree

    (child,) = tree.children
    assert isinstance(child, Tree)
    return child


def attach_comments(text: str, lines: Sequence[int]) -> tuple[list[Comments], CommentLines]:
    """The comments of the statements on some lines (from 1, rising), and those after the last one.

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
    """The comment in a line of program text, without its `#`."""
    for match in _TEXT_OR_COMMENT.finditer(line):
        if match["comment"] is not None:
            return match["comment"].rstrip()
    return None


def _squeeze_blanks(lines: Iterable[str | None], *, first: bool) -> CommentLines:
    """The lines with several empty ones as one, and none at the start of a text."""
    out: list[str | None] = []
    for line in lines:
        if line is not None or (out[-1] is not None if out else not first):
            out.append(line)
    return tuple(out)
