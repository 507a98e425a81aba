"""The `meshforge` command: its list of commands, and how errors reach a person."""

from __future__ import annotations

import io
import os
import re
import sys
from collections.abc import Callable
from importlib import import_module

import typer

COMMANDS = (
    "demo",
    "new",
    "prepare",
    "split",
    "status",
    "label",
    "demonstrate",
    "studio",
    "synthesize",
    "apply",
    "check",
    "info",
    "select",
    "render",
    "diff",
    "decompose",
    "convert",
    "fmt",
)
"""Every command is the function of its name in the module of its name, listed in this order."""


def application() -> typer.Typer:
    """The command-line application with all commands."""
    app = typer.Typer(
        name="meshforge",
        help="Teach one collision mesh, mend the whole family.",
        epilog="Start with: meshforge demo",
        no_args_is_help=True,
        pretty_exceptions_enable=False,
        rich_markup_mode=None,  # rich's help page alone costs a tenth of a second
        context_settings={"help_option_names": ["-h", "--help"]},
    )
    for name in COMMANDS:
        command: Callable[..., None] = getattr(import_module(f"meshforge.cli.{name}"), name)
        app.command(name, short_help=_clause(command.__doc__ or ""))(command)
    app.callback()(_version_option)
    return app


def _clause(doc: str) -> str:
    """The first clause of a docstring, which fits one line of the list of commands."""
    return re.split(r"[;:.]", doc.strip(), maxsplit=1)[0]


def _version_option(
    version: bool = typer.Option(False, "--version", help="Print the version and leave.", is_eager=True),
    debug: bool = typer.Option(False, "--debug", help="Show tracebacks (may stand after the command, too)."),
) -> None:
    if version:
        from importlib.metadata import version as installed

        typer.echo(f"meshforge {installed('meshforge')}")
        raise typer.Exit


def main() -> None:
    """Run the command that the words name; every error becomes one message and an exit code."""
    debug = "--debug" in sys.argv[1:]
    sys.argv[1:] = [word for word in sys.argv[1:] if word != "--debug"]
    for stream in (sys.stdout, sys.stderr):  # names of files need not be text that a terminal can show
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    try:
        application()(prog_name="meshforge")
    except KeyboardInterrupt:
        print("stopped", file=sys.stderr)
        sys.exit(130)
    except BrokenPipeError:  # the reader of our output has gone; nothing is left to say
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(0)
    except Exception as error:  # no traceback reaches a user who did not ask for it
        if debug:
            raise
        from meshforge.errors import told

        print(f"error: {told(error, fault='--debug shows where it came from')}", file=sys.stderr)
        sys.exit(2)
