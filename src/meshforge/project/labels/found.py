"""Writing the labels that a machine found for an asset, beside what its labels are by then."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from meshforge.project.labels.labelling import Labelled, merged, write_merged
from meshforge.symbolic import GIVEN_SOURCES, Label, SymbolicMesh, follow_labels

if TYPE_CHECKING:
    from meshforge.project.project import Project


def write_found(project: Project, asset: str, mesh: SymbolicMesh, found: Mapping[str, Label]) -> Labelled:
    """Write those labels, by hull of the mesh, that may be taken: they may have been looked for for a long time."""
    with project.lock():
        now = follow_labels(project.labels(asset), mesh.labelled(dict.fromkeys(mesh.index))).mesh
        given = {name: label for name, label in found.items() if gives_way(now.named(name).annotation, label)}
        labelled, report = merged(asset, now, given, project.vocabulary)
        if report.taken:
            write_merged(project, asset, labelled)
    return report


def gives_way(current: Label | None, given: Label) -> bool:
    """Whether a label may be replaced: an earlier one of that machine, or one that another was less sure of."""
    if current is None or current.source == given.source:
        return True
    return current.source not in GIVEN_SOURCES and current.confidence < given.confidence
