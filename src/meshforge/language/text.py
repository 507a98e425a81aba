"""Program texts and their parse trees: places with line and column, errors that show them with a caret, labels read."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

from meshforge.common import ProgramError
from meshforge.language.print import RESERVED
from meshforge.language.syntax import check_declared, check_label

_PIECE = re.compile(r"""[^\W\d]\w*|"(?:[^"\\\n]|\\.)*"|[+-]?(?:\d+\.?\d*|\.\d+)\w*|[+-][^\W\d]\w*|=>|->|[^\n]|""")

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class ProgramText:
    """A program text and the name it goes by in errors."""

    text: str
    name: str

    def piece_at(self, offset: int) -> str:
        """The word, text, number or sign at an offset; empty at the end of a line."""
        found = _PIECE.match(self.text, offset)
        thing = found.group() if found else ""
        return "" if thing.startswith("#") or thing.isspace() else thing

    def position_of(self, offset: int) -> tuple[int, int]:
        """Line and column of an offset, both from 1."""
        before = self.text[:offset]
        return before.count("\n") + 1, offset - (before.rfind("\n") + 1) + 1

    def error_at(self, offset: int, problem: str, remedy: str | None = None, width: int | None = None) -> ProgramError:
        """The error at an offset, with the line and `width` carets below it (the length of what stands there)."""
        line, column = self.position_of(offset)
        text = self.text.split("\n")[line - 1].replace("\t", " ").rstrip("\r")
        carets = "^" * max(1, len(self.piece_at(offset)) if width is None else width)
        excerpt = f"    {text}\n    {' ' * (column - 1)}{carets}"
        return ProgramError(f"{problem}\n{excerpt}", where=f"{self.name}:{line}:{column}", remedy=remedy)


if TYPE_CHECKING:
    from lark import Token, Tree

    Node = Tree[Token]


@dataclass(frozen=True, slots=True)
class TreeReader:
    """A program text that is read, and the labels it may use, empty for any."""

    source: ProgramText
    declared: tuple[str, ...] = ()

    def read_label(self, node: Node) -> str:
        """The label of a `label` node: no operator name, and declared where labels are."""
        (token,) = tokens_of(node)
        if token.type == "NAME" and token in RESERVED:
            raise self.error_at(token, f"{token} is the name of an operator", f'As a label it is written "{token}".')
        label = self.unquote(token) if token.type == "STRING" else str(token)
        self.locate_errors(node, lambda: check_label(label))
        if self.declared:
            self.locate_errors(node, lambda: check_declared(label, self.declared))
        return label

    def unquote(self, token: Token) -> str:
        """The text between quotation marks."""
        try:
            return str(json.loads(token))
        except ValueError:
            remedy = r"Write \\ for a backslash and \" for a quotation mark."
            raise self.error_at(token, "a backslash in this text begins nothing known", remedy) from None

    def locate_errors(self, at: Node | Token, make: Callable[[], T], width: int | None = None) -> T:
        """What is made; an error on the way is given its place in the text."""
        try:
            return make()
        except ProgramError as error:
            raise self.source.error_at(start_of(at), error.problem, error.remedy, width) from None

    def error_at(self, at: Node | Token, problem: str, remedy: str | None) -> ProgramError:
        return self.source.error_at(start_of(at), problem, remedy)


def subtrees_of(tree: Node) -> list[Node]:
    """The trees below a tree."""
    from lark import Tree

    return [part for part in tree.children if isinstance(part, Tree)]


def tokens_of(tree: Node) -> list[Token]:
    """The pieces of text below a tree."""
    from lark import Token

    return [part for part in tree.children if isinstance(part, Token)]


def start_of(part: Node | Token) -> int:
    """The offset in the text at which a part begins."""
    from lark import Token

    return int((part.start_pos if isinstance(part, Token) else part.meta.start_pos) or 0)
