"""Edits of what is demonstrated, and of the orientation."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Literal

from meshforge.errors import MeshForgeError
from meshforge.project import action_text, parse_action_text
from meshforge.studio.edits.base import Edit
from meshforge.studio.errors import ConflictError
from meshforge.studio.versions import steps_version
from meshforge.studio.wire.base import Wire
from meshforge.synthesis import Step
from meshforge.words import counted

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
        project.demonstrate(self.asset, _steps(self.steps))

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.layout.demonstration(self.asset),)

    def describe(self, project: Project) -> str:
        before = [(step.select, action_text(step.action, step.label)) for step in _kept(project, self)]
        now = [(None if s.select is None else frozenset(s.select), s.action) for s in self.steps]
        if len(now) == len(before) + 1 and now[:-1] == before:
            select, action = now[-1]
            on = "left open" if select is None else counted(len(select), "hull") if select else "nothing here"
            return f"step {len(now)} of {self.asset}: {action}, {on}"
        if len(now) < len(before):
            return f"{counted(len(before) - len(now), 'step')} of {self.asset} taken away"
        changed = [k for k, (a, b) in enumerate(zip(before, now, strict=False), 1) if a != b]
        return f"step {changed[0]} of {self.asset} changed" if changed else f"steps of {self.asset}"

    def assets(self, project: Project) -> tuple[str, ...]:
        return (self.asset,)


def _steps(texts: tuple[StepText, ...]) -> list[Step]:
    """Steps for learning. Raises ProjectError for an action that does not parse."""
    return [
        Step(number, step.select, *parse_action_text(step.action, f"step {number}"))
        for number, step in enumerate(texts, 1)
    ]


def _kept(project: Project, edit: SetSteps) -> tuple[Step, ...]:
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
