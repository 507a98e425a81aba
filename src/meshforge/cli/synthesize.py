"""`meshforge synthesize`: learn the program of a project from its demonstrations, asking where they leave it open."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from meshforge.cli.options import Json

if TYPE_CHECKING:
    from meshforge.cli.lessons import Lessons
    from meshforge.cli.outcome_text import About
    from meshforge.synthesis import Outcome


def synthesize(
    project: Annotated[Path, typer.Argument(help="A project folder.")],
    answers: Annotated[
        Path | None, typer.Option("--answers", help="A JSON file that answers questions, in place of a person.")
    ] = None,
    accept_repairs: Annotated[
        bool, typer.Option("--accept-repairs", help="Mend every label that is probably wrong, without asking.")
    ] = False,
    reject_repairs: Annotated[
        bool, typer.Option("--reject-repairs", help="Leave labels as they are, now and later, without asking.")
    ] = False,
    list_answers: Annotated[
        bool, typer.Option("--list-answers", help="Only list what was answered, mended and refused so far.")
    ] = False,
    forget: Annotated[
        list[str] | None,
        typer.Option("--forget", help="Only take back what has this id in that list, or `all`.", metavar="ID"),
    ] = None,
    strategy: Annotated[
        Literal["default", "paper"], typer.Option("--strategy", help="paper: by the algorithms of the paper.")
    ] = "default",
    layers: Annotated[
        Literal["S", "S+T", "S+G", "S+T+G"],
        typer.Option("--layers", help="What rules may ask for: labels (S), touching (T), directions (G)."),
    ] = "S+T+G",
    follow: Annotated[
        Path | None,
        typer.Option("--follow", help="A program you had in mind: say of each rule why it was learned or not."),
    ] = None,
    no_repair: Annotated[bool, typer.Option("--no-repair", help="Take all labels for right.")] = False,
    budget: Annotated[float, typer.Option("--budget", min=0.1, help="Seconds to search.")] = 120.0,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Show what is learned; keep nothing and ask nothing.")
    ] = False,
    json: Json = False,
) -> None:
    """Learn the smallest program that does on every demonstrated asset what was shown there.

    In a terminal it asks where the demonstrations leave a rule open, or where a label is probably wrong; Ctrl-C ends
    the search. Exit code 1 when no program was found; then the nearest one is named, and where it differs.
    """
    from meshforge.cli import said
    from meshforge.cli.conversation import Conversation
    from meshforge.cli.given_answers import read_given
    from meshforge.cli.lessons import Lessons
    from meshforge.cli.output import print_json
    from meshforge.cli.scripted import check_all_asked, scripted
    from meshforge.errors import UsageError
    from meshforge.language import Program
    from meshforge.project import Project
    from meshforge.synthesis import Options, outcome_json

    if accept_repairs and reject_repairs:
        raise UsageError("--accept-repairs and --reject-repairs exclude each other")
    opened = Project.open(project)
    if forget:
        said.forget(opened, project, forget)
        return
    if list_answers:
        said.list_answers(opened, project, json)
        return
    options = Options(strategy=strategy, layers=layers, repair=not no_repair, budget=budget)
    lessons = Lessons(opened, options, keep=not dry_run, follow=Program.read(follow) if follow else None)
    given = read_given(answers, opened) if answers else None
    verdict = accept_repairs if accept_repairs or reject_repairs else None
    asks = is_interactive() and not (json or dry_run) and given is None and verdict is None
    outcome = Conversation(lessons, input, typer.echo).run() if asks else scripted(lessons, given, verdict)
    if json:
        print_json(outcome_json(outcome))
    else:
        _print(outcome, lessons, project, asks)
    check_all_asked(opened, given, outcome)
    raise typer.Exit(int(outcome.program is None))


def is_interactive() -> bool:
    """Whether a person sits at both ends."""
    return sys.stdin.isatty() and sys.stdout.isatty()


def _print(outcome: Outcome, lessons: Lessons, folder: Path, asked: bool) -> None:
    """The result to stdout, remarks to stderr, with the open question unless a person was asked it."""
    from meshforge.cli.cards import answer_help, choices_card
    from meshforge.cli.outcome_text import remarks, result
    from meshforge.cli.output import remark

    about = _about(lessons, folder, outcome)
    typer.echo(result(outcome, about))
    if outcome.followed:
        typer.echo("\n" + "\n".join(outcome.followed))
    more = remarks(outcome, about)
    if more:
        remark(f"\n{more}")
    if outcome.question and not asked:
        remark(f"\n{choices_card(outcome.question)}\n{answer_help(outcome.question, about.folder_word)}")


def _about(lessons: Lessons, folder: Path, outcome: Outcome) -> About:
    from meshforge.cli.outcome_text import About

    said = lessons.project.answers()
    return About(
        folder,
        assets=len(lessons.project.assets()),
        in_use=len(lessons.ids_in_use),
        readable=len(lessons.meshes()),
        answers=len(said.answers) + len(lessons.given) - len(outcome.stale),
        repairs=len(said.confirmed),
        kept=lessons.keep,
        stopped=lessons.stopped,
    )
