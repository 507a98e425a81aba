"""`meshforge review`: how sure each result of a project is, and questions until all are signed off."""

import shlex
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import typer

from meshforge.cli import options
from meshforge.cli.review_answers import format_question, format_reply_help, read_replies
from meshforge.cli.review_session import ReviewSession, draw_question
from meshforge.cli.terminal import print_json, remark
from meshforge.common import escape_name, join_names, pluralize
from meshforge.project import Project, ProjectReview, format_next, format_review
from meshforge.signoff import THRESHOLD
from meshforge.store import AnswerEvent, LabelFixEvent


@dataclass(frozen=True, slots=True)
class ReviewArguments:
    """What is typed after `meshforge review`."""

    project: Annotated[Path, typer.Argument(help="A project folder.")]
    min_confidence: Annotated[
        float,
        typer.Option(
            "--min-confidence", help="The probability from which on a result is signed off.", min=0.5, max=1.0
        ),
    ] = THRESHOLD
    answers: Annotated[
        Path | None, typer.Option("--answers", help="A JSON file of replies to questions that are asked, in any order.")
    ] = None
    by: Annotated[str | None, typer.Option("--by", help="Your name, kept with what you say.")] = None
    again: Annotated[bool, typer.Option("--again", help="Ask snoozed questions again.")] = False
    list_answers: Annotated[
        bool, typer.Option("--list-answers", help="Only list what was said of rules and labels so far, with ids.")
    ] = False
    forget: Annotated[
        list[str] | None,
        typer.Option("--forget", help="Take back an ID of that list, the verdict on an asset, or `all`.", metavar="ID"),
    ] = None
    json: options.Json = False


@options.takes(ReviewArguments)
def review(given: ReviewArguments) -> None:
    """Say how sure each result is, and ask what signs a family off; first what makes most results right for a second of
    your time.

    In a terminal it asks one question after the other; what is said is kept at once. Exit code 1 while some result
    needs review, or where a reply did not fit any more.
    """
    project = Project.open(given.project).with_cache()
    if given.forget:
        _forget_answers(project, given.project, given.forget)
        return
    if given.list_answers:
        _print_answers(project, given.project, given.json)
        return
    replies = read_replies(given.answers) if given.answers else ()
    if given.again:
        project.ask_again()
    session = ReviewSession(project, given.min_confidence)
    missed = session.reply_to_all(replies, given.by)
    asks = not (given.json or given.answers) and sys.stdin.isatty() and sys.stdout.isatty()
    if asks:
        session.converse(given.by)
    found = session.found
    if given.json:
        print_json(to_json(project, found))
    else:
        _print_review(project, found, shlex.quote(str(given.project)), asked=asks)
    for asset, why in session.taken_back.items():
        remark(f"{escape_name(asset)} is no longer signed off: {why}")
    raise typer.Exit(int(not found.assessment.is_done or missed > 0))


def _print_review(project: Project, found: ProjectReview, word: str, *, asked: bool) -> None:
    question = found.assessment.question
    typer.echo(format_review(found))
    if question and not asked:
        typer.echo(f"\n{format_question(question, draw_question(project, found, question))}")
        remark(f"\n{format_reply_help(question, word)}")
    if question is None and found.assessment.need_review and project.feedback().snoozed:
        remark(f"Some questions are snoozed: meshforge review {word} --again asks them.")
    if found.assessment.is_done and project.program() and not _is_written(project):
        remark(format_next("signed off", project.folder))


def _is_written(project: Project) -> bool:
    """Whether all outputs are up to date, but for those of assets that are given up."""
    return all(asset.is_done or asset.result_status.excluded for asset in project.status().assets)


def to_json(project: Project, found: ProjectReview) -> dict[str, Any]:
    """Return the JSON shape of `review`."""
    assessment, question = found.assessment, found.assessment.question
    pictures: Sequence[Path] = draw_question(project, found, question) if question else ()
    return {
        "signed_off": len(assessment.signed_off),
        "needs_review": [{"asset": name, **assessment.assets[name].to_json()} for name in assessment.need_review],
        "goals": {asset: [goal.to_json() for goal in goals] for asset, goals in assessment.failures.items()},
        "excluded": dict(sorted(assessment.excluded.items())),
        "question": {**question.to_json(), "pictures": list(map(str, pictures))} if question else None,
        "lost": dict(found.lost),
    }


def _print_answers(project: Project, folder: Path, json: bool) -> None:
    events = project.feedback().answers_and_fixes
    if json:
        print_json(_to_json(events))
        return
    for name, event in events.items():
        typer.echo(f"{name}  {_describe(event)}")
    if events:
        command = f"meshforge review {shlex.quote(str(folder))} --forget {shlex.quote(next(iter(events)))}"
        remark(f"To take one back: {command}")
    else:
        remark("nothing was answered, repaired or refused yet")


def _to_json(events: Mapping[str, AnswerEvent | LabelFixEvent]) -> dict[str, list[dict[str, Any]]]:
    found: dict[str, list[dict[str, Any]]] = {"answers": [], "confirmed": [], "rejected": []}
    for name, event in events.items():
        line = event.model_dump(mode="json", by_alias=True, exclude={"event", "accepted"})
        if isinstance(event, LabelFixEvent):
            found["confirmed" if event.accepted else "rejected"].append({"id": name, "from": None, **line})
        else:
            found["answers"].append({"id": name, "select": None, "action": None, "refused": [], **line})
    return found


def _describe(event: AnswerEvent | LabelFixEvent) -> str:
    if isinstance(event, LabelFixEvent):
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
    remark(format_next("forgot", folder))
