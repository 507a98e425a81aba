"""What a program would select on an asset, rule by rule, as it is after the steps that were shown there."""

from __future__ import annotations

from meshforge.errors import MeshForgeError
from meshforge.language import EXTREMITY, Program, Rule, explain, select_mask
from meshforge.project import Project, action_text
from meshforge.studio.wire.lesson import Guess, Guesses
from meshforge.symbolic import SymbolicMesh, bits
from meshforge.synthesis import Demonstration
from meshforge.synthesis.replay import Replay, advanced, begun


def guesses(project: Project, asset: str, mesh: SymbolicMesh, program: Program) -> Guesses:
    """A guess for each rule of a program; mesh: the asset as it comes.

    Rules that were shown, or left out, on the asset do before the next ones what was shown. Raises ProgramError where
    the asset cannot be turned.
    """
    demo = Demonstration(mesh, project.steps(asset), asset)
    replay = begun(asset, demo, program.orient, program.contact)
    found = []
    for number, rule in enumerate(program.rules, 1):
        mask = select_mask(rule.extractor, replay.mesh, program.extremity or EXTREMITY)
        names = tuple(replay.mesh.hulls[k].name for k in sorted(bits(mask)))
        replay, problem = _next(project, replay, number, rule, program)
        found.append(
            Guess(
                rule=number,
                action=action_text(rule.action, rule.label),
                select=names,
                sentence=explain(rule),
                error=problem,
            )
        )
    return Guesses(asset=asset, guesses=tuple(found))


def _next(project: Project, replay: Replay, number: int, rule: Rule, program: Program) -> tuple[Replay, str | None]:
    """The replay after a rule; as it was, and why, where the rule cannot be done."""
    try:
        templates = project.templates(rule.action.templates)
        return advanced(replay, number, rule, templates, program.extremity), None
    except MeshForgeError as error:
        return replay, error.message
