"""What all building of nodes from parse trees needs: access to the parts of a tree, labels, errors at a place."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

from meshforge.errors import ProgramError
from meshforge.language.places import Source
from meshforge.language.print import RESERVED
from meshforge.language.program import check_declared
from meshforge.language.syntax import check_label

if TYPE_CHECKING:
    from lark import Token, Tree

    Node = Tree[Token]

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Text:
    """A program text that is read, and the labels it may use, empty for any."""

    source: Source
    declared: tuple[str, ...] = ()

    def read_label(self, node: Node) -> str:
        """The label of a `label` node: no operator name, and declared where labels are."""
        (token,) = tokens(node)
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


def nodes(tree: Node) -> list[Node]:
    """The trees below a tree."""
    from lark import Tree

    return [part for part in tree.children if isinstance(part, Tree)]


def tokens(tree: Node) -> list[Token]:
    """The pieces of text below a tree."""
    from lark import Token

    return [part for part in tree.children if isinstance(part, Token)]


def start_of(part: Node | Token) -> int:
    """The offset in the text at which a part begins."""
    from lark import Token

    return int((part.start_pos if isinstance(part, Token) else part.meta.start_pos) or 0)
