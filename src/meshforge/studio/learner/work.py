"""The learning process' side: what it is asked to do, with the family that it keeps in memory."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from time import perf_counter

from meshforge.errors import MeshForgeError
from meshforge.language import Program, parse_extractor
from meshforge.project import Project, looked_at
from meshforge.studio.learner.bell import Ticket
from meshforge.studio.learner.lesson import lesson_view
from meshforge.studio.learner.meeting import Meetings
from meshforge.studio.learner.reach import Plan, reached
from meshforge.studio.learner.shelf import Shelf, Stopped
from meshforge.studio.wire.lesson import Generalised, LessonView, Reach


@cache
def _shelf(folder: Path) -> Shelf:
    return Shelf()


@cache
def _meetings(folder: Path) -> Meetings:
    return Meetings()


def learn(folder: Path, ticket: Ticket, number: int, take: bool) -> LessonView:
    """A lesson from a project as it is now."""
    begun, stop = perf_counter(), ticket.stop
    try:
        project = Project.open(folder)
        shelf = _shelf(folder)
        shelf.count_run()
        meshes = dict(shelf.read_meshes(project, looked_at(project), stop))
        accept = take or not project.program_state().by_hand
        outcome = project.synthesize(accept=accept, meshes=meshes, stop=stop)
    except Stopped:
        return LessonView(number=number, status="timeout", seconds=perf_counter() - begun)
    except MeshForgeError as error:
        return LessonView(number=number, status="error", error=error.message, seconds=perf_counter() - begun)
    return lesson_view(number, outcome, len(meshes), perf_counter() - begun)


def reach(folder: Path, ticket: Ticket, program: str) -> tuple[Reach, ...] | None:
    """What a program does on every asset that can be read, None where it was interrupted.

    Of a family of more than 400 only on those that are looked at while learning (`looked_at`): all assets of a family
    without bounds do not go into memory, and reading them anew after each change would take minutes.
    """
    project = Project.open(folder)
    plan = _plan(project, Program.parse(program))
    try:
        rows = _shelf(folder).read_meshes(project, looked_at(project), ticket.stop)
        return tuple(reached(plan, asset, mesh) for asset, mesh in rows)
    except Stopped:
        return None


def generalise(folder: Path, ticket: Ticket, extractor: str, rule: int, program: str | None) -> Generalised | None:
    """What an extractor selects on the assets that `reach` looks at, None where it was interrupted."""
    project, wanted = Project.open(folder), parse_extractor(extractor)
    thresholds = project.settings.thresholds
    bare = Program(orient=project.orientation, contact=thresholds.contact, extremity=thresholds.extremity)
    plan = _plan(project, (Program.parse(program) if program else bare), rule)
    meetings = _meetings(folder)
    try:
        rows = _shelf(folder).read_meshes(project, looked_at(project), ticket.stop)
        return Generalised(assets={asset: meetings.select(plan, mesh, wanted) for asset, mesh in rows})
    except Stopped:
        return None


def _plan(project: Project, program: Program, before: int | None = None) -> Plan:
    """A program with its templates; before: only of its rules before that one."""
    rules = program.rules if before is None else program.rules[: max(0, before - 1)]
    shortened = Program(program.labels, program.orient, rules, program.contact, program.extremity)
    return Plan(shortened, project.templates(shortened.templates))
