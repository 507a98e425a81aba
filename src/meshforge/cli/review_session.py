"""Replies to the questions of a project one after the other, by a person at the terminal or from a file."""

from __future__ import annotations

import json
import shlex
from collections.abc import Sequence
from dataclasses import replace

import typer

from meshforge.cli.console import progress
from meshforge.cli.review_answers import (
    ScriptReply,
    find_contradictions,
    format_prompt,
    format_question,
    format_reply_help,
    parse_reply,
)
from meshforge.cli.review_pictures import draw_question
from meshforge.cli.terminal import remark
from meshforge.common import MeshForgeError, UsageError
from meshforge.project import Project, ProjectReview, format_review
from meshforge.signoff import ReviewQuestion, ReviewReply, question_of
from meshforge.signoff.question import WRONG

_FEW_LISTED = 3  # assets that need review and are named beside a question


class ReviewSession:
    """Replies one after the other. found: the family as it stands; taken_back: why some assets are no longer signed
    off."""

    def __init__(self, project: Project, threshold: float) -> None:
        self._project, self._threshold = project, threshold
        self.taken_back = dict[str, str]()
        self.found = self._look()

    def reply_to_all(self, replies: Sequence[ScriptReply]) -> int:
        """Take replies, each once its question is asked; how many did not fit. One that was taken before, as by a
        command that was killed, fits."""
        waiting = list(replies)
        while asked := next(((one, question) for one in waiting if (question := self._find(one))), None):
            waiting.remove(asked[0])
            self._reply(asked[1], asked[0].to_reply(asked[1]))
        return sum(not self._reply_again(one) for one in waiting)

    def _find(self, one: ScriptReply) -> ReviewQuestion | None:
        """The question that it replies to, if it is asked now with that choice, or was never replied to."""
        question = one.find(self.found.assessment)
        is_gone = question and isinstance(one.choice, str) and question.choice(one.choice) is None
        return None if is_gone and one.question in self._project.feedback().replied else question

    def _reply_again(self, one: ScriptReply) -> bool:
        """Whether a reply to a question that is not asked now fits: as it was taken before, or in place of another."""
        before = self._project.feedback().replied.get(one.question)
        if before is None:
            remark(f"{one.question}: this question is not asked any more, so the reply is skipped")
            return False
        origin = before.origin
        question = question_of(origin.asked) if origin else None
        reply = one.to_reply(question) if question else None
        if not (origin and question and reply) or reply.later or reply.to_json() == origin.reply:
            remark(f"{one.question}: it was replied to before")
            return True
        try:
            self._project.reply_again(question, reply)
        except MeshForgeError as error:
            remark(f"{one.question}: {error.message}")
            return False
        was, now = (json.dumps(row, ensure_ascii=False) for row in (origin.reply, reply.to_json()))
        remark(f"{one.question}: {before.by or 'somebody'} said {was} before, now it is {now}: the last word counts")
        self.found = self._look()
        return True

    def converse(self, by: str | None = None) -> None:
        """Ask at the terminal until nothing is left, or the person has enough; what is said is kept at once."""
        while question := self.found.assessment.question:
            typer.echo(format_review(self.found, need_review=_FEW_LISTED))
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
        with progress(None, "looking at the family"):
            found = self._project.review(self._threshold)
        self.taken_back |= found.taken_back
        return found

    def _reply(self, question: ReviewQuestion, reply: ReviewReply) -> None:
        self._project.reply(question, reply)
        for sentence in find_contradictions(self.found.state, question, reply):
            remark(sentence)
        if question.kind == "result" and reply.choice == WRONG and not (reply.selections or reply.labels):
            word, asset = shlex.quote(str(self._project.folder)), shlex.quote(question.asset)
            show_it = f"meshforge demonstrate {word} {asset} 'HULLS => ACTION' ..."
            remark(f"{question.asset} needs review; to show what is meant there: {show_it}")
        self.found = self._look()


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
