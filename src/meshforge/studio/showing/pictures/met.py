"""Pictures of assets as a rule of a program meets them, for questions and repairs."""

from __future__ import annotations

import json

from meshforge.language import Program
from meshforge.project import Project
from meshforge.studio.showing.pictures.thumbnail import thumbnail
from meshforge.studio.showing.shapes import Z_FROM_Y, framed, stands_on_y
from meshforge.symbolic import SymbolicMesh

SIZE = (720, 540)


def met(project: Project, asset: str, mesh: SymbolicMesh, rule: int, program: Program | None) -> bytes:
    """A packet: the names of the hulls in order, and a picture encoded as a thumbnail.

    mesh: the asset as it comes; program: None for one without rules, which only turns it.
    Raises MeshForgeError where the asset cannot be turned, or an action fails.
    """
    plan = program or Program(orient=project.orientation)
    seen = project.mesh_before_rule(asset, rule, plan, {asset: mesh})
    pose = Z_FROM_Y if stands_on_y(mesh, plan.orient) else None
    header = json.dumps({"names": [hull.name for hull in seen.hulls]})
    return framed(header.encode(), thumbnail(seen, pose, SIZE))
