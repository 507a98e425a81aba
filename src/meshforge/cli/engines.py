"""Decomposition engines and their options, as several commands take them."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import fields
from enum import StrEnum
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from meshforge.geometry.decompose import DecomposeSettings


class Method(StrEnum):
    """The decomposition engines."""

    COACD = "coacd"
    VHACD = "vhacd"


Set = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="NAME=VALUE", help="An option of the engine, such as threshold=0.1; repeatable."),
]
Hollow = Annotated[
    bool,
    typer.Option("--hollow", help="Leave planar holes open, so that shells of one sheet are not filled."),
]
Seconds = Annotated[float | None, typer.Option("--timeout", min=0.1, help="Seconds to try.")]


def engine_settings(method: Method, given: list[str] | None) -> DecomposeSettings:
    """The settings of an engine with some given as `NAME=VALUE`. Raises UsageError, listing what there is to set."""
    from meshforge.errors import UsageError
    from meshforge.geometry.decompose import CoacdSettings, VhacdSettings

    kind = CoacdSettings if method is Method.COACD else VhacdSettings
    known = {f.name: f for f in fields(kind)}
    values: dict[str, Any] = {}
    for text in given or []:
        name, _, value = text.partition("=")
        if name not in known:
            listed = "\n".join(f"    {f.name}={f.default}  {f.metadata['help']}" for f in known.values())
            raise UsageError(f"--set {text}: {method.value} has no option {name!r}", remedy=f"Its options:\n{listed}")
        values[name] = _value(text, value, type(known[name].default))
    return kind(**values)


def refuse_given(context: typer.Context, names: Collection[str], without: str) -> None:
    """Raise UsageError for a parameter among some that was typed, though it says nothing `without` another option."""
    from meshforge.errors import UsageError

    for parameter in context.command.params:
        source = context.get_parameter_source(parameter.name or "")
        if parameter.name in names and source is not None and source.name == "COMMANDLINE":
            option = parameter.opts[0]
            raise UsageError(f"{option} says nothing without {without}", remedy=f"Give {without} too, or leave it out.")


def _value(text: str, value: str, kind: type) -> Any:
    from meshforge.errors import UsageError

    words = {"true": True, "yes": True, "on": True, "false": False, "no": False, "off": False}
    try:
        return words[value.lower()] if kind is bool else kind(value)
    except (KeyError, ValueError):
        raise UsageError(f"--set {text}: {value!r} is not {'yes or no' if kind is bool else 'a number'}") from None
