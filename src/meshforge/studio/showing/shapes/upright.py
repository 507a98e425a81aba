"""How an asset is turned to be shown: into the canonical frame, with Z up."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from meshforge.errors import MeshForgeError
from meshforge.geometry import Floats, Pose
from meshforge.language import Orient, orient_mesh
from meshforge.project import Project
from meshforge.symbolic import SymbolicMesh

Z_FROM_Y = Pose(np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), np.zeros(3))
"""Brings the Y axis up to Z."""


@dataclass(frozen=True, eq=False, slots=True)
class Upright:
    """pose: shown_T_incoming; problem: why the orientation of the project does not turn the asset."""

    pose: Pose
    problem: str | None = None


def upright(project: Project, mesh: SymbolicMesh) -> Upright:
    """How an asset of a project is shown: as the orientation turns it, then with what is up along Z.

    Z is up where the orientation names it; else that axis is which the file says points up.
    """
    orient = project.orientation
    try:
        turn, problem = orient_mesh(mesh, orient)[1], None
    except MeshForgeError as error:
        turn, problem, orient = Pose.identity(), error.sentence, None
    return Upright(Z_FROM_Y @ turn if stands_on_y(mesh, orient) else turn, problem)


def stands_on_y(mesh: SymbolicMesh, orient: Orient | None) -> bool:
    """Whether Y is still what points up after an orientation: the file says so, and no landmark says what +Z is."""
    named = orient is not None and any(pair.axis.endswith("Z") for pair in orient.pairs)
    return not named and mesh.asset is not None and mesh.asset.up == "y"


def numbers(pose: Pose) -> tuple[float, ...] | None:
    """The 16 numbers of a pose row by row, None for the identity."""
    matrix: Floats = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = pose.rotation, pose.translation
    return None if np.array_equal(matrix, np.eye(4)) else tuple(matrix.ravel().tolist())
