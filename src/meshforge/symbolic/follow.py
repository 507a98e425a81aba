"""Labels on an asset that may have changed since: they follow hulls that were merely renamed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass

from meshforge.geometry import digest
from meshforge.symbolic.label_file import LabelFile
from meshforge.symbolic.labels import Label
from meshforge.symbolic.mesh import SymbolicMesh


@dataclass(frozen=True, eq=False, slots=True)
class Homes:
    """Where the labels of a file belong. labels: by the name that the hull has now.

    changed: hulls that keep name and label, with other geometry than was labelled; renamed: old and new names of
    hulls that the label followed; gone: names in the file that no hull answers to. All in the file's order.
    """

    labels: Mapping[str, Label]
    changed: tuple[str, ...] = ()
    renamed: tuple[tuple[str, str], ...] = ()
    gone: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False, slots=True)
class Followed:
    """A mesh with the labels of a file; changed, renamed, gone: as of `Homes`."""

    mesh: SymbolicMesh
    changed: tuple[str, ...] = ()
    renamed: tuple[tuple[str, str], ...] = ()
    gone: tuple[str, ...] = ()


def follow_labels(file: LabelFile, mesh: SymbolicMesh) -> Followed:
    """The mesh with the labels of the file, in the places that `label_homes` gives them."""
    homes = label_homes(file, {hull.name: digest(hull.shape) if file.digests else "" for hull in mesh.hulls})
    return Followed(mesh.with_labels(homes.labels), homes.changed, homes.renamed, homes.gone)


def label_homes(file: LabelFile, hulls: Mapping[str, str]) -> Homes:
    """Where labels belong among hulls, given as digests by name; hulls are known again by name and by digest.

    A label stays with its name. Where the name is gone, or has other geometry, it goes to the one hull that has the
    digest, provided that the file gives that digest once; so the labels of a renumbered file move with their hulls.
    """
    moved = _moved(file, hulls)
    claimed = set(moved.values())
    labels: dict[str, Label] = {}
    changed, gone = [], []
    for name, label in file.labels.items():
        home = moved.get(name, name if name in hulls and name not in claimed else None)
        if home is None:
            gone.append(name)
            continue
        labels[home] = label
        if home == name and file.digests.get(name, hulls[name]) != hulls[name]:
            changed.append(name)
    return Homes(labels, tuple(changed), tuple(moved.items()), tuple(gone))


def _moved(file: LabelFile, here: Mapping[str, str]) -> dict[str, str]:
    """The new name of each labelled hull that has another one now."""
    authored = Counter(file.digests.values())
    present = Counter(here.values())
    names = {geometry: name for name, geometry in here.items()}
    return {
        name: names[geometry]
        for name, geometry in file.digests.items()
        if here.get(name) != geometry and authored[geometry] == present[geometry] == 1
    }
