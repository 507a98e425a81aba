"""Learning the project's program from its demonstrations, and from what a person said since."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from meshforge.errors import ProjectError
from meshforge.language import Program
from meshforge.project import accepting
from meshforge.project.answering import actions_of, answers, checked, confirm, reject
from meshforge.project.answers_file import AnswerLine, AnswersFile
from meshforge.project.family import Family
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import (
    Ambiguous,
    Answer,
    Correction,
    Demonstration,
    Found,
    Options,
    Outcome,
    Repair,
    synthesize,
)

if TYPE_CHECKING:
    from meshforge.project.project import Project

Confirm = Callable[[Repair], bool]


@dataclass(frozen=True, slots=True, kw_only=True)
class LessonPlan:
    """How a project is to learn; the fields are those of `Project.synthesize`."""

    accept: bool = True
    options: Options | None = None
    confirm: Confirm | None = None
    stop: Callable[[], bool] | None = None
    answers: Sequence[Answer] = ()
    meshes: Mapping[str, SymbolicMesh] | None = None
    follow: Program | None = None


def learn(project: Project, how: LessonPlan) -> Outcome:
    """What can be learned from the demonstrations. Raises ProjectError where there are none."""
    meshes = Family(project).meshes() if how.meshes is None else how.meshes
    demos = _demonstrations(project, meshes)
    lesson = accepting.lesson_digest(project)
    said = answers(project)
    fitting, unfit = _answers(project, said, demos, how.answers)
    asked = _Asked(project, how.confirm) if how.accept and how.confirm else None
    settings = project.settings
    names = dict.fromkeys(name for demo in demos.values() for step in demo.steps for name in step.action.templates)
    outcome = synthesize(
        tuple(demos.values()),
        batch=meshes,
        orient=project.orientation,
        templates=project.templates(names),
        vocabulary=settings.vocabulary or None,
        contact=settings.thresholds.contact,
        extremity=settings.thresholds.extremity,
        options=how.options or Options(),
        confirm=asked or how.confirm,
        answers=fitting,
        rejected=_rejected(said),
        follow=how.follow,
        stop=how.stop,
    )
    outcome = replace(outcome, stale=tuple(dict.fromkeys([*unfit, *outcome.stale])))
    if how.accept and isinstance(outcome, Found | Ambiguous):
        accepting.keep(project, outcome, asked.lesson if asked and asked.lesson else lesson)
    return outcome


class _Asked:
    """Asks about repairs and keeps what is said at once. lesson: the digest of what is learned from, since then."""

    def __init__(self, project: Project, confirm: Confirm) -> None:
        self._project, self._confirm = project, confirm
        self.lesson: str | None = None

    def __call__(self, repair: Repair) -> bool:
        right = self._confirm(repair)
        (confirm if right else reject)(self._project, repair.correction)
        self.lesson = accepting.lesson_digest(self._project)
        return right


def _demonstrations(project: Project, meshes: Mapping[str, SymbolicMesh]) -> dict[str, Demonstration]:
    ids = [asset for asset in project.assets() if project.layout.demonstration(asset).exists()]
    if not ids:
        raise ProjectError(
            "nothing is demonstrated yet",
            where=str(project.folder),
            remedy=f"Show the steps on an asset or two: meshforge demonstrate {project.folder} ASSET STEPS...",
        )
    # one that cannot be read is missing among the meshes; reading it again says why
    return {
        asset: Demonstration(meshes.get(asset) or project.mesh(asset), project.steps(asset), asset) for asset in ids
    }


def _answers(
    project: Project, said: AnswersFile, demos: Mapping[str, Demonstration], more: Sequence[Answer]
) -> tuple[list[Answer], list[Answer]]:
    """The answers to learn from, and those to a rule that does something else by now."""
    lines = {line.id: line for line in [*said.answers, *(checked(project, answer) for answer in more)]}
    actions = actions_of(demo.steps for demo in demos.values())

    def fits(line: AnswerLine) -> bool:
        return actions.get(line.rule) == (line.action or actions.get(line.rule, ""))

    fitting = [line.answer for line in lines.values() if fits(line)]
    return fitting, [line.answer for line in lines.values() if not fits(line)]


def _rejected(said: AnswersFile) -> list[Correction]:
    """What is not to be proposed: what was refused, and what would undo a confirmed repair."""
    undone = (line.correction.reverse for line in said.confirmed)
    return [*(line.correction for line in said.rejected), *(reverse for reverse in undone if reverse)]
