"""Program text to nodes; what a grammar cannot check is checked here, with line, column and caret."""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, cast

from meshforge.common import PluginError, ProgramError
from meshforge.language import arguments
from meshforge.language.actions.base import ActionArgument
from meshforge.language.extractors.base import (
    SET_OPERATORS,
    BaseArgument,
    BaseExtractor,
    Extractor,
    ExtractorArgument,
    Leaf,
)
from meshforge.language.orient import LandmarkPair, Orient
from meshforge.language.print import Comments, Rule
from meshforge.language.registry import ACTIONS, EXTRACTORS, OperationRegistry, make_operation
from meshforge.language.text import (
    Node,
    ProgramText,
    TreeReader,
    leaves_among,
    likely_word,
    list_operators,
    quote_code,
    start_of,
    subtrees_of,
    syntax_error,
    text_of_leaf,
    tokens_of,
)
from meshforge.language.words import Direction, check_direction, check_threshold

if TYPE_CHECKING:  # lark is loaded where a program is parsed
    from lark import Lark, Token

AnOperation = TypeVar("AnOperation", bound=arguments.Operation)
_SET_OPERATORS = {kind.__name__.lower(): kind for kind in SET_OPERATORS}
_TOKEN_KINDS: dict[str, arguments.TokenKind] = {
    "NAME": "word",
    "STRING": "text",
    "NUMBER": "number",
    "DIRECTION": "direction",
    "QUANTITY": "quantity",
}


def parse_extractor(text: str, name: str = "extractor") -> Extractor:
    """Return the extractor in a text; any label is known. Raises ProgramError at `name:line:column`."""
    source = ProgramText(text.strip(), name)
    return build_extractor(TreeReader(source), subtrees_of(parse_tree(source, "only_extractor"))[0])


def parse_operation(
    text: str, registry: OperationRegistry[AnOperation], start: str, name: str, labels: tuple[str, ...] = ()
) -> AnOperation:
    """Return the operation in a text, by a rule of the grammar; labels: that it may use, any where there are none.

    Raises ProgramError at `name:line:column`.
    """
    source = ProgramText(text.strip(), name)
    word = source.piece_at(0)
    if word not in registry:
        raise _unknown_operation(source, 0, registry)
    (tree,) = subtrees_of(parse_tree(source, start))
    return build_operation(TreeReader(source, labels), tree, registry)


@dataclass(frozen=True, eq=False, slots=True)
class _Grammar:
    """The grammar with the rules of some leaf extractors; words: these by the names of their terminals."""

    parser: Lark
    words: Mapping[str, str]


@cache
def _grammar(kinds: tuple[type[Leaf], ...]) -> _Grammar:
    from lark import Lark  # lazy: most runs parse no program

    rules = {True: list[str](), False: list[str]()}
    lines, words = list[str](), dict[str, str]()
    for k, kind in enumerate(kinds):
        rules[issubclass(kind, BaseExtractor)].append(f"leaf_{k}")
        words[f"LEAF_{k}"] = text_of_leaf(kind.__name__)
        lines += [f"leaf_{k}: LEAF_{k} {_arguments_rule(kind)}", rf"LEAF_{k}.1: /{kind.__name__}\b/"]
    lines += [f"_base: {' | '.join(rules[True])}", f"_leaf: {' | '.join(rules[False])}"]
    text = Path(__file__).with_name("grammar.lark").read_text(encoding="utf-8")
    parser = Lark(
        "\n".join([text, *lines, ""]),
        parser="lalr",
        start=["program", "only_extractor", "only_goal"],
        propagate_positions=True,
        maybe_placeholders=True,
    )
    return _Grammar(parser, words)


def _arguments_rule(kind: type[Leaf]) -> str:
    """The arguments in brackets; those that may be left out are the last, and make nested options."""
    rule, needed = "", kind.min_arguments()
    for place, argument in reversed(list(enumerate(kind.arguments().values()))):
        comma = '"," ' if place else ""
        part = f"{comma}{argument.symbol} {rule}"
        rule = part if place < needed else f"[{part}]"
    brackets = f'"(" {rule} ")"'
    return "" if not rule else brackets if needed else f"[{brackets}]"


def parse_tree(source: ProgramText, start: str, plugins: tuple[type[Leaf], ...] = ()) -> Node:
    """Return the parse tree of a text; plugins: leaves of plug-ins that it uses, found as it is read.

    Raises ProgramError where it has none, PluginError for a leaf that cannot be loaded.
    """
    from lark import Token, UnexpectedCharacters, UnexpectedInput, UnexpectedToken  # lazy: most runs parse no program

    grammar = _grammar((*EXTRACTORS.built_in.values(), *plugins))
    parsing = grammar.parser.parse_interactive(source.text, start=start)
    before = ""
    try:
        for token in parsing.iter_parse():
            before = str(token)
        return cast(Node, parsing.feed_token(Token("$END", "")))
    except UnexpectedInput as error:
        at_end = isinstance(error, UnexpectedToken) and error.token.type == "$END"
        assert isinstance(error, UnexpectedCharacters | UnexpectedToken)
        offset = len(source.text.rstrip("\n")) if at_end else int(error.pos_in_stream or 0)
        names: set[str] = parsing.accepts()  # type: ignore[no-untyped-call]  # lark leaves it untyped
        accepted = {grammar.words.get(name, name) for name in names}
        found = _find_plugin_leaf(source, offset, accepted)
        if found is None:
            raise syntax_error(source, offset, accepted, before) from None
    return parse_tree(source, start, (*plugins, found))


def _find_plugin_leaf(source: ProgramText, offset: int, accepted: Set[str]) -> type[Leaf] | None:
    """The leaf of a plug-in that stands at an offset where the grammar knows none. Raises PluginError."""
    word = source.piece_at(offset)
    if not leaves_among(accepted) or text_of_leaf(word) in accepted or word not in EXTRACTORS.plugin_names:
        return None
    try:
        kind = EXTRACTORS[word]
    except PluginError as error:
        raise source.error_at(offset, error.problem, error.remedy) from None
    is_known = issubclass(kind, BaseExtractor) or "_UNION" in accepted
    return kind if is_known else None


def build_rule(text: TreeReader, tree: Node, comments: Comments) -> Rule:
    """Return the rule of a `rule` node."""
    extractor, action, *label = subtrees_of(tree)
    parts = (
        build_extractor(text, extractor),
        build_operation(text, action, ACTIONS),
        text.read_label(label[0]) if label else None,
    )
    return text.locate_errors(label[0] if label else tree, lambda: Rule(*parts, comments))


def build_extractor(text: TreeReader, tree: Node) -> Extractor:
    """Return the extractor of a node of the grammar's `_extractor`."""
    kind = _SET_OPERATORS.get(tree.data)
    if kind:
        left, right = subtrees_of(tree)
        return kind(build_extractor(text, left), build_extractor(text, right))
    return _build_leaf(text, tree)


def _build_leaf(text: TreeReader, tree: Node) -> Leaf:
    name, *parts = (part for part in tree.children if part is not None)
    kind = EXTRACTORS[str(name)]
    rows = zip(kind.arguments().items(), parts, strict=False)
    values = {field: _build_leaf_argument(text, kind, argument, part) for (field, argument), part in rows}
    return text.locate_errors(name, lambda: make_operation(kind, values))


def _build_leaf_argument(
    text: TreeReader, kind: type[Leaf], argument: arguments.ArgumentType, part: Node | Token
) -> Any:
    match argument:
        case arguments.LabelArgument():
            assert not isinstance(part, str)
            return text.read_label(part)
        case BaseArgument():
            assert not isinstance(part, str)
            return _build_leaf(text, part)
        case arguments.DirectionArgument():
            assert isinstance(part, str)
            return _build_direction(text, part)
        case _:
            return _build_argument(text, kind, argument, part)


def build_orient(text: TreeReader, tree: Node) -> Orient:
    """Return the directive of an `orient` node; an error is about the pair that is one too many or turns back."""
    nodes = subtrees_of(tree)
    pairs = tuple(_build_pair(text, node) for node in nodes)
    wrong = nodes[min(2, len(nodes) - 1)]
    return text.locate_errors(wrong, lambda: Orient(pairs, snap=len(tokens_of(tree)) > 0))


def _build_pair(text: TreeReader, tree: Node) -> LandmarkPair:
    start, end = subtrees_of(tree)
    bases = [_build_leaf(text, node) for node in (start, end)]
    return LandmarkPair(_build_direction(text, tokens_of(tree)[0]), cast(Any, bases[0]), cast(Any, bases[1]))


def _build_direction(text: TreeReader, token: Token) -> Direction:
    try:
        check_direction(token)
    except ProgramError as error:
        like = likely_word(token[1:], ["+X", "+Y", "+Z"])
        hint = f"Did you mean {token[0]}{like[1]}? " if like else ""
        raise text.error_at(token, f"unknown direction `{token}`", f"{hint}{error.remedy}") from None
    return cast(Direction, str(token))


def collect_headers(text: TreeReader, statements: list[Node]) -> dict[str, Node]:
    """Return the header statements by their kind. Raises ProgramError for one that is given twice."""
    headers: dict[str, Node] = {}
    for node in statements:
        if node.data in headers:
            line = headers[node.data].meta.line
            raise text.error_at(node, f"{node.data} is given twice", f"It stands on line {line} already.")
        headers[node.data] = node
    return headers


def build_labels(text: TreeReader, tree: Node) -> tuple[str, ...]:
    """Return the labels that a `labels` header declares. Raises ProgramError for one that is declared twice."""
    labels: list[str] = []
    for node in subtrees_of(tree):
        label = text.read_label(node)
        if label in labels:
            raise text.error_at(node, f"the label {label!r} is declared twice", "Leave one of them out.")
        labels.append(label)
    return tuple(labels)


def build_threshold(text: TreeReader, tree: Node | None) -> float | None:
    """Return the number of a threshold header; None where the header is missing."""
    if tree is None:
        return None
    (token,) = tokens_of(tree)
    text.locate_errors(token, lambda: check_threshold(tree.data, float(token)))
    return float(token)


def build_operation(text: TreeReader, tree: Node, registry: OperationRegistry[AnOperation]) -> AnOperation:
    """Return the operation of an `action` or a `goal` node. Raises ProgramError at its name or a wrong argument."""
    (name,) = tokens_of(tree)[:1]
    parts = [part for part in tree.children[1:] if part is not None]
    kind = text.locate_errors(name, lambda: registry.get(name))
    if kind is None:
        raise _unknown_operation(text.source, start_of(name), registry)
    takes, needed = kind.arguments(), kind.min_arguments()
    if len(parts) < needed:
        raise text.error_at(name, f"{name} lacks an argument", f"Write {kind.usage()}.")
    given = {
        field: _build_argument(text, kind, argument, part)
        for part, (field, argument) in zip(parts, list(takes.items())[:needed], strict=False)
    }
    problem = text.find_error(tree, partial(make_operation, kind, dict(given)))
    for part in parts[needed:]:
        given |= [_build_option(text, kind, given, part)]
        found = text.find_error(part, partial(make_operation, kind, dict(given)))
        problem = (problem or found) if found else None
    if problem:
        raise problem
    return make_operation(kind, given)


def _build_option(
    text: TreeReader, kind: type[arguments.Operation], given: Mapping[str, Any], part: Node | Token
) -> tuple[str, Any]:
    """The field and the value of an argument that may be left out. Raises ProgramError for one that the operation does
    not take, takes once only, or takes in another form."""
    named = None if isinstance(part, str) or part.data != "option" else part
    is_named, (word, value) = named is not None, named.children if named else (_bare_token(part), part)
    takes, taken = list(kind.arguments().items())[kind.min_arguments() :], None
    for field, argument in takes:
        needs_value = isinstance(argument, arguments.OptionArgument)
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
        several = f"{kind.word()} takes one of {arguments.join_alternatives(taken.choices)} only"
        problem = several if len(taken.choices) > 1 else f"{word} is given twice"
        raise text.error_at(part, problem, "Leave one of them out.")
    raise _unknown_option(text, kind, part, [argument for _, argument in takes])


def _unknown_option(
    text: TreeReader, kind: type[arguments.Operation], part: Node | Token, takes: Sequence[arguments.ArgumentType]
) -> ProgramError:
    thing = quote_code(text.source.piece_at(start_of(part)))
    if not takes:
        return text.error_at(part, f"{kind.word()} takes no further argument, not {thing}", f"Write {kind.usage()}.")
    words = [word for argument in takes for word in argument.choices or (argument.usage,)]
    like = likely_word(thing.strip("`"), words)
    remedy = f"{f'Did you mean {like}? ' if like else ''}Write {kind.usage()}."
    return text.error_at(part, f"{kind.word()} takes {arguments.join_alternatives(words)} here, not {thing}", remedy)


def _unknown_operation(source: ProgramText, offset: int, registry: OperationRegistry[Any]) -> ProgramError:
    word, kind = source.piece_at(offset), registry.kind.removesuffix("s")
    known = f"{registry.kind.capitalize()} are {arguments.join_alternatives(registry)}."
    if word in list_operators():
        return source.error_at(offset, f"{word} selects hulls, it is no {kind}", known)
    like = likely_word(word, registry)
    return source.error_at(
        offset, f"unknown {kind} {quote_code(word)}", f"Did you mean {like}? {known}" if like else known
    )


def _build_argument(
    text: TreeReader, kind: type[arguments.Operation], argument: arguments.ArgumentType, given: Node | Token
) -> Any:
    if isinstance(argument, ActionArgument) and not isinstance(given, str):
        return build_operation(text, given, ACTIONS)
    value = _read_argument(text, argument, given)
    if value is None:
        raise _misfit_error(text, kind, argument, given)
    return value


def _read_argument(text: TreeReader, argument: arguments.ArgumentType, given: Node | Token) -> Any | None:
    value = argument.value if isinstance(argument, arguments.OptionArgument) else argument
    if isinstance(value, ExtractorArgument) and not isinstance(given, str) and given.data != "option":
        return build_extractor(text, given)
    token = _bare_token(given)
    if token is None or token.type not in _TOKEN_KINDS:
        return None
    if token.type == "QUANTITY" and not token.rstrip()[-1].isdecimal() and token.rstrip()[-1] != ".":
        return argument.read("quantity", str(token))
    kind = "number" if token.type == "QUANTITY" else _TOKEN_KINDS[token.type]
    return argument.read(kind, text.unquote(token) if token.type == "STRING" else str(token).rstrip())


def _bare_token(given: Node | Token) -> Token | None:
    """The piece of text that an argument is; None where it has arguments of its own."""
    if isinstance(given, str):
        return given
    if given.data == "option":
        return None
    return tokens_of(given)[0] if subtrees_of(given) == [] and len(tokens_of(given)) == 1 else None


def _misfit_error(
    text: TreeReader, kind: type[arguments.Operation], argument: arguments.ArgumentType, given: Node | Token
) -> ProgramError:
    thing = text.source.piece_at(start_of(given))
    remedy = f"Write {kind.usage()}."
    like = likely_word(thing.strip('"'), argument.choices)
    if like:
        remedy = f"Did you mean {like}? {remedy}"
    elif isinstance(argument, arguments.FileArgument) and "\\" in thing:
        remedy = "Write / between the folders of a path."
    return text.error_at(given, f"{kind.word()} takes {argument.wants} here, not {quote_code(thing)}", remedy)
