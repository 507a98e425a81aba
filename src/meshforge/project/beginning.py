"""The asset to demonstrate first."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from meshforge.errors import MeshForgeError
from meshforge.project.evenly import evenly
from meshforge.synthesis import most_telling

if TYPE_CHECKING:
    from meshforge.project.project import Project
    from meshforge.symbolic import SymbolicMesh

MOST = 100
"""Of more assets so many are looked at, evenly over all: each has to be read."""


def first_to_show(project: Project, assets: Sequence[str]) -> str | None:
    """The id of the asset that tells most when it is demonstrated, None where there is nothing to choose by.

    assets: ids of those that come into question.
    """
    if len(assets) < 2:
        return next(iter(assets), None)
    meshes: dict[str, SymbolicMesh] = {}
    for asset in evenly(assets, MOST):
        try:
            meshes[asset] = project.mesh(asset)
        except MeshForgeError:  # the status names it, with the reason
            continue
    settings = project.settings
    limits = settings.thresholds
    return most_telling(meshes, settings.vocabulary, project.orientation, limits.contact, limits.extremity)
