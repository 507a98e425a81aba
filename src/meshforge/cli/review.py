"""`meshforge review`: how sure each result of a project is, and questions until all are signed off."""

from __future__ import annotations

import json as jsonlib
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any

import typer

from meshforge.cli import options
from meshforge.cli.console import show_status
from meshforge.cli.review_pictures import draw_question
from meshforge.cli.review_text import format_question, format_review
from meshforge.cli.terminal import print_json, remark
from meshforge.common import MeshForgeError, UsageError
from meshforge.project import Project, ProjectReview
from meshforge.signoff import BAR, HullPlace, ReviewQuestion, ReviewReply

_ANSWER = 'a list of {"id", "choice": a number from 0 or null, "exceptions": {"ASSET#HULL": LABEL}, "later": true}'


@dataclass(frozen=True, slots=True)
class ReviewArguments:
    """What is typed after `meshforge review`."""

    project: Annotated[Path, typer.Argument(help="A project folder.")]
    sure: Annotated[
        float, typer.Option("--sure", help="The probability from which on a result is signed off.", min=0.5, max=1.0)
    ] = BAR
    answers: Annotated[
        Path | None, typer.Option("--answers", help="A JSON file of replies, each given when its question is asked.")
    ] = None
    json: options.Json = False


@options.takes(ReviewArguments)
def review(given: ReviewArguments) -> None:
    """Sign a family off: say how sure each result is, and ask what makes most results right for a second of your time.

    Exit code 1 while some result is held, or where a reply did not fit any more.
    """
    project = Project.open(given.project)
    replies = _read_replies(given.answers) if given.answers else []
    with show_status("looking at the family"):
        found = project.review(given.sure)
    waiting = {reply.question: reply for reply in replies}
    while (question := found.assessment.question) and question.id in waiting:
        found = _reply(project, found, question, waiting.pop(question.id), given.sure)
    for name in waiting:
        remark(f"{name}: this question is not asked any more, so the reply is skipped")
    if not given.json and given.answers is None and sys.stdin.isatty():
        found = _converse(project, found, given.sure)
    if given.json:
        print_json(to_json(project, found))
        _report_losses(found)
    else:
        question = found.assessment.question
        typer.echo(format_review(found, project.folder))
        _report_losses(found)
        if question and not sys.stdin.isatty():
            typer.echo(f"\n{format_question(question, draw_question(project, found, question))}")
    raise typer.Exit(int(bool(found.assessment.held) or bool(waiting)))


def _report_losses(found: ProjectReview) -> None:
    """Name what was signed off before, and is not any more."""
    for asset, why in found.taken_back.items():
        remark(f"{asset} is no longer signed off: {why}")


def _reply(
    project: Project, found: ProjectReview, question: ReviewQuestion, reply: ReviewReply, bar: float
) -> ProjectReview:
    project.reply(found, question, reply)
    with show_status("looking at the family"):
        after = project.review(bar)
    return replace(after, taken_back={**found.taken_back, **after.taken_back})


def _converse(project: Project, found: ProjectReview, bar: float) -> ProjectReview:
    """Ask at the terminal until nothing is left, or the person has enough; what was said is kept at once."""
    while question := found.assessment.question:
        typer.echo(format_review(found, project.folder, held=3))
        typer.echo(f"\n{format_question(question, draw_question(project, found, question))}")
        reply = _ask(question)
        if reply is None:
            break
        try:
            found = _reply(project, found, question, reply, bar)
        except MeshForgeError as error:
            typer.echo(error.message, err=True)
            found = _reply(project, found, question, ReviewReply(question.id, later=True), bar)
    return found


def _ask(question: ReviewQuestion) -> ReviewReply | None:
    """What is typed: a number, n for none of these, l for later; None where the person stops."""
    count = len(question.choices)
    while True:
        try:
            word = input(f"{', '.join(map(str, range(1, count + 1)))}{', n for none' * (count > 0)}, l later, q stop: ")
        except (EOFError, KeyboardInterrupt):
            return None
        match word.strip().lower():
            case "q":
                return None
            case "l":
                return ReviewReply(question.id, later=True)
            case "n" if count:
                return ReviewReply(question.id, None)
            case number if number.isdigit() and 1 <= int(number) <= count:
                return ReviewReply(question.id, int(number) - 1)


def _read_replies(path: Path) -> list[ReviewReply]:
    """Replies from a file. Raises UsageError where it is not what it should be."""
    try:
        rows = jsonlib.loads(path.read_text("utf-8"))
        return [_to_reply(row) for row in rows]
    except (OSError, UnicodeDecodeError) as error:
        raise UsageError("the replies cannot be read", where=str(path)) from error
    except (ValueError, TypeError, KeyError, AttributeError) as error:
        raise UsageError("these are no replies", where=str(path), remedy=f"Expected {_ANSWER}.") from error


def _to_reply(row: dict[str, Any]) -> ReviewReply:
    exceptions = {}
    for place, label in row.get("exceptions", {}).items():
        asset, mark, hull = str(place).rpartition("#")
        if not mark:
            raise ValueError(place)
        exceptions[HullPlace(asset, hull)] = str(label)
    choice = row.get("choice")
    if choice is not None and (not isinstance(choice, int) or isinstance(choice, bool)):
        raise ValueError(choice)
    return ReviewReply(str(row["id"]), choice, exceptions, later=bool(row.get("later", False)))


def to_json(project: Project, found: ProjectReview) -> dict[str, Any]:
    """The JSON shape of `review`."""
    assessment, question = found.assessment, found.assessment.question
    pictures: Sequence[Path] = draw_question(project, found, question) if question else ()
    return {
        "signed_off": len(assessment.signed_off),
        "held": [{"asset": name, **assessment.assets[name].to_json()} for name in assessment.held],
        "set_aside": sorted(assessment.aside),
        "question": {**question.to_json(), "pictures": list(map(str, pictures))} if question else None,
        "lost": dict(found.lost),
    }
