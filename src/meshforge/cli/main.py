"""The `meshforge` command: its list of commands, and how errors reach a person; misspelt options name the right one."""

import gc
import io
import os
import signal
import sys
from collections.abc import Callable
from contextlib import suppress
from importlib import import_module
from typing import Any, cast

import typer
from typer import BadParameter
from typer.core import TyperCommand, TyperGroup

import meshforge
from meshforge.cli.terminal import escape_output

COMMANDS = {
    "demo": "Run the whole loop on the bundled tables",
    "samples": "Write a family of assets to try things on, with labels beside them",
    "new": "Make a project folder",
    "prepare": "Decompose non-convex pieces, and what bodies without collision geometry show, into convex hulls",
    "cut": "Cut a hull in two along a plane",
    "status": "Show what is labelled, demonstrated, learned, applied, stale and flagged, and the next sensible step",
    "label": "Give labels to hulls",
    "demonstrate": "Record the steps of a demonstration",
    "studio": "See, label, demonstrate, learn and review in the browser",
    "synthesize": "Learn the smallest program that does on every demonstrated asset what was shown there",
    "review": "Say how sure each result is, and ask what signs a family off",
    "apply": "Run a program on assets",
    "goal": "Try what assets must do, such as to stand or to be gripped, before and after the program",
    "check": "Check that every hull is convex, closed and solid, and keeps to the limits of an engine",
    "explain": "Explain a finding by its code or rule, with why it matters, what to do and an example",
    "info": "Show hulls, labels, bodies, contacts and near misses of an asset, in the frame it comes in",
    "select": "List the hulls that an extractor selects, in the frame the asset comes in",
    "render": "Draw an asset as a PNG or JPEG, one colour a hull or a label",
    "diff": "Compare two assets hull by hull",
    "decompose": "Decompose a mesh into convex hulls by CoACD or V-HACD",
    "convert": "Write an asset in another format, or unchanged in its own",
    "plugins": "List the plug-ins that are installed",
    "fmt": "Print a program in its canonical form, comments kept",
}
"""Every command with the line that the list of commands shows: the function of its name in the module of its name."""
_INTERRUPTED = 130  # the exit code where a person pressed Ctrl-C
_TERMINATED = 143  # where the system asked for the end
_MANY_OBJECTS = 50_000  # new ones before cycles are looked for: imports make most, which stay
_HELP_OPTIONS = {"help_option_names": ["-h", "--help"]}


class CommandGroup(TyperGroup):
    """Imports the module of a command when that command runs; `meshforge --help` imports none of them."""

    def __init__(self, **attributes: Any) -> None:
        super().__init__(**attributes)
        self.commands = dict.fromkeys(COMMANDS)  # type: ignore[assignment]  # only their names count, for suggestions

    def list_commands(self, ctx: typer.Context) -> list[str]:  # type: ignore[override]  # Typer hides its types
        return list(COMMANDS)

    def get_command(self, ctx: typer.Context, cmd_name: str) -> TyperCommand | None:  # type: ignore[override]  # Typer hides its types
        return load_command(cmd_name) if cmd_name in COMMANDS else None

    def format_commands(self, ctx: typer.Context, formatter: Any) -> None:  # type: ignore[override]  # Typer hides its types
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))


def load_command(name: str) -> TyperCommand:
    """Return the command of a name, from its module."""
    app = typer.Typer(add_completion=False, pretty_exceptions_enable=False, rich_markup_mode=None)
    function: Callable[..., None] = getattr(import_module(f"meshforge.cli.{name}"), name)
    app.command(name, cls=Command, context_settings=_HELP_OPTIONS)(function)
    return cast(TyperCommand, typer.main.get_command(app))


def build_application() -> typer.Typer:
    """Return the command-line application with all commands."""
    app = typer.Typer(
        name="meshforge",
        cls=CommandGroup,
        help="Teach one collision mesh, fix the whole family.",
        epilog="Start with: meshforge demo",
        no_args_is_help=True,
        pretty_exceptions_enable=False,
        rich_markup_mode=None,  # rich's help page alone costs a tenth of a second
        context_settings=_HELP_OPTIONS,
    )
    app.callback()(_read_root_options)
    return app


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"meshforge {meshforge.__version__}")
        raise typer.Exit


def _read_root_options(
    version: bool = typer.Option(
        False, "--version", help="Print the version and leave.", is_eager=True, callback=_print_version
    ),
    debug: bool = typer.Option(False, "--debug", help="Show tracebacks (may stand after the command, too)."),
) -> None: ...


def main() -> None:
    """Run the command that the words name; every error becomes one message and an exit code."""
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # with one thread, workers start by a fork
    os.environ["MESHFORGE_WORKERS"] = "1"  # a command is guarded: work on many assets takes all processors
    gc.set_threshold(_MANY_OBJECTS)
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "1")  # else it looks for them in every installed package
    debug = "--debug" in sys.argv[1:]
    sys.argv[1:] = [word for word in sys.argv[1:] if word != "--debug"]
    for stream in (sys.stdout, sys.stderr):  # names of files need not be text that a terminal can show
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    with suppress(ValueError):  # in another thread than the main one
        signal.signal(signal.SIGTERM, lambda *_: sys.exit(_TERMINATED))  # so that worker pools are closed
    with escape_output():
        _run(debug)


def _run(debug: bool) -> None:
    try:
        build_application()(prog_name="meshforge")
    except KeyboardInterrupt:
        print("stopped", file=sys.stderr)
        sys.exit(_INTERRUPTED)
    except SystemExit as left:
        if left.code in (_INTERRUPTED, _TERMINATED):  # typer says nothing of it
            print("stopped", file=sys.stderr)
        raise
    except BrokenPipeError:  # the reader of our output has gone; nothing is left to say
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(0)
    except Exception as error:  # no traceback reaches a user who did not ask for it
        if debug:
            raise
        from meshforge.common import MeshForgeError, describe_error  # lazy: only an error needs it

        print(f"error: {describe_error(error, fault='--debug shows where it came from')}", file=sys.stderr)
        sys.exit(error.exit_code if isinstance(error, MeshForgeError) else 2)


OTHER_SPELLINGS = dict.fromkeys(("--fresh", "--redo", "--rerun", "--force"), "--again") | {"--sure": "--min-confidence"}
OTHER_SPELLINGS |= dict.fromkeys(("--method", "--engine", "--decomposer"), "--decompose")
"""What options are called here, by what they are called elsewhere."""


class Command(TyperCommand):
    """Raises UsageError for another spelling of an option that the command has."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:  # ctx: Typer hides its type
        from meshforge.common import UsageError  # lazy: the list of commands needs none

        known = {spelling for parameter in self.params for spelling in parameter.opts}
        typed = {word.partition("=")[0] for word in (args[: args.index("--")] if "--" in args else args)}
        for other in typed - known:
            if (name := OTHER_SPELLINGS.get(other)) in known:
                remedy = f"All options: meshforge {self.name} --help"
                raise UsageError(f"meshforge {self.name} has no {other}: it is {name}", remedy=remedy)
        try:
            return super().parse_args(ctx, args)
        except BadParameter as error:
            error.message = error.message.removeprefix("Value error, ")  # a word of pydantic's, by which Typer reads
            raise
