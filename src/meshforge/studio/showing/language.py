"""The language as the page needs it: forms for actions, words for completion."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any, Literal

from meshforge.language import (
    ACTIONS,
    DIRECTIONS,
    OPERATORS,
    Action,
    All,
    Attach,
    Diff,
    Each,
    Geo,
    Intersect,
    Is,
    Union,
)
from meshforge.language.actions.arguments import Argument, Factor, File, Flag, PrimitiveOrFile, Words
from meshforge.studio.wire.language import ActionForm, LanguageView, Operator
from meshforge.studio.wire.language import Argument as Field

Kind = Literal["words", "flag", "file", "shape", "factor"]

_KINDS: Mapping[type[Argument], tuple[Kind, Any]] = {
    Words: ("words", None),
    Flag: ("flag", False),
    File: ("file", "part.obj"),
    PrimitiveOrFile: ("shape", "box"),
    Factor: ("factor", 1.0),
}
"""What the page calls each kind of argument, and a value of it; of words, the first is one."""

_SYNTAX = {kind.__name__: kind for kind in (All, Is, Attach, Geo, Union, Intersect, Diff)}


def language_view() -> LanguageView:
    """Actions, operators and directions; `Each` is no form of its own."""
    forms = tuple(_form(name, kind) for name, kind in ACTIONS.items() if kind is not Each)
    return LanguageView(actions=forms, operators=tuple(map(_operator, OPERATORS)), directions=DIRECTIONS)


def _form(name: str, kind: type[Action]) -> ActionForm:
    given = kind.arguments()
    required = list(given)[: kind.min_arguments()]
    example = kind(*(_example(given[one]) for one in required))
    return ActionForm(
        name=name,
        summary=kind.summary(),
        usage=kind.usage(),
        makes=example.makes_hulls,
        arguments=tuple(_field(one, argument, one in required) for one, argument in given.items()),
    )


def _field(name: str, argument: Argument, required: bool) -> Field:
    kind, _ = _KINDS[type(argument)]
    return Field(name=name, kind=kind, wants=argument.wants, choices=argument.choices, required=required)


def _example(argument: Argument) -> Any:
    return argument.choices[0] if isinstance(argument, Words) else _KINDS[type(argument)][1]


def _operator(name: str) -> Operator:
    kind = _SYNTAX[name]
    operands = ", ".join(field.name for field in fields(kind))
    summary = (kind.__doc__ or "").strip().splitlines()[0]
    return Operator(name=name, usage=f"{name}({operands})" if operands else name, summary=summary)
