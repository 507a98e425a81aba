"""An asset's own steps, one after the other, as they are replayed when a program is learned from them."""

from __future__ import annotations

from dataclasses import replace

from meshforge.errors import MeshForgeError, ProgramError
from meshforge.geometry import Pose
from meshforge.language import EXTREMITY, Action, Orient, Program, Rule, orient_mesh, select_mask
from meshforge.project import Project
from meshforge.studio.showing.course import Course, Deed
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Demonstration, Step
from meshforge.synthesis.demonstration import core
from meshforge.synthesis.remember import remembered
from meshforge.synthesis.replay import begun


def begin(asset: str, mesh: SymbolicMesh, orient: Orient | None, contact: float | None) -> Course:
    """An asset before its first edit. Raises ProgramError where the orientation does not turn it."""
    staged = begun(asset, Demonstration(mesh, (), asset), orient, contact).mesh
    pose = remembered(mesh, ("pose", orient), Pose, lambda: orient_mesh(mesh, orient)[1])
    return Course(asset, mesh, pose, staged, staged)


def walk(project: Project, asset: str, mesh: SymbolicMesh, steps: int | None = None) -> Course:
    """An asset after its first steps, all by default; a step that cannot be done is left out, and says why.

    A step that is left open does what the rule of its number does in the present program, as when a program is
    learned; nothing where there is no such rule. Raises ProgramError where the orientation does not turn the asset.
    """
    course = begin(asset, mesh, project.orientation, project.settings.thresholds.contact)
    program = _program(project)
    for step in project.steps(asset)[:steps]:
        try:
            course = _after(project, course, step, program)
        except MeshForgeError as error:
            course = course.skip(error)
    return course


def _after(project: Project, course: Course, step: Step, program: Program) -> Course:
    if step.select is not None:
        return _done(project, course, course.mask_of(step.select), step.action, step.label)
    rule = _rule_of(program, step)
    if rule is None:
        return replace(course, results=(*course.results, Deed(step.rule)))
    mask = select_mask(rule.extractor, course.mesh, program.extremity or EXTREMITY)
    return _done(project, course, mask, rule.action, rule.label)


def _done(project: Project, course: Course, mask: int, action: Action, label: str | None) -> Course:
    return course.apply(mask, action, label, project.templates(action.templates), again=True)


def _rule_of(program: Program, step: Step) -> Rule | None:
    """The rule of a program that does what a step says."""
    rules = program.rules[step.rule - 1 : step.rule]
    return next((r for r in rules if (core(r.action), r.label) == (core(step.action), step.label)), None)


def _program(project: Project) -> Program:
    try:
        return project.program() or Program()
    except ProgramError:
        return Program()
