"""Demonstrated meshes in the frames that are tried, without measuring a distance twice."""

from __future__ import annotations

from dataclasses import replace

from meshforge.language import Orient, orient_mesh
from meshforge.symbolic import SymbolicMesh
from meshforge.symbolic.contact import NEAR_MISS

_WIDEST = 2.0
"""No turn makes the diagonal of a mesh longer than 3 ** 0.5 times, so no contact distance either."""


class Turning:
    """One mesh as the first rule sees it under any directive; contact: the program's epsilon, None keeps the mesh's.

    The same as `stage` of the language, but the distances, which no turn changes, are measured once.
    """

    def __init__(self, mesh: SymbolicMesh, contact: float | None) -> None:
        epsilon = mesh.epsilon if contact is None else contact
        self._mesh = replace(mesh, epsilon=epsilon)
        self._wide = replace(mesh, epsilon=epsilon * _WIDEST, scale=None)

    def turn(self, orient: Orient | None) -> tuple[SymbolicMesh, bytes]:
        """The mesh in the frame of a directive, and a key that turns have in common when they are the same.

        Raises ProgramError where the orientation fails.
        """
        oriented, pose = orient_mesh(self._mesh, orient)
        staged = replace(oriented, scale=oriented.diagonal)
        reach = staged.contact_distance * NEAR_MISS
        staged.__dict__["graph"] = {pair: gap for pair, gap in self._wide.graph.items() if gap <= reach}
        return staged, (pose.rotation.round(9) + 0.0).tobytes()
