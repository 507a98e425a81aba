"""Edits of demonstrations and of the orientation, answers given while learning, and the program itself."""

from typing import Literal

from meshforge.batch import action_text
from meshforge.common import MeshForgeError, ProjectError, pluralize
from meshforge.language import All, BaseExtractor, Is, LandmarkPair, Orient, Program, show
from meshforge.project import Project
from meshforge.store import ConflictError, Layout
from meshforge.studio.actions import read_action
from meshforge.studio.edits import base
from meshforge.studio.wire import Wire
from meshforge.studio.wire.family import AxisLandmarks
from meshforge.studio.wire.program import ActionCall
from meshforge.synthesis import Answer, Step


class StepEdit(Wire):
    """One step. select: names of hulls, [] for nothing here, null for open."""

    select: tuple[str, ...] | None
    action: ActionCall


class SetSteps(base.Edit):
    """Set the steps of an asset, one a rule, in order. version: of the steps that were changed."""

    kind: Literal["steps"] = "steps"
    touches = (Layout.demonstration, Layout.events)
    asset: str
    version: str
    steps: tuple[StepEdit, ...]

    def apply(self, project: Project) -> None:
        if base.steps_version(project, self.asset) != self.version:
            raise ConflictError(
                "the steps were changed elsewhere meanwhile",
                where=self.asset,
                remedy="They are shown as they are now; do it again if it is still wanted.",
            )
        project.demonstrate(self.asset, self._read())

    def _read(self) -> list[Step]:
        steps = enumerate(self.steps, 1)
        return [Step(rule, step.select, *read_action(step.action, f"step {rule}")) for rule, step in steps]

    def describe(self, project: Project) -> str:
        before, now = (
            [(step.select, action_text(step.action, step.label)) for step in steps]
            for steps in (_read_steps(project, self.asset), self._read())
        )
        if len(now) == len(before) + 1 and now[:-1] == before:
            select, action = now[-1]
            on = "left open" if select is None else pluralize(len(select), "hull") if select else "nothing here"
            return f"step {len(now)} of {self.asset}: {action}, {on}"
        if len(now) < len(before):
            return f"{pluralize(len(before) - len(now), 'step')} of {self.asset} taken away"
        changed = [k for k, (a, b) in enumerate(zip(before, now, strict=False), 1) if a != b]
        return f"step {changed[0]} of {self.asset} changed" if changed else f"steps of {self.asset}"


def _read_steps(project: Project, asset: str) -> tuple[Step, ...]:
    """The steps on disk; none where their file is damaged, so that it is written anew."""
    try:
        return project.steps(asset)
    except MeshForgeError:
        return ()


class _RuleEdit(base.Edit):
    """An edit of a rule in all demonstrations, and in the answers about it."""

    touches = (Layout.demonstration, Layout.events)


class MoveRule(_RuleEdit):
    """Put a rule at another place, in all demonstrations; rules count from 1."""

    kind: Literal["move-rule"] = "move-rule"
    title = "rule {rule} is now rule {to}"
    rule: int
    to: int

    def apply(self, project: Project) -> None:
        project.move_rule(self.rule, self.to)


class DeleteRule(_RuleEdit):
    """Take a rule away, with its steps in all demonstrations."""

    kind: Literal["delete-rule"] = "delete-rule"
    title = "rule {rule} taken away"
    rule: int

    def apply(self, project: Project) -> None:
        project.delete_rule(self.rule)


class SetOrientation(base.Edit):
    """Set the orientation directive; empty takes it away."""

    kind: Literal["orient"] = "orient"
    touches = (Layout.settings,)
    text: str

    def apply(self, project: Project) -> None:
        project.set_orientation(self.text)

    def describe(self, project: Project) -> str:
        return f"orientation: {self.text}" if self.text else "orientation taken away"


class SetLandmarks(base.Edit):
    """Set the orientation by landmarks; none takes it away. snap: whether it turns by quarter turns only."""

    kind: Literal["landmarks"] = "landmarks"
    touches = (Layout.settings,)
    snap: bool
    pairs: tuple[AxisLandmarks, ...]

    def apply(self, project: Project) -> None:
        project.set_orientation(self._read())

    def _read(self) -> Orient | None:
        pairs = tuple(LandmarkPair(pair.axis, _select(pair.start), _select(pair.end)) for pair in self.pairs)
        return Orient(pairs, self.snap) if pairs else None

    def describe(self, project: Project) -> str:
        orient = self._read()
        return show(orient).replace("orient", "orientation:", 1) if orient else "orientation taken away"


def _select(label: str | None) -> BaseExtractor:
    return All() if label is None else Is(label)


class SetGoal(base.Edit):
    """Keep a goal under a name; null takes it away. was: the name that it had before, null for a new one."""

    kind: Literal["goal"] = "goal"
    touches = (Layout.settings,)
    name: str
    text: str | None
    was: str | None = None

    def apply(self, project: Project) -> None:
        if self.name != self.was and self.name in project.settings.goals and self.text is not None:
            raise ProjectError(f"there is a goal {self.name!r} already", remedy="Give it another name.")
        if not self.name.strip():
            raise ProjectError("the goal has no name", remedy="Type one.")
        project.set_goal(self.name, self.text)
        if self.was and self.was != self.name and self.was in project.settings.goals:
            project.set_goal(self.was, None)

    def describe(self, project: Project) -> str:
        return f"goal {self.name} taken away" if self.text is None else f"goal {self.name}: {self.text}"


class AnswerForRule(base.Edit):
    """Say which hulls a rule selects on an asset, without being asked."""

    kind: Literal["answer"] = "answer"
    touches = (Layout.events,)
    title = "rule {rule} on {asset} answered"
    rule: int
    asset: str
    select: tuple[str, ...]

    def apply(self, project: Project) -> None:
        project.add_answer(Answer(self.rule, self.asset, self.select))


class TakeBack(base.Edit):
    """Take back an answer or a repair by its id."""

    kind: Literal["take-back"] = "take-back"
    touches = (Layout.events, Layout.labels)
    title = "{id} taken back"
    id: str

    def apply(self, project: Project) -> None:
        project.take_back(self.id)


_PROGRAM = Layout.program, Layout.previous_program, Layout.learned


class WriteProgram(base.Edit):
    """Make a text the project's program. version: of the program that was changed."""

    kind: Literal["program"] = "program"
    touches = _PROGRAM
    title = "program changed by hand"
    text: str
    version: str

    def apply(self, project: Project) -> None:
        if base.program_version(project) != self.version:
            raise ConflictError(
                "the program was changed elsewhere meanwhile",
                where=Layout.program.name,
                remedy="Copy your text, look at the present one, and do it again.",
            )
        project.accept(Program.parse(self.text))


class TakeLearned(base.Edit):
    """Give up the program that was written by hand, so that the learned one takes its place."""

    touches = _PROGRAM
    title = "the learned program taken in place of the one by hand"

    def apply(self, project: Project) -> None:
        layout = project.layout
        for path in (layout.program, layout.learned):
            path.unlink(missing_ok=True)
