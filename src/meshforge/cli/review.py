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
from meshforge.cli.console import show_status
from meshforge.cli.review_answers import find_contradictions, parse_reply, read_replies
from meshforge.cli.review_pictures import draw_question
from meshforge.cli.review_text import format_prompt, format_question, format_reply_help
from meshforge.cli.terminal import print_json, remark
from meshforge.common import MeshForgeError, UsageError
from meshforge.project import Project, ProjectReview, format_review
from meshforge.signoff import BAR, ReviewQuestion, ReviewReply
from meshforge.signoff.question import CORRECT, WRONG

_FEW_HELD = 3  # held assets that are named beside a question


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
    again: Annotated[bool, typer.Option("--again", help="Ask again what was put off.")] = False
    json: options.Json = False


@options.takes(ReviewArguments)
def review(given: ReviewArguments) -> None:
    """Say how sure each result is, and ask what signs a family off; first what makes most results right for a second of
    your time.

    In a terminal it asks one question after the other; what is said is kept at once. Exit code 1 while some result is
    held, or where a reply did not fit any more.
    """
    project = Project.open(given.project)
    replies = read_replies(given.answers) if given.answers else []
    if given.again:
        project.ask_again()
    found = _look(project, given.sure)
    waiting = {reply.question: reply for reply in replies}
    while (question := found.assessment.question) and question.id in waiting:
        found = _reply(project, found, question, waiting.pop(question.id), given.sure)
    for name in waiting:
        remark(f"{name}: this question is not asked any more, so the reply is skipped")
    asks = not (given.json or given.answers) and sys.stdin.isatty() and sys.stdout.isatty()
    if asks:
        found = _converse(project, found, given.sure)
    if given.json:
        print_json(to_json(project, found))
    else:
        _print_review(project, found, shlex.quote(str(given.project)), asked=asks)
    for asset, why in found.taken_back.items():
        remark(f"{asset} is no longer signed off: {why}")
    raise typer.Exit(int(bool(found.assessment.held or waiting)))


def _look(project: Project, bar: float) -> ProjectReview:
    with show_status("looking at the family"):
        return project.review(bar)


def _reply(
    project: Project, found: ProjectReview, question: ReviewQuestion, reply: ReviewReply, bar: float
) -> ProjectReview:
    project.reply(found, question, reply)
    for sentence in find_contradictions(found.state, question, reply):
        remark(sentence)
    said = None if reply.later or reply.choice is None else question.choices[reply.choice].text
    if question.kind == "result" and said in (WRONG, CORRECT):
        word = shlex.quote(str(project.folder))
        show_it = f"meshforge demonstrate {word} {shlex.quote(question.asset)} 'HULLS => ACTION' ..."
        state = "flagged" if said == WRONG else "set aside until then"
        remark(f"{question.asset} is {state}; to show what is meant there: {show_it}")
    after = _look(project, bar)
    return replace(after, taken_back={**found.taken_back, **after.taken_back})


def _print_review(project: Project, found: ProjectReview, word: str, *, asked: bool) -> None:
    """How the family stands, and what to do; the question where no person was asked it."""
    question = found.assessment.question
    typer.echo(format_review(found, project.folder))
    if question and not asked:
        typer.echo(f"\n{format_question(question, draw_question(project, found, question))}")
        remark(f"\n{format_reply_help(question, word)}")
    if question is None and found.assessment.held and project.put_off_ids():
        remark(f"Some questions were put off: meshforge review {word} --again asks them.")
    if found.assessment.is_done and project.program() and not _is_written(project):
        remark(f"Next: meshforge apply {word}")


def _is_written(project: Project) -> bool:
    """Whether all outputs are up to date."""
    return all(asset.is_done for asset in project.status().assets)


def _converse(project: Project, found: ProjectReview, bar: float) -> ProjectReview:
    """Ask at the terminal until nothing is left, or the person has enough; what was said is kept at once."""
    while question := found.assessment.question:
        typer.echo(format_review(found, project.folder, held=_FEW_HELD))
        typer.echo(f"\n{format_question(question, draw_question(project, found, question))}")
        if not question.choices:
            typer.echo(format_reply_help(question, shlex.quote(str(project.folder))))
        reply = _ask(question)
        if reply is None:
            break
        try:
            found = _reply(project, found, question, reply, bar)
        except MeshForgeError as error:
            typer.echo(f"{error.message}\n", err=True)
    return found


def _ask(question: ReviewQuestion) -> ReviewReply | None:
    """What is typed, asked for until it is a reply; None where the person stops."""
    while True:
        try:
            line = input(format_prompt(question)).strip()
        except (EOFError, KeyboardInterrupt):
            return None
        if line == "q":
            return None
        try:
            return parse_reply(line, question)
        except UsageError as error:
            typer.echo(error.message)


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
