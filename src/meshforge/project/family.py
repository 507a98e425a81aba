"""The assets that a program is learned from: which of very many, in memory, and which to demonstrate first."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from meshforge.common import MeshForgeError
from meshforge.project.review import find_accepted_results, pick_evenly
from meshforge.store import read_answers
from meshforge.symbolic import SymbolicMesh, transfer_labels
from meshforge.synthesis import choose_first_demonstration

if TYPE_CHECKING:
    from meshforge.project.project import Project


MOST_ASSETS = 400
"""Of more assets so many are looked at while a program is learned, besides those of which something was said: they are
all read and edited again after each answer. A variant that one asset in a hundred has is then missed once in fifty
times."""

MOST_COMPARED = 100
"""Of more assets so many are looked at, evenly over all: each has to be read."""


class FamilyMeshes:
    """Reads every asset once; labels are looked at anew each time, as answers change them."""

    def __init__(self, project: Project) -> None:
        self._project = project
        self._kept: dict[str, tuple[bytes, SymbolicMesh]] = {}

    def meshes(self) -> dict[str, SymbolicMesh]:
        """The assets to learn from that can be read, by id, with the labels they have now."""
        if not self._kept:
            rows = self._project.meshes_by_id(select_assets(self._project))
            self._kept = {asset: (self._labels(asset), mesh) for asset, mesh in rows}
        for asset, (before, mesh) in self._kept.items():
            now = self._labels(asset)
            if now != before:
                bare = mesh.with_labels(dict.fromkeys(mesh.index))
                self._kept[asset] = now, transfer_labels(self._project.labels(asset), bare).mesh
        return {asset: mesh for asset, (_, mesh) in self._kept.items()}

    def _labels(self, asset: str) -> bytes:
        path = self._project.layout.labels(asset)
        return path.read_bytes() if path.exists() else b""


def select_assets(project: Project) -> tuple[str, ...]:
    """The ids of the assets to learn from: all, or of very many those that something was said of, and some evenly."""
    every = project.assets()
    if len(every) <= MOST_ASSETS:
        return every
    said = {line.asset for line in read_answers(project).answers}
    said.update(find_accepted_results(project))
    said.update(asset for asset in every if project.layout.demonstration(asset).exists())
    said.update(pick_evenly(every, MOST_ASSETS))
    return tuple(asset for asset in every if asset in said)


def suggest_first_demonstration(project: Project, assets: Sequence[str]) -> str | None:
    """The id of the asset that tells most when it is demonstrated, None where there is nothing to choose by.

    assets: ids of those that come into question.
    """
    if len(assets) < 2:
        return next(iter(assets), None)
    meshes: dict[str, SymbolicMesh] = {}
    for asset in pick_evenly(assets, MOST_COMPARED):
        try:
            meshes[asset] = project.mesh(asset)
        except MeshForgeError:  # the status names it, with the reason
            continue
    settings = project.settings
    limits = settings.thresholds
    return choose_first_demonstration(
        meshes, settings.vocabulary, project.orientation, limits.contact, limits.extremity
    )
