"""The assets of a project in memory, while several lessons in a row are learned from them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.symbolic import SymbolicMesh, follow_labels

if TYPE_CHECKING:
    from meshforge.project.project import Project


class Family:
    """Reads every asset once; labels are looked at anew each time, as answers change them."""

    def __init__(self, project: Project) -> None:
        self._project = project
        self._kept: dict[str, tuple[bytes, SymbolicMesh]] = {}

    def meshes(self) -> dict[str, SymbolicMesh]:
        """All assets that can be read, by id, with the labels they have now."""
        if not self._kept:
            self._kept = {asset: (self._labels(asset), mesh) for asset, mesh in self._project.named_meshes()}
        for asset, (before, mesh) in self._kept.items():
            now = self._labels(asset)
            if now != before:
                bare = mesh.labelled(dict.fromkeys(mesh.index))
                self._kept[asset] = now, follow_labels(self._project.labels(asset), bare).mesh
        return {asset: mesh for asset, (_, mesh) in self._kept.items()}

    def _labels(self, asset: str) -> bytes:
        path = self._project.layout.labels(asset)
        return path.read_bytes() if path.exists() else b""
