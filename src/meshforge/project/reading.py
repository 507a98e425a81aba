"""The assets of a project as the language sees them: prepared and labelled."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.errors import MeshForgeError
from meshforge.preparation import read_prepared
from meshforge.symbolic import LabelFile, SymbolicMesh, follow_labels, read_labels

if TYPE_CHECKING:
    from meshforge.project.project import Project


@dataclass(frozen=True, slots=True)
class Place:
    """What one asset is read from, in this process or another; contact: the threshold, None for the language's own."""

    path: Path
    preparation: Path
    labels: Path
    contact: float | None

    def read_mesh(self) -> SymbolicMesh:
        """The asset as it is prepared, with its labels. Raises AssetError where it cannot be read."""
        source = read_prepared(self.path, self.preparation)
        labelled = follow_labels(kept_labels(self.labels), SymbolicMesh.of(source)).mesh
        return labelled if self.contact is None else replace(labelled, epsilon=self.contact)


def kept_labels(path: Path) -> LabelFile:
    """The labels of an asset as they are kept; empty where there are none."""
    return read_labels(path) if path.exists() else LabelFile()


def places(project: Project, assets: Iterable[str]) -> tuple[Place, ...]:
    """Those of some assets."""
    layout, contact = project.layout, project.settings.thresholds.contact
    return tuple(
        Place(project.path(asset), layout.preparation(asset), layout.labels(asset), contact) for asset in assets
    )


def mesh(project: Project, asset: str) -> SymbolicMesh:
    """An asset as it is prepared, with its labels. Raises AssetError where it cannot be read."""
    (place,) = places(project, [asset])
    return place.read_mesh()


def named_meshes(project: Project, assets: Sequence[str]) -> Iterator[tuple[str, SymbolicMesh]]:
    """Assets with their ids, one after the other; those that cannot be read are left out."""
    for asset, place in zip(assets, places(project, assets), strict=True):
        try:
            yield asset, place.read_mesh()
        except MeshForgeError:
            continue
