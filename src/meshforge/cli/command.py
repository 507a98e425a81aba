"""One command of the command line, which knows other spellings of its options: each is an error that names the one."""

from __future__ import annotations

from typing import Any

from typer import BadParameter
from typer.core import TyperCommand

from meshforge.cli.parameters import read_plainly
from meshforge.common import UsageError

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


class Command(TyperCommand):
    """Raises UsageError for another spelling of an option that the command has."""

    def get_params(self, ctx: Any) -> list[Any]:  # ctx: Typer hides its type
        return read_plainly(super().get_params(ctx))

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:  # ctx: Typer hides its type
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
