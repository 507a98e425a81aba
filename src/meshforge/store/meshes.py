"""The assets of a project as the language sees them, prepared and labelled; their labels files."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from meshforge.batch import read_prepared
from meshforge.common import MeshForgeError, write_atomically
from meshforge.geometry import digest
from meshforge.symbolic import Label, LabelFile, SymbolicMesh, format_labels, match_labels, read_labels, transfer_labels


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


def read_meshes(ids: Iterable[str], files: Iterable[AssetFiles]) -> Iterator[tuple[str, SymbolicMesh]]:
    """Assets with their ids, one after the other; those that cannot be read are left out."""
    for asset, own in zip(ids, files, strict=True):
        try:
            yield asset, own.read_mesh()
        except MeshForgeError:
            continue


def hull_digests(mesh: SymbolicMesh) -> dict[str, str]:
    """The digests of all hulls of a mesh by name, in order."""
    return {hull.name: digest(hull.shape) for hull in mesh.hulls}


def write_labels(
    path: Path,
    hulls: Mapping[str, str],
    labels: Mapping[str, Label],
    vocabulary: Sequence[str],
    away: Collection[str] = (),
) -> None:
    """Write a labels file; labels of hulls that are gone stay in it, except for those of `away`."""
    present = {name: labels[name] for name in hulls if name in labels}
    text = format_labels(LabelFile(tuple(vocabulary), present, hulls))
    if gone := [name for name in match_labels(read_labels_file(path), hulls).gone if name not in away]:
        old, new = json.loads(path.read_text(encoding="utf-8")), json.loads(text)
        new["hulls"] |= {name: old["hulls"][name] for name in gone}
        new["vocabulary"] = list(dict.fromkeys([*new["vocabulary"], *old.get("vocabulary", [])]))
        text = json.dumps(new, ensure_ascii=False, indent=2) + "\n"
    write_atomically(path, text)
