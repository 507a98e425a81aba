"""Program texts and their parse trees: places with line and column, labels read, and errors in plain words: what was
expected at a place, what stands there, and what was probably meant."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable, Set
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias, TypeVar

from meshforge.common import PluginError, ProgramError, join_and, nearest_name
from meshforge.language.arguments import join_alternatives
from meshforge.language.extractors.base import SET_OPERATORS, BaseExtractor
from meshforge.language.registry import ACTIONS, EXTRACTORS
from meshforge.language.words import DIRECTIONS, RESERVED, check_declared, check_label

if TYPE_CHECKING:  # lark is loaded where a program is parsed
    from lark import Token, Tree

_PIECE = re.compile(r"""[^\W\d]\w*|"(?:[^"\\\n]|\\.)*"|[+-]?(?:\d+\.?\d*|\.\d+)\w*|[+-][^\W\d]\w*|=>|->|[^\n]|""")

Node: TypeAlias = "Tree[Token]"
T = TypeVar("T")

HEADERS = ("labels", "contact", "extremity", "orient")
QUOTE_NAMES = "Put names with other characters than letters, digits and _ in double quotes."
_SIGNS = {"COMMA": ",", "COLON": ":", "LPAR": "(", "RPAR": ")", "_EQUALS": "=", "_TO": "->", "_ARROW": "=>"}
_SETS = tuple(kind.__name__ for kind in SET_OPERATORS)
_WORDS = {f"_{word.upper()}": word for word in (*HEADERS, *_SETS, "as")} | {"SNAP": "snap"}
_LEAF = "leaf "


@dataclass(frozen=True, slots=True)
class ProgramText:
    """A program text and the name it goes by in errors."""

    text: str
    name: str

    def piece_at(self, offset: int) -> str:
        """Return the word, text, number or sign at an offset; empty at the end of a line."""
        found = _PIECE.match(self.text, offset)
        thing = found.group() if found else ""
        return "" if thing.startswith("#") or thing.isspace() else thing

    def position_of(self, offset: int) -> tuple[int, int]:
        """Return line and column of an offset, both from 1."""
        before = self.text[:offset]
        return before.count("\n") + 1, offset - (before.rfind("\n") + 1) + 1

    def error_at(self, offset: int, problem: str, remedy: str | None = None, width: int | None = None) -> ProgramError:
        """Return the error at an offset, with its line and carets below it; width: None for the piece there."""
        line, column = self.position_of(offset)
        text = self.text.split("\n")[line - 1].replace("\t", " ").rstrip("\r")
        carets = "^" * max(1, len(self.piece_at(offset)) if width is None else width)
        excerpt = f"    {text}\n    {' ' * (column - 1)}{carets}"
        return ProgramError(f"{problem}\n{excerpt}", where=f"{self.name}:{line}:{column}", remedy=remedy)


@dataclass(frozen=True, slots=True)
class TreeReader:
    """A program text that is read, and the labels it may use, empty for any."""

    source: ProgramText
    declared: tuple[str, ...] = ()

    def read_label(self, node: Node) -> str:
        """Return the label of a `label` node: no operator name, and declared where labels are."""
        (token,) = tokens_of(node)
        if token.type == "NAME" and token in RESERVED:
            raise self.error_at(token, f"{token} is the name of an operator", f'As a label it is written "{token}".')
        label = self.unquote(token) if token.type == "STRING" else str(token)
        self.locate_errors(node, lambda: check_label(label))
        if self.declared:
            self.locate_errors(node, lambda: check_declared(label, self.declared))
        return label

    def unquote(self, token: Token) -> str:
        """Return the text between quotation marks."""
        try:
            return str(json.loads(token))
        except ValueError:
            remedy = r"Write \\ for a backslash and \" for a quotation mark."
            raise self.error_at(token, "a backslash in this text begins nothing known", remedy) from None

    def locate_errors(self, at: Node | Token, make: Callable[[], T], width: int | None = None) -> T:
        """Return what is made; an error on the way is given its place in the text."""
        try:
            return make()
        except (ProgramError, PluginError) as error:
            raise self.source.error_at(start_of(at), error.problem, error.remedy, width) from None

    def find_error(self, at: Node | Token, make: Callable[[], object]) -> ProgramError | None:
        """Return the error with its place in the text where something cannot be made, else None."""
        try:
            self.locate_errors(at, make)
        except ProgramError as error:
            return error
        return None

    def error_at(self, at: Node | Token, problem: str, remedy: str | None) -> ProgramError:
        return self.source.error_at(start_of(at), problem, remedy)


def subtrees_of(tree: Node) -> list[Node]:
    """Return the trees below a tree."""
    return [part for part in tree.children if part is not None and not isinstance(part, str)]


def tokens_of(tree: Node) -> list[Token]:
    """Return the pieces of text below a tree."""
    return [part for part in tree.children if isinstance(part, str)]


def start_of(part: Node | Token) -> int:
    """Return the offset in the text at which a part begins."""
    return int((part.start_pos if isinstance(part, str) else part.meta.start_pos) or 0)


def syntax_error(source: ProgramText, offset: int, accepted: Set[str], before: str) -> ProgramError:
    """Return the error for an unexpected piece of text.

    accepted: names of the grammar's terminals that may stand there; before: the text of the token before it.
    """
    found = source.piece_at(offset)
    like = likely_word(found, _candidate_words(accepted))
    problem = _problem(found, accepted)
    if like:
        return source.error_at(offset, problem, f"Did you mean {like}?")
    return source.error_at(offset, problem, _remedy(source, offset, found, accepted, before))


def text_of_leaf(name: str) -> str:
    """Return how the word of a leaf extractor is told from terminals of the grammar that may stand at a place."""
    return _LEAF + name


def leaves_among(accepted: Set[str]) -> list[str]:
    """Return the leaf extractors that may stand at a place."""
    return [name.removeprefix(_LEAF) for name in sorted(accepted) if name.startswith(_LEAF)]


def list_operators() -> tuple[str, ...]:
    """Return the words that an extractor may begin with, those of plug-ins among them."""
    return (*EXTRACTORS, *_SETS)


def _list_bases() -> list[str]:
    return [kind.usage() for kind in EXTRACTORS.built_in.values() if issubclass(kind, BaseExtractor)]


def likely_word(word: str, words: Iterable[str]) -> str | None:
    """Return the one of the words that was probably meant, whatever its case."""
    lower = {w.lower(): w for w in words}
    signless = {w[1:].lower(): w for w in words if w[0] in "+-" and w[0] == "+"}
    found = nearest_name(word.lower(), lower)
    return signless.get(word.lower()) or (lower[found] if found else None)


def quote_code(found: str) -> str:
    """Return a piece of program text, for use in a sentence."""
    return f"`{found}`" if found else "the end of the line"


def _problem(found: str, accepted: Set[str]) -> str:
    is_word = found[:1].isalpha() or found[:1] == "_"
    if is_word and "_UNION" in accepted and found not in (*HEADERS, *ACTIONS):
        return f"unknown {'word' if '_LABELS' in accepted else 'operator'} {quote_code(found)}"
    if found == '"':
        return "this text is never closed: a double quotation mark is missing"
    if found in HEADERS and "_UNION" in accepted:
        return f"{found} must stand above the first rule"
    return f"expected {join_alternatives(_expectations(accepted))}, not {quote_code(found)}"


def _expectations(accepted: Set[str]) -> list[str]:
    if "_LABELS" in accepted:
        return [
            f"a header line ({', '.join(HEADERS)})",
            f"a rule, which begins with one of {', '.join(list_operators())}",
        ]
    if "_UNION" in accepted:
        return [f"an extractor ({', '.join(list_operators())})"]
    if leaves_among(accepted):
        return _list_bases()
    phrases = []
    if "NAME" in accepted:
        names = {"STRING", "NUMBER"} & accepted
        phrases.append(
            "an argument" if len(names) == 2 else "a label" if names else f"an action ({', '.join(ACTIONS)})"
        )
    if "NUMBER" in accepted and "NAME" not in accepted:
        phrases.append("a number")
    if "SNAP" in accepted:
        phrases.append("snap")
    if "DIRECTION" in accepted and "NAME" not in accepted:
        phrases.append(f"a direction ({', '.join(DIRECTIONS)})")
    phrases += [f"`{sign}`" for name, sign in _SIGNS.items() if name in accepted]
    phrases += [f"`{word}`" for name, word in _WORDS.items() if name in accepted and word != "snap"]
    return phrases + (["the end of the line"] if accepted & {"_NL", "$END"} else [])


def _candidate_words(accepted: Set[str]) -> list[str]:
    words = [word for name, word in _WORDS.items() if name in accepted] + leaves_among(accepted)
    words += EXTRACTORS.plugin_names if "_UNION" in accepted else ()
    if "DIRECTION" in accepted and "NAME" not in accepted:
        words += DIRECTIONS
    return words + (list(ACTIONS) if "NAME" in accepted and "STRING" not in accepted else [])


def _remedy(source: ProgramText, offset: int, found: str, accepted: Set[str], before: str) -> str | None:
    if leaves_among(accepted) and "_UNION" not in accepted and found in list_operators():
        refining = [name for name, kind in EXTRACTORS.built_in.items() if not issubclass(kind, BaseExtractor)]
        bases = join_alternatives(_list_bases())
        return f"{join_and([*refining, 'orient'])} refine {bases}; combine selections with {join_and(_SETS)}."
    if (found in ACTIONS and "_UNION" in accepted) or "_ARROW" in accepted:
        return "A rule is written `extractor => action`."
    if accepted & {"_TO", "COLON"}:
        return "A landmark pair is written `+Z: start -> end`."
    if "_UNION" in accepted and found[:1].isalpha() and found not in HEADERS:
        return f"Operators are {join_alternatives(list_operators())}."
    if found.startswith("'"):
        return "Write double quotation marks."
    joined = offset > 0 and not source.text[offset - 1].isspace() and before[:1].isalpha() and found[:1] not in "(),"
    if joined or ("NAME" in accepted and found[:1].isdigit()):
        return QUOTE_NAMES
    return None
