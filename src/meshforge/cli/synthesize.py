"""`meshforge synthesize`: learn the program of a project from its demonstrations; list and take back earlier
answers."""

from __future__ import annotations

import shlex
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from meshforge.cli.options import Json

if TYPE_CHECKING:
    from meshforge.cli.synthesize_session import LearningSession
    from meshforge.cli.synthesize_text import LearningContext
    from meshforge.project import Project
    from meshforge.store import AnswersFile, RepairLine
    from meshforge.synthesis import LearningOutcome


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
    from meshforge.cli.synthesize_dialog import Conversation
    from meshforge.cli.synthesize_script import check_all_asked, read_answers, run_script
    from meshforge.cli.synthesize_session import LearningSession
    from meshforge.cli.terminal import print_json
    from meshforge.common import UsageError
    from meshforge.language import Program
    from meshforge.project import Project
    from meshforge.synthesis import Options, outcome_to_json

    if accept_repairs and reject_repairs:
        raise UsageError("--accept-repairs and --reject-repairs exclude each other")
    opened = Project.open(project)
    if forget:
        forget_answers(opened, project, forget)
        return
    if list_answers:
        print_answers(opened, project, json)
        return
    options = Options(strategy=strategy, layers=layers, repair=not no_repair, budget=budget)
    lessons = LearningSession(opened, options, keep=not dry_run, follow=Program.read(follow) if follow else None)
    given = read_answers(answers, opened) if answers else None
    verdict = accept_repairs if accept_repairs or reject_repairs else None
    asks = is_interactive() and not (json or dry_run) and given is None and verdict is None
    outcome = Conversation(lessons, input, typer.echo).run() if asks else run_script(lessons, given, verdict)
    if json:
        print_json(outcome_to_json(outcome))
    else:
        _print_outcome(outcome, lessons, project, asks)
    check_all_asked(opened, given, outcome)
    raise typer.Exit(int(outcome.program is None))


def is_interactive() -> bool:
    """Whether a person sits at both ends."""
    return sys.stdin.isatty() and sys.stdout.isatty()


def _print_outcome(outcome: LearningOutcome, lessons: LearningSession, folder: Path, asked: bool) -> None:
    """The result to stdout, remarks to stderr, with the open question unless a person was asked it."""
    from meshforge.cli.synthesize_text import format_answer_help, format_choices, format_remarks, format_result
    from meshforge.cli.terminal import remark

    about = _context_of(lessons, folder, outcome)
    typer.echo(format_result(outcome, about))
    if outcome.followed:
        typer.echo("\n" + "\n".join(outcome.followed))
    more = format_remarks(outcome, about)
    if more:
        remark(f"\n{more}")
    if outcome.question and not asked:
        remark(f"\n{format_choices(outcome.question)}\n{format_answer_help(outcome.question, about.folder_word)}")


def _context_of(lessons: LearningSession, folder: Path, outcome: LearningOutcome) -> LearningContext:
    from meshforge.cli.synthesize_text import LearningContext

    said = lessons.project.answers()
    return LearningContext(
        folder,
        assets=len(lessons.project.assets()),
        in_use=len(lessons.ids_in_use),
        readable=len(lessons.meshes()),
        answers=len(said.answers) + len(lessons.given) - len(outcome.stale),
        repairs=len(said.confirmed),
        kept=lessons.keep,
        stopped=lessons.stopped,
    )


def print_answers(project: Project, folder: Path, json: bool) -> None:
    """List all answers and repairs by their ids."""
    from meshforge.cli.terminal import print_json, remark

    said = project.answers()
    if json:
        print_json(said.model_dump(mode="json", by_alias=True))
        return
    for line in _answer_lines(said):
        typer.echo(line)
    if said.ids:
        remark(f"To take one back: meshforge synthesize {shlex.quote(str(folder))} --forget {shlex.quote(said.ids[0])}")
    else:
        remark("nothing was answered, mended or refused yet")


def _answer_lines(said: AnswersFile) -> Iterator[str]:
    from meshforge.common import join_names, pluralize

    for line in said.answers:
        hulls = f"{pluralize(len(line.select), 'hull')}: {join_names(line.select)}" if line.select else "nothing"
        yield f"{line.id}  {'neither of the choices' if line.select is None else hulls}"
    yield from (f"{line.id}  mended, was {_describe_before(line)}" for line in said.confirmed)
    yield from (f"{line.id}  refused, stays {_describe_before(line)}" for line in said.rejected)


def _describe_before(line: RepairLine) -> str:
    return line.was or "without a label"


def forget_answers(project: Project, folder: Path, ids: Sequence[str]) -> None:
    """Take back what has one of these ids, or everything by `all`."""
    from meshforge.cli.terminal import remark
    from meshforge.common import pluralize

    if "all" in ids:
        count = len(project.answers().ids)
        notes = list(project.forget_answers())
        typer.echo(f"taken back: {pluralize(count, 'answer or repair', 'answers and repairs')}")
    else:
        notes = []
        for said in ids:
            note = project.take_back(said)
            notes += [note] if note else []
            typer.echo(f"taken back: {said}")
    for note in notes:
        remark(note)
    remark(f"Next: meshforge synthesize {shlex.quote(str(folder))}")
