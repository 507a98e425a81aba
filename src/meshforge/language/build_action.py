"""Parse trees to actions, as the classes of the actions say."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from meshforge.errors import ProgramError
from meshforge.language.actions import ACTIONS, Action, Argument
from meshforge.language.actions.arguments import File, Inner, RawKind, one_of
from meshforge.language.syntax import OPERATORS
from meshforge.language.syntax_errors import likely, shown
from meshforge.language.trees import Text, nodes, start_of, tokens

if TYPE_CHECKING:
    from lark import Token

    from meshforge.language.trees import Node

_KINDS: dict[str, RawKind] = {"NAME": "word", "STRING": "text", "NUMBER": "number", "DIRECTION": "direction"}


def build_action(text: Text, tree: Node) -> Action:
    """The action of an `action` node. Raises ProgramError at its name or at the argument that does not fit."""
    (name,) = tokens(tree)[:1]
    given = [part for part in tree.children[1:] if part is not None]
    kind = ACTIONS.get(name)
    if kind is None:
        raise _unknown(text, name)
    takes = list(kind.arguments().values())
    if len(given) > len(takes):
        raise text.error_at(given[len(takes)], f"{name} takes no further argument", f"Write {kind.usage()}.")
    if len(given) < kind.min_arguments():
        raise text.error_at(name, f"{name} lacks an argument", f"Write {kind.usage()}.")
    values = [_argument(text, kind, argument, part) for argument, part in zip(takes, given, strict=False)]
    return text.locate_errors(tree, lambda: kind(*values))


def _unknown(text: Text, name: Token) -> ProgramError:
    known = f"Actions are {one_of(ACTIONS)}."
    if name in OPERATORS:
        return text.error_at(name, f"{name} selects hulls, it is no action", known)
    like = likely(name, ACTIONS)
    return text.error_at(name, f"unknown action {shown(name)}", f"Did you mean {like}? {known}" if like else known)


def _argument(text: Text, kind: type[Action], argument: Argument, given: Node | Token) -> Any:
    """The value of an argument, read as its kind says."""
    from lark import Tree

    if isinstance(argument, Inner) and isinstance(given, Tree):
        return build_action(text, given)
    token = _bare(given)
    if token is not None:
        content = text.unquote(token) if token.type == "STRING" else str(token)
        value = argument.read(_KINDS[token.type], content)
        if value is not None:
            return value
    raise _misfit(text, kind, argument, given)


def _bare(given: Node | Token) -> Token | None:
    """The piece of text that an argument is; None where it has arguments of its own."""
    from lark import Token

    if isinstance(given, Token):
        return given
    return tokens(given)[0] if nodes(given) == [] and len(tokens(given)) == 1 else None


def _misfit(text: Text, kind: type[Action], argument: Argument, given: Node | Token) -> ProgramError:
    thing = text.source.piece_at(start_of(given))
    remedy = f"Write {kind.usage()}."
    like = likely(thing.strip('"'), argument.choices)
    if like:
        remedy = f"Did you mean {like}? {remedy}"
    elif isinstance(argument, File) and "\\" in thing:
        remedy = "Write / between the folders of a path."
    return text.error_at(given, f"{kind.__name__} takes {argument.wants} here, not {shown(thing)}", remedy)
