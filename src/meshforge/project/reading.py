"""The assets of a project as the language sees them: prepared and labelled."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from meshforge.errors import MeshForgeError
from meshforge.preparation import read_prepared
from meshforge.symbolic import SymbolicMesh, follow_labels

if TYPE_CHECKING:
    from meshforge.project.project import Project


def mesh(project: Project, asset: str) -> SymbolicMesh:
    """An asset as it is prepared, with its labels. Raises AssetError where it cannot be read."""
    source = read_prepared(project.path(asset), project.layout.preparation(asset))
    labelled = follow_labels(project.labels(asset), SymbolicMesh.of(source)).mesh
    contact = project.settings.thresholds.contact
    return labelled if contact is None else replace(labelled, epsilon=contact)


def named_meshes(project: Project, assets: Iterable[str]) -> Iterator[tuple[str, SymbolicMesh]]:
    """Assets with their ids, one after the other; those that cannot be read are left out."""
    for asset in assets:
        try:
            yield asset, mesh(project, asset)
        except MeshForgeError:
            continue
