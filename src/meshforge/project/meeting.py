"""An asset as a rule meets it: turned, and edited by the rules before."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from meshforge.language import Program
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Demonstration
from meshforge.synthesis.replay import advanced, begun

if TYPE_CHECKING:
    from meshforge.project.project import Project


def met(
    project: Project, asset: str, rule: int, program: Program, meshes: Mapping[str, SymbolicMesh] | None = None
) -> SymbolicMesh:
    """The asset before a rule of a program, rules counted from 1; where a demonstration shows a step, after that step.

    meshes: as of `Project.synthesize`. Raises MeshForgeError where the asset cannot be turned, or an action fails.
    """
    mesh = (meshes or {}).get(asset) or project.mesh(asset)
    replay = begun(asset, Demonstration(mesh, project.steps(asset), asset), program.orient, program.contact)
    templates = project.templates(program.templates)
    for number, line in enumerate(program.rules[: rule - 1], 1):
        replay = advanced(replay, number, line, templates, program.extremity)
    return replay.mesh
