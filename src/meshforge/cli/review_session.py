"""Replies to the questions of a project one after the other, by a person at the terminal or from a file."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from dataclasses import replace

import typer

from meshforge.cli.console import progress
from meshforge.cli.review_answers import ScriptReply, find_contradictions, parse_reply
from meshforge.cli.review_pictures import draw_question
from meshforge.cli.review_text import format_prompt, format_question, format_reply_help
from meshforge.cli.terminal import remark
from meshforge.common import MeshForgeError, UsageError
from meshforge.project import Project, ProjectReview, format_review
from meshforge.signoff import ResultQuestion, ReviewQuestion, ReviewReply
from meshforge.signoff.question import WRONG, QuestionBase

_FEW_HELD = 3  # assets that need review and are named beside a question


class ReviewSession:
    """Replies one after the other. found: the family as it stands; taken_back: why some assets are no longer signed
    off."""

    def __init__(self, project: Project, bar: float) -> None:
        self._project, self._bar = project, bar
        self.taken_back = dict[str, str]()
        self.found = self._look()

    def reply_to_all(self, replies: Sequence[ScriptReply]) -> int:
        """Take replies, each once its question is asked; how many did not fit. One that was taken before, as by a
        command that was killed, fits."""
        waiting = list(replies)
        while asked := next(
            ((one, question) for one in waiting if (question := one.find(self.found.assessment))), None
        ):
            waiting.remove(asked[0])
            self._reply(asked[1], asked[0].to_reply(asked[1]))
        known = self._project.feedback().replied
        for one in waiting:
            skipped = "this question is not asked any more, so the reply is skipped"
            remark(f"{one.question}: {'it was replied to before' if one.question in known else skipped}")
        return sum(one.question not in known for one in waiting)

    def converse(self, by: str | None = None, kinds: tuple[type[QuestionBase], ...] = (QuestionBase,)) -> None:
        """Ask at the terminal until nothing of some kinds is left, or the person has enough; what was said is kept at
        once."""
        while question := next((one for one in self.found.assessment.questions if isinstance(one, kinds)), None):
            typer.echo(format_review(self.found, held=_FEW_HELD))
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
