"""One command of the command line: other spellings of its options are errors that name the one, and what is typed
becomes values without pydantic, by which Typer reads, where Python alone can."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Literal, get_args, get_origin

from typer import BadParameter
from typer.core import TyperCommand

OTHER_SPELLINGS = {
    "--again": ("--fresh", "--redo", "--rerun", "--force"),
    "--min-confidence": ("--sure",),
    "--decompose": ("--method", "--engine", "--decomposer"),
}
"""What options were called once, or are called elsewhere, by what they are called here."""
_MOVED = {
    "synthesize": {
        "--answers": "--answers FILE",
        "--accept-repairs": "--answers FILE",
        "--reject-repairs": "--answers FILE",
        "--list-answers": "--list-answers",
        "--forget": "--forget ID",
    }
}
"""What a command did once and `review` does now, by its option."""


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


class Command(TyperCommand):
    """Raises UsageError for another spelling of an option that the command has."""

    def get_params(self, ctx: Any) -> list[Any]:  # ctx: Typer hides its type
        return read_plainly(super().get_params(ctx))

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:  # ctx: Typer hides its type
        from meshforge.common import UsageError  # lazy: the list of commands needs none

        known = {spelling for parameter in self.params for spelling in parameter.opts}
        typed = {word.partition("=")[0] for word in (args[: args.index("--")] if "--" in args else args)}
        for name in known & OTHER_SPELLINGS.keys():
            for other in OTHER_SPELLINGS[name]:
                if other in typed - known:
                    remedy = f"All options: meshforge {self.name} --help"
                    raise UsageError(f"meshforge {self.name} has no {other}: it is {name}", remedy=remedy)
        for other, now in _MOVED.get(str(self.name), {}).items():
            if other in typed:
                remedy = f"Use: meshforge review PROJECT {now}"
                raise UsageError(f"meshforge {self.name} only learns, and has no {other}", remedy=remedy)
        try:
            return super().parse_args(ctx, args)
        except BadParameter as error:
            error.message = error.message.removeprefix("Value error, ")  # a word of pydantic's, by which Typer reads
            raise
