"""Program text to nodes; every error has its line, its column and a caret."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, cast

from meshforge.errors import ProgramError
from meshforge.language.actions import Action
from meshforge.language.build import build_extractor, build_orient, build_program
from meshforge.language.build_action import build_action
from meshforge.language.places import Source
from meshforge.language.program import Program
from meshforge.language.syntax import Extractor, Orient
from meshforge.language.syntax_errors import syntax_error
from meshforge.language.trees import Text

if TYPE_CHECKING:
    from lark import Lark, Token, Tree


def parse(text: str, name: str = "program") -> Program:
    """The program in a text. Raises ProgramError at `name:line:column`."""
    source = Source(text.removeprefix("\ufeff").removesuffix("\n") + "\n", name)
    try:
        return build_program(source, _tree(source, "program"))
    except RecursionError:
        raise ProgramError("its extractors are nested too deep", where=name) from None


def read(path: Path) -> Program:
    """The program in a file. Raises ProgramError where it cannot be read or does not parse."""
    try:
        return parse(path.read_text(encoding="utf-8"), str(path))
    except OSError as error:
        raise ProgramError(f"the program cannot be read ({error.strerror})", where=str(path)) from None
    except UnicodeDecodeError:
        raise ProgramError("the program is not text in UTF-8", where=str(path)) from None


def parse_extractor(text: str, name: str = "extractor") -> Extractor:
    """The extractor in a text; any label is known. Raises ProgramError at `name:line:column`."""
    source = Source(text.strip(), name)
    return build_extractor(Text(source), _child(_tree(source, "only_extractor")))


def parse_action(text: str, name: str = "action") -> Action:
    """The action in a text. Raises ProgramError at `name:line:column`."""
    source = Source(text.strip(), name)
    return build_action(Text(source), _child(_tree(source, "only_action")))


def parse_orient(text: str, name: str = "orient") -> Orient:
    """The orientation directive in a text, `orient ...` as in a program. Raises ProgramError at `name:line:column`."""
    source = Source(text.strip(), name)
    return build_orient(Text(source), _child(_tree(source, "only_orient")))


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


def _tree(source: Source, start: str) -> Tree[Token]:
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


def _child(tree: Tree[Token]) -> Tree[Token]:
    from lark import Tree

    (child,) = tree.children
    assert isinstance(child, Tree)
    return child
