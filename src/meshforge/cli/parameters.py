"""How what is typed becomes values: without pydantic, by which Typer reads, where Python alone can."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Literal, get_args, get_origin

from typer._coercion import RuntimeParam, build_runtime_param

_PATH_RULES = ("exists", "writable", "resolve_path", "allow_dash", "path_type")
"""What Typer can be asked to check of a path."""


class PlainParameter(RuntimeParam):
    """A parameter whose texts, paths and defaults are taken as they are; all else is read by Typer.

    Typer asks pydantic even for an option that nobody typed, and that takes 0.08 s to load.
    """

    def _coerce_value(self, value: Any, param: Any, ctx: Any) -> Any:
        kind: Any = self.annotation
        if self.parameter_info.parser is None:
            if (kind is str and isinstance(value, str)) or (kind in (bool, int, float) and type(value) is kind):
                return value
            if kind == list[str] and isinstance(value, list | tuple):
                return [*map(str, value)]
            if get_origin(kind) is Literal and value in get_args(kind):
                return value
            if kind is Path and not any(getattr(self.parameter_info, rule) for rule in _PATH_RULES):
                return Path(value)
        return build_runtime_param(param.type_descriptor).coerce(value, param=param, ctx=ctx)


def read_plainly(parameters: list[Any]) -> list[Any]:
    """Let parameters of Typer's be read as `PlainParameter`."""
    for parameter in parameters:
        if kind := getattr(parameter, "type_descriptor", None):
            parameter._runtime_param = PlainParameter(kind.parameter_info, kind.annotation)
    return parameters
