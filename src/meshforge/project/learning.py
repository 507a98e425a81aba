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
from meshforge.project.reviewing import accepted_results
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import (
    Ambiguous,
    Answer,
    Correction,
    Demonstration,
    Found,
    NoProgram,
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
    looked = _accepted(project, demos, fitting)
    asked = _Asked(project, how.confirm) if how.accept and how.confirm else None
    settings = project.settings
    names = dict.fromkeys(name for demo in demos.values() for step in demo.steps for name in step.action.templates)
    confirm = _once(asked or how.confirm) if how.confirm else None
    templates, rejected = project.templates(names), _rejected(said)

    def learned(answers: Sequence[Answer]) -> Outcome:
        return synthesize(
            tuple(demos.values()),
            batch=meshes,
            orient=project.orientation,
            templates=templates,
            vocabulary=settings.vocabulary or None,
            contact=settings.thresholds.contact,
            extremity=settings.thresholds.extremity,
            options=how.options or Options(),
            confirm=confirm,
            answers=answers,
            rejected=rejected,
            follow=how.follow,
            stop=how.stop,
        )

    outcome = learned([*looked, *fitting])
    if isinstance(outcome, NoProgram) and looked:
        overruled = tuple(dict.fromkeys(answer.asset for answer in looked))
        outcome = replace(learned(fitting), overruled=overruled)
    stale = [answer for answer in outcome.stale if answer not in looked]
    outcome = replace(outcome, stale=tuple(dict.fromkeys([*unfit, *stale])))
    if how.accept and isinstance(outcome, Found | Ambiguous):
        accepting.keep(project, outcome, asked.lesson if asked and asked.lesson else lesson)
    return outcome


def _once(confirm: Confirm) -> Confirm:
    """Asks about each correction once, however often something is learned."""
    said: dict[Correction, bool] = {}

    def asked(repair: Repair) -> bool:
        if repair.correction not in said:
            said[repair.correction] = confirm(repair)
        return said[repair.correction]

    return asked


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


def _accepted(project: Project, demos: Mapping[str, Demonstration], said: Sequence[Answer]) -> list[Answer]:
    """What rules select on results that were accepted, but for what was said otherwise, or of rules that are others."""
    actions = actions_of(demo.steps for demo in demos.values())
    known = {(answer.rule, answer.asset) for answer in said}
    return [
        Answer(one.rule, asset, one.select)
        for asset, seen in accepted_results(project).items()
        for one in seen
        if actions.get(one.rule) == one.action and (one.rule, asset) not in known
    ]


def _rejected(said: AnswersFile) -> list[Correction]:
    """What is not to be proposed: what was refused, and what would undo a confirmed repair."""
    undone = (line.correction.reverse for line in said.confirmed)
    return [*(line.correction for line in said.rejected), *(reverse for reverse in undone if reverse)]
