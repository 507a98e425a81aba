"""Putting one preparation of an asset in the place of another: hulls, and the labels that follow them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.asset import Asset
from meshforge.errors import AssetError, MeshForgeError, ProjectError
from meshforge.formats import read
from meshforge.geometry import Shape
from meshforge.geometry.decompose import DecomposeSettings, cache_folder
from meshforge.preparation import (
    Preparation,
    Replaced,
    fitting,
    prepared,
    read_preparation,
    record_digest,
    remove_preparation,
    split_hull,
    write_preparation,
)
from meshforge.project.demonstrating import astray
from meshforge.project.labels.relabelling import relabelled
from meshforge.symbolic import SymbolicMesh
from meshforge.words import listed

if TYPE_CHECKING:
    from meshforge.project.project import Project


@dataclass(frozen=True, slots=True)
class Prepared:
    """What became of one asset.

    made: the pieces that got hulls now; notes: what that means for labels and demonstrations, and what was given up;
    problems: why a piece, or the whole asset, could not be prepared; undone: what was taken back, in words.
    """

    asset: str
    made: tuple[Replaced, ...] = ()
    notes: tuple[str, ...] = ()
    problems: tuple[str, ...] = ()
    undone: tuple[str, ...] = ()

    @property
    def hulls(self) -> tuple[str, ...]:
        """The names of all hulls that were made."""
        return tuple(name for entry in self.made for name in entry.made)


def change(project: Project, asset: str, make: Callable[[Asset, Preparation], Preparation]) -> Prepared:
    """Do one thing more to an asset. make: its preparation with that, of the asset as it was read and that before."""
    folder = project.layout.preparation(asset)
    seen = record_digest(folder)
    before = read_preparation(folder) or Preparation()
    after = make(read(project.path(asset)), before)
    notes = exchanged(project, asset, after, seen)
    added = after.steps[len(before.steps) :]
    return Prepared(asset, tuple(entry for step in added for entry in step.replaced), tuple(notes))


def split(project: Project, asset: str, hull: str, settings: DecomposeSettings, hollow: bool) -> Prepared:
    """Split a hull by a decomposition of what its body shows."""

    def make(source: Asset, before: Preparation) -> Preparation:
        return split_hull(source, before, hull, settings, hollow=hollow, cache=cache_folder())

    return change(project, asset, make)


def unprepare(project: Project, asset: str, everything: bool) -> Prepared:
    """Take back the last thing that was done to an asset, or everything. Raises ProjectError where nothing was.

    What is kept for an asset that is gone, or cannot be read, can be taken back as a whole.
    """
    if asset not in project.layout.ids_with_preparation():
        project.path(asset)
    folder = project.layout.preparation(asset)
    seen = record_digest(folder)
    if seen is None:
        raise ProjectError("nothing was done to it that could be taken back", where=asset)
    before = _readable(folder) if everything else read_preparation(folder) or Preparation()
    left = 0 if everything else len(before.steps) - 1
    notes = exchanged(project, asset, before.with_only(before.steps[:left]), seen)
    undone = tuple(map(str, before.steps[left:])) or ("what was kept, which was damaged",)
    return Prepared(asset, undone=undone, notes=tuple(notes))


def _readable(folder: Path) -> Preparation:
    """The preparation in a folder, an empty one where there is none or a damaged one."""
    try:
        return read_preparation(folder) or Preparation()
    except AssetError:
        return Preparation()


def exchanged(project: Project, asset: str, after: Preparation, seen: str | None) -> list[str]:
    """Write a preparation in the place of the one of a known digest. Raises ProjectError where that is another now."""
    with project.lock():
        if record_digest(project.layout.preparation(asset)) != seen:
            raise ProjectError("someone else has prepared it meanwhile", where=asset, remedy="Try again.")
        return _exchange(project, asset, after)


def _hulls(source: Asset, folder: Path) -> dict[str, Shape]:
    """The hulls of an asset by name as they are prepared, those of an outdated preparation too.

    A hull that a step puts others in the place of is none of them, whether or not that step still fits the asset.
    """
    before = _readable(folder)
    made = {name: before.hulls[known] for name, known in before.hull_digests.items()}
    there = made | {geom.name: geom.shape for geom in fitting(source, before).asset.geoms}
    return {name: shape for name, shape in there.items() if name not in before.hulls_replaced}


def _exchange(project: Project, asset: str, after: Preparation) -> list[str]:
    """Write a preparation, under the lock that the caller holds, and let labels follow; notes on what that means.

    Labels of the new hulls are written before these, and labels of the old hulls go after them: killed in between,
    labels of hulls that are not there are left, which is harmless.
    """
    folder = project.layout.preparation(asset)
    try:
        source = read(project.path(asset))
    except MeshForgeError as error:
        if after.steps:
            raise
        remove_preparation(folder)
        return [f"its labels stay as they are: {error.problem}"] if project.layout.labels(asset).exists() else []
    mesh = SymbolicMesh.of(prepared(source, after))
    follow = relabelled(project, asset, _hulls(source, folder), mesh)
    if follow:
        follow.write(keep_old=True)
    if after.steps:
        write_preparation(folder, after)
    else:
        remove_preparation(folder)
    if follow:
        follow.write(keep_old=False)
    gone = sorted({name for _, name in astray(project.steps(asset), mesh.index)})
    notes = list(follow.notes) if follow else []
    if gone:
        notes.append(f"the demonstration on it names {listed(gone)}, which it has no more: demonstrate it anew")
    return notes
