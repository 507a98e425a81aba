"""Edits of demonstrations and of the orientation, answers given while learning, and the program itself."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Literal

from meshforge.common import MeshForgeError, pluralize
from meshforge.language import Program
from meshforge.store import action_text, parse_action_text
from meshforge.studio.edits.base import Edit, program_files, program_version, steps_version
from meshforge.studio.errors import ConflictError
from meshforge.studio.wire import Wire
from meshforge.synthesis import Answer, LabelCorrection, Step

if TYPE_CHECKING:
    from meshforge.project import Project


class StepText(Wire):
    """One step. select: names of hulls, [] for nothing here, null for open; action: in the language's own text."""

    select: tuple[str, ...] | None
    action: str


class SetSteps(Edit):
    """Set the steps of an asset, one a rule, in order. version: of the steps that were changed."""

    kind: Literal["steps"] = "steps"
    asset: str
    version: str
    steps: tuple[StepText, ...]

    def apply(self, project: Project) -> None:
        if steps_version(project, self.asset) != self.version:
            raise ConflictError(
                "the steps were changed elsewhere meanwhile",
                where=self.asset,
                remedy="They are shown as they are now; do it again if it is still wanted.",
            )
        project.demonstrate(self.asset, _parse_steps(self.steps))

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.demonstration(self.asset),)

    def describe(self, project: Project) -> str:
        before = [(step.select, action_text(step.action, step.label)) for step in _read_steps(project, self)]
        now = [(None if s.select is None else frozenset(s.select), s.action) for s in self.steps]
        if len(now) == len(before) + 1 and now[:-1] == before:
            select, action = now[-1]
            on = "left open" if select is None else pluralize(len(select), "hull") if select else "nothing here"
            return f"step {len(now)} of {self.asset}: {action}, {on}"
        if len(now) < len(before):
            return f"{pluralize(len(before) - len(now), 'step')} of {self.asset} taken away"
        changed = [k for k, (a, b) in enumerate(zip(before, now, strict=False), 1) if a != b]
        return f"step {changed[0]} of {self.asset} changed" if changed else f"steps of {self.asset}"

    def assets(self, project: Project) -> tuple[str, ...]:
        return (self.asset,)


def _parse_steps(texts: tuple[StepText, ...]) -> list[Step]:
    """Steps for learning. Raises ProjectError for an action that does not parse."""
    return [
        Step(number, step.select, *parse_action_text(step.action, f"step {number}"))
        for number, step in enumerate(texts, 1)
    ]


def _read_steps(project: Project, edit: SetSteps) -> tuple[Step, ...]:
    """The steps that are kept; none where their file is damaged, and is therefore written anew."""
    try:
        return project.steps(edit.asset)
    except MeshForgeError:
        return ()


class _RuleEdit(Edit):
    """An edit of a rule in all demonstrations, and in the answers about it."""

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.folder / "demonstrations", project.layout.answers)

    def assets(self, project: Project) -> tuple[str, ...]:
        return tuple(a for a in project.assets() if project.layout.demonstration(a).exists())


class MoveRule(_RuleEdit):
    """Put a rule at another place, in all demonstrations; rules count from 1."""

    kind: Literal["move-rule"] = "move-rule"
    rule: int
    to: int

    def apply(self, project: Project) -> None:
        project.move_rule(self.rule, self.to)

    def describe(self, project: Project) -> str:
        return f"rule {self.rule} is now rule {self.to}"


class DeleteRule(_RuleEdit):
    """Take a rule away, with its steps in all demonstrations."""

    kind: Literal["delete-rule"] = "delete-rule"
    rule: int

    def apply(self, project: Project) -> None:
        project.delete_rule(self.rule)

    def describe(self, project: Project) -> str:
        return f"rule {self.rule} taken away"


class SetOrientation(Edit):
    """Set the orientation directive; empty takes it away."""

    kind: Literal["orient"] = "orient"
    text: str

    def apply(self, project: Project) -> None:
        project.set_orientation(self.text)

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.settings,)

    def describe(self, project: Project) -> str:
        return f"orientation: {self.text}" if self.text else "orientation taken away"

    def assets(self, project: Project) -> tuple[str, ...]:
        return project.assets()


class AnswerQuestion(Edit):
    """Say which hulls a rule selects on an asset; null: neither of the choices, which are then in `refused`."""

    kind: Literal["answer"] = "answer"
    rule: int
    asset: str
    select: tuple[str, ...] | None
    refused: tuple[tuple[str, ...], ...] = ()

    def apply(self, project: Project) -> None:
        project.add_answer(Answer(self.rule, self.asset, self.select, self.refused))

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.answers,)

    def describe(self, project: Project) -> str:
        return f"rule {self.rule} on {self.asset} answered"


class SettleRepair(Edit):
    """Confirm or refuse a repair of a label."""

    kind: Literal["repair"] = "repair"
    asset: str
    hull: str
    was: str | None
    to: str
    accept: bool

    def apply(self, project: Project) -> None:
        settle = project.confirm if self.accept else project.reject
        settle(LabelCorrection(self.asset, self.hull, self.was, self.to))

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.answers, project.layout.labels(self.asset))

    def describe(self, project: Project) -> str:
        how = "is now labelled" if self.accept else "is not"
        return f"{self.hull} of {self.asset} {how} {self.to}"

    def assets(self, project: Project) -> tuple[str, ...]:
        return (self.asset,)


class TakeBack(Edit):
    """Take back an answer or a repair by its id."""

    kind: Literal["take-back"] = "take-back"
    id: str

    def apply(self, project: Project) -> None:
        project.take_back(self.id)

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.answers, project.layout.folder / "labels")

    def describe(self, project: Project) -> str:
        return f"{self.id} taken back"

    def assets(self, project: Project) -> tuple[str, ...]:
        asset = self.id.partition("#")[0]
        return (asset,) if asset in project.assets() else ()


class WriteProgram(Edit):
    """Make a text the project's program. version: of the program that was changed."""

    kind: Literal["program"] = "program"
    text: str
    version: str

    def apply(self, project: Project) -> None:
        if program_version(project) != self.version:
            raise ConflictError(
                "the program was changed elsewhere meanwhile",
                where="program.mf",
                remedy="Copy your text, look at the present one, and do it again.",
            )
        project.accept(Program.parse(self.text))

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return program_files(project)

    def describe(self, project: Project) -> str:
        return "program changed by hand"


class TakeLearned(Edit):
    """Give up the program that was written by hand, so that the learned one takes its place."""

    def apply(self, project: Project) -> None:
        for path in program_files(project)[::2]:
            path.unlink(missing_ok=True)

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return program_files(project)

    def describe(self, project: Project) -> str:
        return "the learned program taken in place of the one by hand"
