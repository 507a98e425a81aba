"""The assets of a project as the language sees them, prepared and labelled; their labels files."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.batch import read_prepared
from meshforge.common import MeshForgeError, write_atomically
from meshforge.geometry import digest
from meshforge.symbolic import Label, LabelFile, SymbolicMesh, format_labels, match_labels, read_labels, transfer_labels

if TYPE_CHECKING:
    from meshforge.project import Project


@dataclass(frozen=True, slots=True)
class AssetFiles:
    """What one asset is read from, in this process or another; contact: the threshold, None for the language's own."""

    path: Path
    preparation: Path
    labels: Path
    contact: float | None

    def read_mesh(self) -> SymbolicMesh:
        """The asset as it is prepared, with its labels. Raises AssetError where it cannot be read."""
        source = read_prepared(self.path, self.preparation)
        labelled = transfer_labels(read_labels_file(self.labels), SymbolicMesh.of(source)).mesh
        return labelled if self.contact is None else replace(labelled, epsilon=self.contact)


def read_labels_file(path: Path) -> LabelFile:
    """The labels of an asset as they are kept; empty where there are none."""
    return read_labels(path) if path.exists() else LabelFile()


def asset_files_of(project: Project, assets: Iterable[str]) -> tuple[AssetFiles, ...]:
    """Those of some assets."""
    layout, contact = project.layout, project.settings.thresholds.contact
    return tuple(
        AssetFiles(project.path(asset), layout.preparation(asset), layout.labels(asset), contact) for asset in assets
    )


def read_mesh(project: Project, asset: str) -> SymbolicMesh:
    """An asset as it is prepared, with its labels. Raises AssetError where it cannot be read."""
    (place,) = asset_files_of(project, [asset])
    return place.read_mesh()


def read_named_meshes(project: Project, assets: Sequence[str]) -> Iterator[tuple[str, SymbolicMesh]]:
    """Assets with their ids, one after the other; those that cannot be read are left out."""
    for asset, place in zip(assets, asset_files_of(project, assets), strict=True):
        try:
            yield asset, place.read_mesh()
        except MeshForgeError:
            continue


def hull_digests(mesh: SymbolicMesh) -> dict[str, str]:
    """The digests of all hulls of a mesh by name, in order."""
    return {hull.name: digest(hull.shape) for hull in mesh.hulls}


def write_labels(
    project: Project,
    asset: str,
    hulls: Mapping[str, str],
    labels: Mapping[str, Label],
    vocabulary: Sequence[str],
    away: Collection[str] = (),
) -> None:
    """Write labels of an asset; those of hulls that are gone stay in the file, since hulls may come back.

    hulls: the digests of all, by name, in order; away: names of hulls that are gone whose labels do not stay.
    """
    path = project.layout.labels(asset)
    present = {name: labels[name] for name in hulls if name in labels}
    text = format_labels(LabelFile(tuple(vocabulary), present, hulls))
    if gone := [name for name in match_labels(project.labels(asset), hulls).gone if name not in away]:
        old, new = json.loads(path.read_text(encoding="utf-8")), json.loads(text)
        new["hulls"] |= {name: old["hulls"][name] for name in gone}
        new["vocabulary"] = list(dict.fromkeys([*new["vocabulary"], *old.get("vocabulary", [])]))
        text = json.dumps(new, ensure_ascii=False, indent=2) + "\n"
    write_atomically(path, text)
