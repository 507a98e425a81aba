"""Labels of hulls that other hulls take the place of: each new hull takes the label of what it lies in."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from meshforge.geometry import Shape, digest, overlap_volume
from meshforge.project.labels.labelling import digests, write_merged
from meshforge.symbolic import Hull, Label, SymbolicMesh, follow_labels
from meshforge.words import listed

if TYPE_CHECKING:
    from meshforge.project.project import Project

_MOST = 0.5  # a hull takes a label that more than this share of what it overlaps has
_ALL = 0.99  # from here on it is that hull, or a part of it, and the label is as sure as it was


@dataclass(frozen=True, eq=False, slots=True)
class Relabelled:
    """The labels of an asset whose hulls change. mesh: the new hulls with theirs; gone: names of old ones."""

    project: Project
    asset: str
    mesh: SymbolicMesh
    gone: tuple[str, ...]
    notes: tuple[str, ...]

    def write(self, *, keep_old: bool) -> None:
        """Write the labels; keep_old: those of hulls that go stay beside them."""
        project, mesh, away = self.project, self.mesh, () if keep_old else self.gone
        write_merged(project, self.asset, digests(mesh), mesh.labels, project.vocabulary, away)


def relabelled(project: Project, asset: str, old: Mapping[str, Shape], mesh: SymbolicMesh) -> Relabelled | None:
    """The labels where hulls `old`, by name, become those of a mesh; None where no label is concerned."""
    file = project.labels(asset)
    here = digests(mesh)
    were = {name: digest(shape) for name, shape in old.items()}
    gone = {name: old[name] for name in file.labels if name in old and here.get(name) != were[name]}
    if not gone:
        return None
    labels = {name: file.labels[name] for name in gone}
    fresh = {h.name: _label(h, gone, labels) for h in mesh.hulls if were.get(h.name) != here[h.name]}
    rest = replace(file, labels={n: label for n, label in file.labels.items() if n not in gone})
    followed = follow_labels(rest, mesh).mesh
    taken = {name: label for name, label in fresh.items() if label and not followed.hull_of(name).annotation}
    notes = [f"labels of {listed([*gone])} went to {listed([*taken])}"] if taken else []
    lost = sorted({label.name for label in labels.values()} - {label.name for label in taken.values()})
    notes += [f"no hull takes over the label {listed(lost)}"] if lost else []
    away = tuple(name for name in gone if name not in taken)
    return Relabelled(project, asset, followed.with_labels(taken), away, tuple(notes))


def _label(hull: Hull, gone: Mapping[str, Shape], labels: Mapping[str, Label]) -> Label | None:
    """The label of most of what a hull overlaps, as sure as that is most."""
    common = {name: overlap_volume(hull.shape, shape) for name, shape in gone.items()}
    covered = sum(common.values())
    if not covered > 0:
        return None
    shares: dict[str, float] = {}
    for name, volume in common.items():
        shares[labels[name].name] = shares.get(labels[name].name, 0.0) + volume / covered
    best = max(shares, key=lambda label: shares[label])
    if shares[best] <= _MOST:
        return None
    heir = labels[max((n for n in gone if labels[n].name == best), key=lambda n: common[n])]
    certain = shares[best] >= _ALL
    return heir if certain else Label(best, heir.confidence * min(shares[best], 1.0), "propagated")
