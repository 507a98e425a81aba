"""Labels of a few assets carried to all others of the project."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from typing import TYPE_CHECKING

from meshforge.batch import Lost, isolated
from meshforge.errors import MeshForgeError, ProjectError, StoppedError
from meshforge.project.labels.found import write_found
from meshforge.project.labels.labelling import Labelled
from meshforge.symbolic import Label, SymbolicMesh

if TYPE_CHECKING:
    from meshforge.perception import Propagated
    from meshforge.project.project import Project

Keeping = Callable[[str | None], AbstractContextManager[object]]
"""The block in which labels are written, when all is known; given the asset that would help most."""


@dataclass(frozen=True, slots=True)
class Carried:
    """What became of each asset, and which one would help most if it were labelled next; None: all are."""

    reports: tuple[Labelled, ...]
    next: str | None


def propagate(
    project: Project,
    progress: Callable[[], None] | None = None,
    stop: Callable[[], bool] | None = None,
    keeping: Keeping = nullcontext,
) -> Carried:
    """Carry labels to all hulls that have none, or one that a machine was less sure of.

    stop: asked often whether to end before anything is written; keeping: the block in which all is written.
    Raises ProjectError: no vocabulary, or no label to begin with; StoppedError when it was told to stop.
    """
    vocabulary = project.vocabulary
    if not vocabulary:
        remedy = "Say first what hulls can be: --vocabulary a,b,c."
        raise ProjectError("the vocabulary is empty", where=str(project.folder), remedy=remedy)
    meshes, broken = _read(project, vocabulary, progress, stop)
    found = _found(list(meshes.values()), stop)
    ids = list(meshes)
    best = next((ids[place] for place in found.next_to_label()), None)
    if not found.family.labels:
        remedy = f"Label the hulls of one asset first, best {best}." if best else "Decompose the assets first."
        raise ProjectError(
            "there is no label that others could be taken from", where=str(project.folder), remedy=remedy
        )
    with keeping(best):
        rows = enumerate(meshes.items())
        reports = {
            asset: write_found(project, asset, mesh, _named(mesh, found.labels(place))) for place, (asset, mesh) in rows
        }
    return Carried(tuple((reports | broken)[asset] for asset in project.assets()), best)


def _found(meshes: Sequence[SymbolicMesh], stop: Callable[[], bool] | None) -> Propagated:
    """What labels say about all hulls; in a process of its own where that may have to be stopped in the midst."""
    from meshforge.perception import propagate as carried  # scipy's search for neighbours takes a while to load

    (found,) = isolated(carried, [meshes], workers=1 if stop else 0, stop=stop)
    if isinstance(found, Lost):
        raise MeshForgeError(f"the labels could not be carried over: {found.why}")
    return found


def _read(
    project: Project,
    vocabulary: Sequence[str],
    progress: Callable[[], None] | None,
    stop: Callable[[], bool] | None,
) -> tuple[dict[str, SymbolicMesh], dict[str, Labelled]]:
    """All assets with those of their labels that are in the vocabulary; a report on each that cannot be read."""
    meshes, broken = dict[str, SymbolicMesh](), dict[str, Labelled]()
    for asset in project.assets():
        if stop and stop():
            raise StoppedError("carrying labels over was stopped")
        try:
            mesh = project.mesh(asset)
            odd = {name: None for name, label in mesh.labels.items() if label.name not in vocabulary}
            meshes[asset] = mesh.labelled(odd)
        except MeshForgeError as error:
            broken[asset] = Labelled(asset, problems=(error.message,))
        if progress:
            progress()
    return meshes, broken


def _named(mesh: SymbolicMesh, found: Sequence[Label | None]) -> dict[str, Label]:
    """Labels by hull; found: those of all hulls."""
    return {hull.name: label for hull, label in zip(mesh.hulls, found, strict=True) if label}
