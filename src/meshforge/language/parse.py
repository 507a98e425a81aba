"""Program text to parse trees, comments and nodes. What a grammar cannot check is checked here; every error has its
line, its column and a caret."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from meshforge.common import ProgramError
from meshforge.language import syntax
from meshforge.language import text as program_text
from meshforge.language.actions import base
from meshforge.language.actions.registry import ACTIONS, make_action
from meshforge.language.print import CommentLines, Comments, Rule
from meshforge.language.text import Node, ProgramText, TreeReader, likely_word, quote_code, subtrees_of, tokens_of
from meshforge.language.words import OPERATORS, Direction, check_direction

if TYPE_CHECKING:  # lark is loaded where a program is parsed
    from lark import Lark, Token

_SET_OPERATORS: dict[str, type[syntax.Union | syntax.Intersect | syntax.Diff]] = {
    "union": syntax.Union,
    "intersect": syntax.Intersect,
    "diff": syntax.Diff,
}
_TOKEN_KINDS: dict[str, base.TokenKind] = {
    "NAME": "word",
    "STRING": "text",
    "NUMBER": "number",
    "DIRECTION": "direction",
}
_TEXT_OR_COMMENT = re.compile(r'"(?:[^"\\\n]|\\.)*"|#(?P<comment>[^\n]*)')


def parse_extractor(text: str, name: str = "extractor") -> syntax.Extractor:
    """The extractor in a text; any label is known. Raises ProgramError at `name:line:column`."""
    source = ProgramText(text.strip(), name)
    return build_extractor(TreeReader(source), _only_child(parse_tree(source, "only_extractor")))


@cache
def _grammar() -> Lark:
    from lark import Lark  # lazy: most runs parse no program

    return Lark(
        Path(__file__).with_name("grammar.lark").read_text(encoding="utf-8"),
        parser="lalr",
        start=["program", "only_extractor"],
        propagate_positions=True,
        maybe_placeholders=True,
    )


def parse_tree(source: ProgramText, start: str) -> Node:
    """The parse tree of a text. Raises ProgramError where it has none."""
    from lark import Token, UnexpectedCharacters, UnexpectedInput, UnexpectedToken  # lazy: most runs parse no program

    parsing = _grammar().parse_interactive(source.text, start=start)
    before = ""
    try:
        for token in parsing.iter_parse():
            before = str(token)
        return cast(Node, parsing.feed_token(Token("$END", "")))
    except UnexpectedInput as error:
        at_end = isinstance(error, UnexpectedToken) and error.token.type == "$END"
        assert isinstance(error, UnexpectedCharacters | UnexpectedToken)
        offset = len(source.text.rstrip("\n")) if at_end else int(error.pos_in_stream or 0)
        accepted: set[str] = parsing.accepts()  # type: ignore[no-untyped-call]  # lark leaves it untyped
        raise program_text.syntax_error(source, offset, accepted, before) from None


def _only_child(tree: Node) -> Node:
    (child,) = subtrees_of(tree)
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


def build_rule(text: TreeReader, tree: Node, comments: Comments) -> Rule:
    """The rule of a `rule` node."""
    extractor, action, *label = subtrees_of(tree)
    parts = build_extractor(text, extractor), build_action(text, action), text.read_label(label[0]) if label else None
    return text.locate_errors(label[0] if label else tree, lambda: Rule(*parts, comments))


def build_extractor(text: TreeReader, tree: Node) -> syntax.Extractor:
    """The extractor of a node of the grammar's `extractor`."""
    match tree.data:
        case "attach":
            selected, anchor = subtrees_of(tree)
            return syntax.Attach(_build_base(text, selected), _build_base(text, anchor))
        case "geo":
            return syntax.Geo(_build_base(text, subtrees_of(tree)[0]), _build_direction(text, tokens_of(tree)[0]))
        case "union" | "intersect" | "diff":
            kind = _SET_OPERATORS[tree.data]
            left, right = subtrees_of(tree)
            return kind(build_extractor(text, left), build_extractor(text, right))
        case _:
            return _build_base(text, tree)


def build_orient(text: TreeReader, tree: Node) -> syntax.Orient:
    """The directive of an `orient` node; an error is about the pair that is one too many or turns back."""
    nodes = subtrees_of(tree)
    pairs = tuple(_build_pair(text, node) for node in nodes)
    wrong = nodes[min(2, len(nodes) - 1)]
    return text.locate_errors(wrong, lambda: syntax.Orient(pairs, snap=len(tokens_of(tree)) > 0))


def _build_pair(text: TreeReader, tree: Node) -> syntax.LandmarkPair:
    start, end = subtrees_of(tree)
    return syntax.LandmarkPair(
        _build_direction(text, tokens_of(tree)[0]), _build_base(text, start), _build_base(text, end)
    )


def _build_base(text: TreeReader, tree: Node) -> syntax.BaseExtractor:
    return syntax.All() if tree.data == "all" else syntax.Is(text.read_label(subtrees_of(tree)[0]))


def _build_direction(text: TreeReader, token: Token) -> Direction:
    try:
        check_direction(token)
    except ProgramError as error:
        like = likely_word(token[1:], ["+X", "+Y", "+Z"])
        hint = f"Did you mean {token[0]}{like[1]}? " if like else ""
        raise text.error_at(token, f"unknown direction `{token}`", f"{hint}{error.remedy}") from None
    return cast(Direction, str(token))


def collect_headers(text: TreeReader, statements: list[Node]) -> dict[str, Node]:
    """The header statements by their kind. Raises ProgramError for one that is given twice."""
    headers: dict[str, Node] = {}
    for node in statements:
        if node.data in headers:
            line = headers[node.data].meta.line
            raise text.error_at(node, f"{node.data} is given twice", f"It stands on line {line} already.")
        headers[node.data] = node
    return headers


def build_labels(text: TreeReader, tree: Node) -> tuple[str, ...]:
    """The labels that a `labels` header declares. Raises ProgramError for one that is declared twice."""
    labels: list[str] = []
    for node in subtrees_of(tree):
        label = text.read_label(node)
        if label in labels:
            raise text.error_at(node, f"the label {label!r} is declared twice", "Leave one of them out.")
        labels.append(label)
    return tuple(labels)


def build_threshold(text: TreeReader, tree: Node | None) -> float | None:
    """The number of a threshold header; None where the header is missing."""
    if tree is None:
        return None
    (token,) = tokens_of(tree)
    text.locate_errors(token, lambda: syntax.check_threshold(tree.data, float(token)))
    return float(token)


def build_action(text: TreeReader, tree: Node) -> base.Action:
    """The action of an `action` node. Raises ProgramError at its name or at the argument that does not fit."""
    (name,) = tokens_of(tree)[:1]
    parts = [part for part in tree.children[1:] if part is not None]
    kind = text.locate_errors(name, lambda: ACTIONS.get(name))
    if kind is None:
        raise _unknown_action(text, name)
    _refuse_planned(text, kind, parts)
    takes, needed = kind.arguments(), kind.min_arguments()
    if len(parts) < needed:
        raise text.error_at(name, f"{name} lacks an argument", f"Write {kind.usage()}.")
    given = {
        field: _build_argument(text, kind, argument, part)
        for part, (field, argument) in zip(parts, list(takes.items())[:needed], strict=False)
    }
    made = text.locate_errors(tree, lambda: make_action(kind, given))
    for part in parts[needed:]:
        given |= [_build_option(text, kind, given, part)]
        made = text.locate_errors(part, partial(make_action, kind, dict(given)))
    return made


def _refuse_planned(text: TreeReader, kind: type[base.Action], parts: Iterable[Node | Token]) -> None:
    """Raise ProgramError for an option of the language that this version does not run."""
    for part in parts:
        word = text.source.piece_at(program_text.start_of(part))
        if word in kind.planned:
            problem = f"this version does not run the option {quote_code(word)} of {kind.__name__}"
            raise text.error_at(part, problem, "Leave it out.")


def _build_option(
    text: TreeReader, kind: type[base.Action], given: Mapping[str, Any], part: Node | Token
) -> tuple[str, Any]:
    """The field and the value of an argument that may be left out. Raises ProgramError for one that the action does
    not take, takes once only, or takes in another form."""
    named = None if isinstance(part, str) or part.data != "option" else part
    is_named, (word, value) = named is not None, named.children if named else (_bare_token(part), part)
    takes, taken = list(kind.arguments().items())[kind.min_arguments() :], None
    for field, argument in takes:
        needs_value = isinstance(argument, base.OptionArgument)
        if word in argument.choices and needs_value != is_named:
            problem = f"{word} {'lacks its value' if needs_value else 'takes no value'}"
            raise text.error_at(part, problem, f"Write {argument.usage if needs_value else word}.")
        if needs_value:
            found = _build_argument(text, kind, argument, value) if word in argument.choices else None
        else:
            found = None if is_named else _read_argument(text, argument, value)
        if found is not None and field not in given:
            return field, found
        taken = argument if found is not None else taken
    if taken:
        several = f"{kind.__name__} takes one of {base.join_alternatives(taken.choices)} only"
        problem = several if len(taken.choices) > 1 else f"{word} is given twice"
        raise text.error_at(part, problem, "Leave one of them out.")
    raise _unknown_option(text, kind, part, [argument for _, argument in takes])


def _unknown_option(
    text: TreeReader, kind: type[base.Action], part: Node | Token, takes: Sequence[base.ArgumentType]
) -> ProgramError:
    thing = quote_code(text.source.piece_at(program_text.start_of(part)))
    if not takes:
        return text.error_at(part, f"{kind.__name__} takes no further argument, not {thing}", f"Write {kind.usage()}.")
    words = [word for argument in takes for word in argument.choices or (argument.usage,)]
    like = likely_word(thing.strip("`"), words)
    remedy = f"{f'Did you mean {like}? ' if like else ''}Write {kind.usage()}."
    return text.error_at(part, f"{kind.__name__} takes {base.join_alternatives(words)} here, not {thing}", remedy)


def _unknown_action(text: TreeReader, name: Token) -> ProgramError:
    known = f"Actions are {base.join_alternatives(ACTIONS)}."
    if name in OPERATORS:
        return text.error_at(name, f"{name} selects hulls, it is no action", known)
    like = likely_word(name, ACTIONS)
    return text.error_at(name, f"unknown action {quote_code(name)}", f"Did you mean {like}? {known}" if like else known)


def _build_argument(text: TreeReader, kind: type[base.Action], argument: base.ArgumentType, given: Node | Token) -> Any:
    if isinstance(argument, base.ActionArgument) and not isinstance(given, str):
        return build_action(text, given)
    value = _read_argument(text, argument, given)
    if value is None:
        raise _misfit_error(text, kind, argument, given)
    return value


def _read_argument(text: TreeReader, argument: base.ArgumentType, given: Node | Token) -> Any | None:
    """The value of an argument, None where it is no such."""
    token = _bare_token(given)
    if token is None:
        return None
    return argument.read(_TOKEN_KINDS[token.type], text.unquote(token) if token.type == "STRING" else str(token))


def _bare_token(given: Node | Token) -> Token | None:
    """The piece of text that an argument is; None where it has arguments of its own."""
    if isinstance(given, str):
        return given
    if given.data == "option":
        return None
    return tokens_of(given)[0] if subtrees_of(given) == [] and len(tokens_of(given)) == 1 else None


def _misfit_error(
    text: TreeReader, kind: type[base.Action], argument: base.ArgumentType, given: Node | Token
) -> ProgramError:
    thing = text.source.piece_at(program_text.start_of(given))
    remedy = f"Write {kind.usage()}."
    like = likely_word(thing.strip('"'), argument.choices)
    if like:
        remedy = f"Did you mean {like}? {remedy}"
    elif isinstance(argument, base.FileArgument) and "\\" in thing:
        remedy = "Write / between the folders of a path."
    return text.error_at(given, f"{kind.__name__} takes {argument.wants} here, not {quote_code(thing)}", remedy)
