"""The assets of a project in memory, while several lessons in a row are learned from them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.project.answering import answers
from meshforge.project.evenly import evenly
from meshforge.project.reviewing import accepted_results
from meshforge.symbolic import SymbolicMesh, follow_labels

if TYPE_CHECKING:
    from meshforge.project.project import Project

MOST = 400
"""Of more assets so many are looked at while a program is learned, besides those of which something was said: they are
all read and edited again after each answer. A variant that one asset in a hundred has is then missed once in fifty
times."""


class Family:
    """Reads every asset once; labels are looked at anew each time, as answers change them."""

    def __init__(self, project: Project) -> None:
        self._project = project
        self._kept: dict[str, tuple[bytes, SymbolicMesh]] = {}

    def meshes(self) -> dict[str, SymbolicMesh]:
        """The assets to learn from that can be read, by id, with the labels they have now."""
        if not self._kept:
            rows = self._project.meshes_by_id(looked_at(self._project))
            self._kept = {asset: (self._labels(asset), mesh) for asset, mesh in rows}
        for asset, (before, mesh) in self._kept.items():
            now = self._labels(asset)
            if now != before:
                bare = mesh.with_labels(dict.fromkeys(mesh.index))
                self._kept[asset] = now, follow_labels(self._project.labels(asset), bare).mesh
        return {asset: mesh for asset, (_, mesh) in self._kept.items()}

    def _labels(self, asset: str) -> bytes:
        path = self._project.layout.labels(asset)
        return path.read_bytes() if path.exists() else b""


def looked_at(project: Project) -> tuple[str, ...]:
    """The ids of the assets to learn from: all, or of very many those that something was said of, and some evenly."""
    every = project.assets()
    if len(every) <= MOST:
        return every
    said = {line.asset for line in answers(project).answers}
    said.update(accepted_results(project))
    said.update(asset for asset in every if project.layout.demonstration(asset).exists())
    said.update(evenly(every, MOST))
    return tuple(asset for asset in every if asset in said)
