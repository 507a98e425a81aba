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
from meshforge.cli.review_answers import ScriptReply, find_contradictions, parse_reply, read_replies
from meshforge.cli.review_pictures import draw_question
from meshforge.cli.review_text import format_prompt, format_question, format_reply_help
from meshforge.cli.terminal import print_json, remark
from meshforge.common import MeshForgeError, UsageError
from meshforge.project import Project, ProjectReview, format_review
from meshforge.signoff import BAR, ResultQuestion, ReviewQuestion, ReviewReply
from meshforge.signoff.question import WRONG

_FEW_HELD = 3  # assets that need review and are named beside a question


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
    sure: options.OldSure = None
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
    session = _Session(project, given.min_confidence)
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
        remark(f"{asset} is no longer signed off: {why}")
    raise typer.Exit(int(bool(found.assessment.held or missed)))


class _Session:
    """Replies one after the other. found: the family as it stands; taken_back: why some assets are no longer signed
    off."""

    def __init__(self, project: Project, bar: float) -> None:
        self._project, self._bar = project, bar
        self.taken_back = dict[str, str]()
        self.found = self._look()

    def reply_to_all(self, replies: Sequence[ScriptReply]) -> int:
        """Take replies, each once its question is asked; how many did not fit. One that was taken before, by a command
        that was killed, fits."""
        waiting = list(replies)
        while asked := next(
            ((one, question) for one in waiting if (question := one.find(self.found.assessment))), None
        ):
            waiting.remove(asked[0])
            self._reply(asked[1], asked[0].to_reply(asked[1]))
        known = self._project.feedback().replied
        missed = [one for one in waiting if one.question not in known]
        for one in missed:
            remark(f"{one.question}: this question is not asked any more, so the reply is skipped")
        return len(missed)

    def converse(self, by: str | None) -> None:
        """Ask at the terminal until nothing is left, or the person has enough; what was said is kept at once."""
        while question := self.found.assessment.question:
            typer.echo(format_review(self.found, self._project.folder, held=_FEW_HELD))
            typer.echo(f"\n{format_question(question, draw_question(self._project, self.found, question))}")
            if not question.choices:
                typer.echo(format_reply_help(question, shlex.quote(str(self._project.folder))))
            reply = _ask(question)
            if reply is None:
                break
            try:
                self._reply(question, replace(reply, by=by))
            except MeshForgeError as error:
                typer.echo(f"{error.message}\n", err=True)

    def _look(self) -> ProjectReview:
        with show_status("looking at the family"):
            found = self._project.review(self._bar)
        self.taken_back |= found.taken_back
        return found

    def _reply(self, question: ReviewQuestion, reply: ReviewReply) -> None:
        self._project.reply(question, reply)
        for sentence in find_contradictions(self.found.state, question, reply):
            remark(sentence)
        if isinstance(question, ResultQuestion) and reply.choice == WRONG and not (reply.selections or reply.labels):
            word, asset = shlex.quote(str(self._project.folder)), shlex.quote(question.asset)
            show_it = f"meshforge demonstrate {word} {asset} 'HULLS => ACTION' ..."
            remark(f"{question.asset} needs review; to show what is meant there: {show_it}")
        self.found = self._look()


def _print_review(project: Project, found: ProjectReview, word: str, *, asked: bool) -> None:
    """How the family stands, and what to do; the question where no person was asked it."""
    question = found.assessment.question
    typer.echo(format_review(found, project.folder))
    if question and not asked:
        typer.echo(f"\n{format_question(question, draw_question(project, found, question))}")
        remark(f"\n{format_reply_help(question, word)}")
    if question is None and found.assessment.held and project.feedback().snoozed:
        remark(f"Some questions were put off: meshforge review {word} --again asks them.")
    if found.assessment.is_done and project.program() and not _is_written(project):
        remark(f"Next: meshforge apply {word}")


def _is_written(project: Project) -> bool:
    """Whether all outputs are up to date."""
    return all(asset.is_done for asset in project.status().assets)


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
        "excluded": dict(sorted(assessment.excluded.items())),
        "question": {**question.to_json(), "pictures": list(map(str, pictures))} if question else None,
        "lost": dict(found.lost),
    }
