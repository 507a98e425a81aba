"""Replies to the questions of a project one after the other, by a person at the terminal or from a file; and the
pictures of a question, in `.meshforge/review` of the project."""

from __future__ import annotations

import json
import shlex
import shutil
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from meshforge.cli.console import progress
from meshforge.cli.review_answers import ScriptReply, format_prompt, format_question, format_reply_help, parse_reply
from meshforge.cli.terminal import remark
from meshforge.common import MeshForgeError, UsageError
from meshforge.language import Orient, Program, to_canonical_frame
from meshforge.project import Project, ProjectReview, format_review, run_with_manual_edits
from meshforge.rendering import Up, draw_before_after, make_contact_sheet, render, write_png
from meshforge.signoff import HullPlace, ReviewQuestion, ReviewReply, question_of
from meshforge.signoff.question import RIGHT, WRONG
from meshforge.store import AnswerEvent, Event, ExclusionEvent, LabelFixEvent, SnoozeEvent, VerdictEvent
from meshforge.symbolic import SymbolicMesh

if TYPE_CHECKING:
    from PIL.Image import Image

_FEW_LISTED = 3  # assets that need review and are named beside a question


class ReviewSession:
    """Replies one after the other. found: the family now; taken_back: why some assets are no longer signed off."""

    def __init__(self, project: Project, threshold: float) -> None:
        self._project, self._threshold = project, threshold
        self.taken_back = dict[str, str]()
        self.found = self._look()

    def reply_to_all(self, replies: Sequence[ScriptReply], by: str | None = None) -> int:
        """Take replies, each once its question is asked; how many did not fit. One that was taken before, as by a
        command that was killed, fits. by: the name of who says so."""
        waiting = list(replies)
        while asked := next(((one, question) for one in waiting if (question := self._find(one))), None):
            waiting.remove(asked[0])
            self._reply(asked[1], replace(asked[0].to_reply(asked[1]), by=by))
        return sum(not self._is_known(one) for one in waiting)

    def _find(self, one: ScriptReply) -> ReviewQuestion | None:
        """The question that it replies to, if it is asked now with that choice, or was never replied to."""
        question = one.find(self.found.assessment)
        is_gone = question and isinstance(one.choice, str) and question.choice(one.choice) is None
        return None if is_gone and one.id in self._project.feedback().replied else question

    def _is_known(self, one: ScriptReply) -> bool:
        """Whether a reply to a question that is not asked now was taken before, as it is."""
        before = self._project.feedback().replied.get(one.id)
        if before is None:
            remark(f"{one.id}: this question is not asked any more, so the reply is skipped")
            return False
        origin = before.origin
        question = question_of(origin.asked) if origin else None
        reply = one.to_reply(question) if question else None
        if not (origin and reply) or reply.later or reply.to_json() == origin.reply:
            remark(f"{one.id}: it was replied to before")
            return True
        earlier, folder = json.dumps(origin.reply, ensure_ascii=False), shlex.quote(str(self._project.folder))
        remark(f"{one.id}: {before.by or 'somebody'} said {earlier} before, so the reply is skipped")
        remark(f"  to change that: {_explain_change(before, folder)}")
        return False

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
        if question.kind == "result" and reply.choice == WRONG and not (reply.selections or reply.labels):
            word, asset = shlex.quote(str(self._project.folder)), shlex.quote(question.asset)
            show_it = f"meshforge demonstrate {word} {asset} 'HULLS => ACTION' ..."
            remark(f"{question.asset} needs review; to show what is meant there: {show_it}")
        self.found = self._look()


def _explain_change(before: Event, folder: str) -> str:
    match before:
        case AnswerEvent() | LabelFixEvent():
            return f"meshforge review {folder} --forget {shlex.quote(before.id)}"
        case VerdictEvent() | ExclusionEvent():
            return f"meshforge review {folder} --forget {shlex.quote(before.asset)}"
        case SnoozeEvent():
            return f"meshforge review {folder} --again"
        case _:
            return "its demonstration, its labels, or its hulls, by hand"


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


_SIZE, _SMALL_SIZE = (720, 560), (480, 374)


def draw_question(project: Project, found: ProjectReview, question: ReviewQuestion) -> list[Path]:
    """Draw what a question is about: one picture of each choice, or one of all, and of goals that fail there; those of
    the question before are taken away. Return their paths, as one types them here; none where it cannot be drawn."""
    folder = project.layout.review_pictures
    shutil.rmtree(folder, ignore_errors=True)
    with progress(None, "drawing"), suppress(MeshForgeError):
        drawn = _draw(project, found, question)
        failures = found.assessment.failures.get(question.asset, ()) if question.goals else ()
        return [
            *(_write(folder / f"{name}.png", picture) for name, picture in drawn),
            *(_shorten(goal.picture) for goal in failures if goal.picture),
        ]
    return []


def _write(path: Path, picture: Image) -> Path:
    write_png(path, picture)
    return _shorten(path)


def _shorten(path: Path) -> Path:
    here = Path.cwd()
    return path.relative_to(here) if path.is_relative_to(here) else path


def _draw(project: Project, found: ProjectReview, question: ReviewQuestion) -> Iterator[tuple[str, Image]]:
    name, asset, meshes = question.id, question.asset, found.state.meshes
    program, words = found.outcome.program if found.outcome else None, project.vocabulary
    if question.hulls:
        yield name, _draw_sheet(meshes, question.hulls)
    elif asset not in meshes:
        return
    elif question.kind in ("candidate", "label") and program and question.rule:
        mesh, up = project.mesh_before_rule(asset, question.rule, program, meshes), _up(project.orientation)
        for number, choice in enumerate(question.choices, 1):
            chosen, title = frozenset(choice.select or ()), f"choice {number}"
            yield f"{name}-choice-{number}", render(mesh, highlight=chosen, size=_SIZE, title=title, up=up)
    elif question.kind == "result" and program and question.choice(RIGHT):
        yield name, _draw_result(project, asset, meshes[asset], program)
    elif question.kind == "orientation":
        for choice in question.choices:
            orient = choice.orient or found.state.frame.orient
            mesh, up = to_canonical_frame(meshes[asset], orient, project.settings.thresholds.contact)[0], _up(orient)
            picture = render(mesh, color_by="label", size=_SIZE, title=choice.text, vocabulary=words, up=up)
            yield f"{name}-{choice.id}", picture
    else:
        yield name, render(meshes[asset], color_by="label", size=_SIZE, title=asset, vocabulary=words)


def _draw_sheet(meshes: Mapping[str, SymbolicMesh], hulls: tuple[HullPlace, ...]) -> Image:
    """Hulls of several assets, each asset as it lies, on one sheet."""
    chosen = {place.asset: frozenset(one.hull for one in hulls if one.asset == place.asset) for place in hulls}
    return make_contact_sheet(
        [render(meshes[asset], highlight=names, size=_SMALL_SIZE, title=asset) for asset, names in chosen.items()]
    )


def _draw_result(project: Project, asset: str, mesh: SymbolicMesh, program: Program) -> Image:
    before, pose = to_canonical_frame(mesh, program.orient, program.contact)
    after = run_with_manual_edits(project, asset, mesh, program).mesh
    turned = after.with_hulls(hull.move(pose) for hull in after.hulls)
    up = _up(program.orient)
    return draw_before_after(before, turned, size=_SMALL_SIZE, vocabulary=project.vocabulary, up=up)


def _up(orient: Orient | None) -> Up | None:
    """Z where the orientation names it; otherwise the file says which axis is up."""
    return "Z" if orient and orient.names_z else None
