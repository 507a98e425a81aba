"""`meshforge review`: how sure each result of a project is, and questions until all are signed off."""

from __future__ import annotations

import shlex
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any

import typer

from meshforge.cli import options
from meshforge.cli.review_answers import read_replies
from meshforge.cli.review_pictures import draw_question
from meshforge.cli.review_session import ReviewSession
from meshforge.cli.review_text import format_question, format_reply_help
from meshforge.cli.terminal import print_json, remark
from meshforge.common import escape_name
from meshforge.project import Project, ProjectReview, format_review
from meshforge.signoff import BAR


@dataclass(frozen=True, slots=True)
class ReviewArguments:
    """What is typed after `meshforge review`."""

    project: Annotated[Path, typer.Argument(help="A project folder.")]
    min_confidence: Annotated[
        float,
        typer.Option(
            "--min-confidence", help="The probability from which on a result is signed off.", min=0.5, max=1.0
        ),
    ] = BAR
    answers: Annotated[
        Path | None, typer.Option("--answers", help="A JSON file of replies to questions that are asked, in any order.")
    ] = None
    by: Annotated[str | None, typer.Option("--by", help="Your name, kept with what you say.")] = None
    again: Annotated[bool, typer.Option("--again", help="Ask again what was put off.")] = False
    json: options.Json = False


@options.takes(ReviewArguments)
def review(given: ReviewArguments) -> None:
    """Say how sure each result is, and ask what signs a family off; first what makes most results right for a second of
    your time.

    In a terminal it asks one question after the other; what is said is kept at once. Exit code 1 while some result
    needs review, or where a reply did not fit any more.
    """
    project = Project.open(given.project).with_cache()
    replies = [replace(reply, by=given.by) for reply in read_replies(given.answers)] if given.answers else []
    if given.again:
        project.ask_again()
    session = ReviewSession(project, given.min_confidence)
    missed = session.reply_to_all(replies)
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
    raise typer.Exit(int(bool(found.assessment.held or missed)))


def _print_review(project: Project, found: ProjectReview, word: str, *, asked: bool) -> None:
    question = found.assessment.question
    typer.echo(format_review(found))
    if question and not asked:
        typer.echo(f"\n{format_question(question, draw_question(project, found, question))}")
        remark(f"\n{format_reply_help(question, word)}")
    if question is None and found.assessment.held and project.feedback().snoozed:
        remark(f"Some questions were put off: meshforge review {word} --again asks them.")
    if found.assessment.is_done and project.program() and not _is_written(project):
        remark(f"Next: meshforge apply {word}")


def _is_written(project: Project) -> bool:
    """Whether all outputs are up to date, but for those of assets that are given up."""
    return all(asset.is_done or asset.excluded for asset in project.status().assets)


def to_json(project: Project, found: ProjectReview) -> dict[str, Any]:
    """The JSON shape of `review`."""
    assessment, question = found.assessment, found.assessment.question
    pictures: Sequence[Path] = draw_question(project, found, question) if question else ()
    return {
        "signed_off": len(assessment.signed_off),
        "held": [{"asset": name, **assessment.assets[name].to_json()} for name in assessment.held],
        "excluded": dict(sorted(assessment.excluded.items())),
        "question": {**question.to_json(), "pictures": list(map(str, pictures))} if question else None,
        "lost": dict(found.lost),
    }
