"""Replays the steps of an asset one by one: what it is after each of them, and what each did."""

from __future__ import annotations

from meshforge.common import MeshForgeError, ProgramError
from meshforge.language import Program, Replay, Rule
from meshforge.project import Project
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Step, memoize, strip_each


def replay_steps(project: Project, asset: str, mesh: SymbolicMesh, steps: int | None = None) -> Replay:
    """An asset after its first steps, all by default; a step that fails is skipped, and its trace has the error.

    A step without a selection does what the rule of its number does in the present program, as in learning, or nothing
    without such a rule. Raises ProgramError where the orientation does not turn the asset.
    """
    contact = project.settings.thresholds.contact
    replay = Replay.begin(mesh, project.orientation, contact, name=asset, memo=memoize)
    try:
        program = project.program() or Program()
    except ProgramError:
        program = Program()
    for step in project.steps(asset)[:steps]:
        try:
            replay = _apply_step(project, replay, step, program)
        except MeshForgeError as error:
            replay = replay.skip(error.message)
    return replay


def _apply_step(project: Project, replay: Replay, step: Step, program: Program) -> Replay:
    action, label = step.action, step.label
    if step.select is not None:
        mask = replay.mask_of(step.select)
    else:
        rule = _rule_of(program, step)
        if rule is None:
            return replay.skip()
        mask, action, label = replay.select(rule, program.extremity), rule.action, rule.label
    return replay.apply(mask, action, label, project.templates(action.templates))


def _rule_of(program: Program, step: Step) -> Rule | None:
    rules = program.rules[step.rule - 1 : step.rule]
    return next((r for r in rules if (strip_each(r.action), r.label) == (strip_each(step.action), step.label)), None)
