"""Parse trees to nodes: what a grammar cannot check is checked here, at its place in the text."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from meshforge.errors import ProgramError
from meshforge.language.build_action import build_action
from meshforge.language.comments import attached
from meshforge.language.places import Source
from meshforge.language.program import Comments, HeaderComments, Program, Rule, check_threshold
from meshforge.language.syntax import (
    All,
    Attach,
    Base,
    Diff,
    Direction,
    Extractor,
    Geo,
    Intersect,
    Is,
    LandmarkPair,
    Orient,
    Union,
    check_direction,
)
from meshforge.language.syntax_errors import likely
from meshforge.language.trees import Text, nodes, tokens

if TYPE_CHECKING:
    from lark import Token

    from meshforge.language.trees import Node

_SETS: dict[str, type[Union] | type[Intersect] | type[Diff]] = {
    "union": Union,
    "intersect": Intersect,
    "diff": Diff,
}


def build_program(source: Source, tree: Node) -> Program:
    """The program of a `program` node."""
    statements = nodes(tree)
    text = Text(source)
    headers = _headers(text, [node for node in statements if node.data != "rule"])
    labels = _declared(text, headers["labels"]) if "labels" in headers else ()
    text = Text(source, labels)
    comments, end = attached(source.text, [node.meta.line for node in statements])
    of = dict(zip(map(id, statements), comments, strict=True))
    return Program(
        labels,
        build_orient(text, headers["orient"]) if "orient" in headers else None,
        tuple(build_rule(text, node, of[id(node)]) for node in statements if node.data == "rule"),
        _threshold(text, headers.get("contact")),
        _threshold(text, headers.get("extremity")),
        HeaderComments(**{name: of[id(node)] for name, node in headers.items()}, end=end),
    )


def build_rule(text: Text, tree: Node, comments: Comments) -> Rule:
    """The rule of a `rule` node."""
    extractor, action, *label = nodes(tree)
    parts = build_extractor(text, extractor), build_action(text, action), text.read_label(label[0]) if label else None
    return text.locate_errors(label[0] if label else tree, lambda: Rule(*parts, comments))


def build_extractor(text: Text, tree: Node) -> Extractor:
    """The extractor of a node of the grammar's `_extractor`."""
    match tree.data:
        case "attach":
            selected, anchor = nodes(tree)
            return Attach(_base(text, selected), _base(text, anchor))
        case "geo":
            return Geo(_base(text, nodes(tree)[0]), _direction(text, tokens(tree)[0]))
        case "union" | "intersect" | "diff":
            kind = _SETS[tree.data]
            left, right = nodes(tree)
            return kind(build_extractor(text, left), build_extractor(text, right))
        case _:
            return _base(text, tree)


def build_orient(text: Text, tree: Node) -> Orient:
    """The directive of an `orient` node; an error is about the pair that is one too many or turns back."""
    given = nodes(tree)
    pairs = tuple(_pair(text, node) for node in given)
    wrong = given[min(2, len(given) - 1)]
    return text.locate_errors(wrong, lambda: Orient(pairs, snap=len(tokens(tree)) > 0))


def _pair(text: Text, tree: Node) -> LandmarkPair:
    start, end = nodes(tree)
    return LandmarkPair(_direction(text, tokens(tree)[0]), _base(text, start), _base(text, end))


def _base(text: Text, tree: Node) -> Base:
    return All() if tree.data == "all" else Is(text.read_label(nodes(tree)[0]))


def _direction(text: Text, token: Token) -> Direction:
    try:
        check_direction(token)
    except ProgramError as error:
        like = likely(token[1:], ["+X", "+Y", "+Z"])
        hint = f"Did you mean {token[0]}{like[1]}? " if like else ""
        raise text.error_at(token, f"unknown direction `{token}`", f"{hint}{error.remedy}") from None
    return cast(Direction, str(token))


def _headers(text: Text, statements: list[Node]) -> dict[str, Node]:
    headers: dict[str, Node] = {}
    for node in statements:
        if node.data in headers:
            line = headers[node.data].meta.line
            raise text.error_at(node, f"{node.data} is given twice", f"It stands on line {line} already.")
        headers[node.data] = node
    return headers


def _declared(text: Text, tree: Node) -> tuple[str, ...]:
    labels: list[str] = []
    for node in nodes(tree):
        label = text.read_label(node)
        if label in labels:
            raise text.error_at(node, f"the label {label!r} is declared twice", "Leave one of them out.")
        labels.append(label)
    return tuple(labels)


def _threshold(text: Text, tree: Node | None) -> float | None:
    if tree is None:
        return None
    (token,) = tokens(tree)
    text.locate_errors(token, lambda: check_threshold(tree.data, float(token)))
    return float(token)
