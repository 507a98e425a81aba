"""How what is typed becomes values: without pydantic, by which Typer reads, where Python alone can."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Literal, get_args, get_origin

_PATH_RULES = ("exists", "writable", "resolve_path", "allow_dash", "path_type")
"""What Typer can be asked to check of a path."""


def read_plainly(parameters: list[Any]) -> list[Any]:
    """Let texts, paths and defaults of Typer's parameters be taken as they are; all else is read by Typer.

    Typer asks pydantic even for an option that nobody typed, and that takes 0.08 s to load. A version of Typer that
    works otherwise inside reads all of it, as it does by itself.
    """
    try:
        from typer._coercion import RuntimeParam, build_runtime_param  # lazy: private, so it may not be there
    except ImportError:
        return parameters

    class PlainParameter(RuntimeParam):
        def _coerce_value(self, value: Any, param: Any, ctx: Any) -> Any:
            plain, found = _take_plainly(self.annotation, self.parameter_info, value)
            return found if plain else build_runtime_param(param.type_descriptor).coerce(value, param=param, ctx=ctx)

    for parameter in parameters:
        if kind := getattr(parameter, "type_descriptor", None):
            parameter._runtime_param = PlainParameter(kind.parameter_info, kind.annotation)
    return parameters


def _take_plainly(kind: Any, about: Any, value: Any) -> tuple[bool, Any]:
    """Whether Python alone can make the value of a kind, and that value."""
    if about.parser is not None:
        return False, None
    if (kind is str and isinstance(value, str)) or (kind in (bool, int, float) and type(value) is kind):
        return True, value
    if kind == list[str] and isinstance(value, list | tuple):
        return True, [*map(str, value)]
    if get_origin(kind) is Literal and value in get_args(kind):
        return True, value
    if kind is Path and not any(getattr(about, rule) for rule in _PATH_RULES):
        return True, Path(value)
    return False, None
