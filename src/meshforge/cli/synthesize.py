"""`meshforge synthesize`: learn the program of a project from its demonstrations; list and take back earlier
answers."""

from __future__ import annotations

import shlex
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

import typer

from meshforge import language, signoff, store, synthesis
from meshforge.cli import synthesize_text
from meshforge.cli.options import Json, takes
from meshforge.cli.synthesize_session import LearningSession, check_all_asked, read_answers, run_script
from meshforge.cli.terminal import print_json, remark
from meshforge.common import UsageError, join_names, pluralize
from meshforge.project import Project, select_assets


@dataclass(frozen=True, slots=True)
class SynthesizeArguments:
    """What is typed after `meshforge synthesize`."""

    project: Annotated[Path, typer.Argument(help="A project folder.")]
    answers: Annotated[
        Path | None, typer.Option("--answers", help="A JSON file that answers questions, in place of a person.")
    ] = None
    accept_repairs: Annotated[
        bool, typer.Option("--accept-repairs", help="Repair every label that is probably wrong, without asking.")
    ] = False
    reject_repairs: Annotated[
        bool, typer.Option("--reject-repairs", help="Leave labels as they are, now and later, without asking.")
    ] = False
    list_answers: Annotated[
        bool, typer.Option("--list-answers", help="Only list what was answered, repaired and refused so far.")
    ] = False
    forget: Annotated[
        list[str] | None,
        typer.Option("--forget", help="Only take back what has this id in that list, or `all`.", metavar="ID"),
    ] = None
    strategy: Annotated[
        Literal["default", "paper"], typer.Option("--strategy", help="paper: by the algorithms of the paper.")
    ] = "default"
    layers: Annotated[
        Literal["S", "S+T", "S+G", "S+T+G"],
        typer.Option("--layers", help="What rules may ask for: labels (S), touching (T), directions (G)."),
    ] = "S+T+G"
    follow: Annotated[
        Path | None,
        typer.Option("--follow", help="A program you had in mind: say of each rule why it was learned or not."),
    ] = None
    no_repair: Annotated[bool, typer.Option("--no-repair", help="Take all labels for right.")] = False
    budget: Annotated[float, typer.Option("--budget", min=0.1, help="Seconds to search.")] = 120.0
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Show what is learned; keep nothing and ask nothing.")] = (
        False
    )
    json: Json = False


@takes(SynthesizeArguments)
def synthesize(given: SynthesizeArguments) -> None:
    """Learn the smallest program that does on every demonstrated asset what was shown there.

    In a terminal it asks where the demonstrations leave a rule open, or where a label is probably wrong; Ctrl-C ends
    the search. Exit code 1 when no program was found; then the nearest one is named, and where it differs.
    """
    if given.accept_repairs and given.reject_repairs:
        raise UsageError("--accept-repairs and --reject-repairs exclude each other")
    project = Project.open(given.project)
    if given.forget:
        _forget_answers(project, given.project, given.forget)
        return
    if given.list_answers:
        _print_answers(project, given.project, given.json)
        return
    options = synthesis.Options(
        strategy=given.strategy,
        layers=given.layers,
        repair=not given.no_repair,
        budget=given.budget,
        follow=language.Program.read(given.follow) if given.follow else None,
    )
    session = LearningSession(project.with_cache(), options, keep=not given.dry_run)
    answers = read_answers(given.answers, project) if given.answers else None
    verdict = given.accept_repairs if given.accept_repairs or given.reject_repairs else None
    asks = _is_interactive() and not (given.json or given.dry_run) and answers is None and verdict is None
    outcome = run_script(session, answers, verdict)
    if asks and not session.stopped and options == synthesis.Options():
        outcome = _converse(session.project) or outcome
    if given.json:
        print_json(synthesis.outcome_to_json(outcome))
    else:
        _print_outcome(outcome, session, given.project, asks)
    check_all_asked(project, answers, outcome)
    raise typer.Exit(int(outcome.program is None))


def _converse(project: Project) -> synthesis.LearningOutcome | None:
    """Ask what the demonstrations leave open, as a review does; the outcome after the last reply."""
    from meshforge.cli.review_session import ReviewSession  # lazy: 50 modules of rich that a script does not need

    review = ReviewSession(project, signoff.BAR)
    review.converse(kinds=(signoff.ReadingQuestion, signoff.RepairQuestion, signoff.SlipQuestion))
    return review.found.outcome


def _is_interactive() -> bool:
    return sys.stdin.isatty() and sys.stdout.isatty()


def _print_outcome(outcome: synthesis.LearningOutcome, session: LearningSession, folder: Path, asked: bool) -> None:
    """The result to stdout, remarks to stderr, with the open question unless a person was asked it."""
    about = _context_of(session, folder, outcome)
    typer.echo(synthesize_text.format_result(outcome, about))
    if outcome.followed:
        typer.echo("\n" + "\n".join(outcome.followed))
    more = synthesize_text.format_remarks(outcome, about)
    if more:
        remark(f"\n{more}")
    if outcome.question and not asked:
        remark(f"\n{synthesize_text.format_choices(outcome.question)}")
        remark(synthesize_text.format_answer_help(outcome.question, about.folder_word))


def _context_of(
    session: LearningSession, folder: Path, outcome: synthesis.LearningOutcome
) -> synthesize_text.LearningContext:
    said = session.project.feedback()
    return synthesize_text.LearningContext(
        folder,
        assets=len(session.project.assets()),
        in_use=len(select_assets(session.project)),
        readable=len(session.meshes()),
        answers=len(said.answers) + len(session.given) - len(outcome.stale),
        repairs=sum(fix.accepted for fix in said.fixes.values()),
        kept=session.keep,
        stopped=session.stopped,
    )


def _print_answers(project: Project, folder: Path, json: bool) -> None:
    said = project.feedback().answers_and_fixes
    if json:
        print_json(_to_json(said))
        return
    for name, event in said.items():
        typer.echo(f"{name}  {_describe(event)}")
    if said:
        command = f"meshforge synthesize {shlex.quote(str(folder))} --forget {shlex.quote(next(iter(said)))}"
        remark(f"To take one back: {command}")
    else:
        remark("nothing was answered, repaired or refused yet")


def _to_json(said: Mapping[str, store.AnswerEvent | store.LabelFixEvent]) -> dict[str, list[dict[str, Any]]]:
    found: dict[str, list[dict[str, Any]]] = {"answers": [], "confirmed": [], "rejected": []}
    for name, event in said.items():
        line = event.model_dump(mode="json", by_alias=True, exclude={"event", "accepted"})
        if isinstance(event, store.LabelFixEvent):
            found["confirmed" if event.accepted else "rejected"].append({"id": name, "from": None, **line})
        else:
            found["answers"].append({"id": name, "select": None, "action": None, "refused": [], **line})
    return found


def _describe(event: store.AnswerEvent | store.LabelFixEvent) -> str:
    if isinstance(event, store.LabelFixEvent):
        return f"{'repaired, was' if event.accepted else 'refused, stays'} {event.was or 'without a label'}"
    if event.select is None:
        return "neither of the choices"
    return f"{pluralize(len(event.select), 'hull')}: {join_names(event.select)}" if event.select else "nothing"


def _forget_answers(project: Project, folder: Path, ids: Sequence[str]) -> None:
    if "all" in ids:
        count = len(project.feedback().answers_and_fixes)
        notes = list(project.forget_answers())
        typer.echo(f"taken back: {pluralize(count, 'answer or repair', 'answers and repairs')}")
    else:
        notes = []
        for answer_id in ids:
            note = project.take_back(answer_id)
            notes += [note] if note else []
            typer.echo(f"taken back: {answer_id}")
    for note in notes:
        remark(note)
    remark(f"Next: meshforge synthesize {shlex.quote(str(folder))}")
