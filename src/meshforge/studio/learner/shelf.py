"""The family in memory: each asset is read again only when its files, or what is done to it before, changed."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace

from meshforge.batch import source_files
from meshforge.errors import MeshForgeError
from meshforge.files import Times, times_of
from meshforge.preparation import RECORD
from meshforge.project import Project
from meshforge.symbolic import SymbolicMesh, follow_labels

LIFE = 64
"""Lessons after which memory is given back: each that meets a new rule leaves about 25 kB an asset (measured on tables
of 40 hulls), and the lesson after that takes some tenths of a second longer."""


class Stopped(Exception):  # noqa: N818 (not an error: nobody waits for the rest)
    """Reading was interrupted."""


@dataclass(frozen=True, eq=False, slots=True)
class _Kept:
    """An asset as it was read. times: of its files; labels: what their file holds; mesh: None where it cannot be read.

    contact: the threshold that was set.
    """

    times: Times
    contact: float | None
    labels: bytes
    mesh: SymbolicMesh | None


class Shelf:
    """The assets of a project, with the labels they have when they are asked for."""

    def __init__(self) -> None:
        self._entries: dict[str, _Kept] = {}
        self._runs = 0

    def read_meshes(
        self, project: Project, assets: Iterable[str], stop: Callable[[], bool]
    ) -> Iterator[tuple[str, SymbolicMesh]]:
        """Those of some assets that can be read, with their ids. Raises Stopped when `stop` says so."""
        contact = project.settings.thresholds.contact
        for asset in assets:
            if stop():
                raise Stopped
            kept = self._entries[asset] = self._update(project, asset, contact)
            if kept.mesh is not None:
                yield asset, kept.mesh

    def count_run(self) -> None:
        """Count a lesson. After many, what was worked out about the assets meanwhile is forgotten."""
        self._runs += 1
        if self._runs % LIFE == 0:
            self._entries = {asset: _renewed(kept) for asset, kept in self._entries.items()}

    def _update(self, project: Project, asset: str, contact: float | None) -> _Kept:
        kept, labels = self._entries.get(asset), _labels(project, asset)
        if kept is None or kept.contact != contact or times_of(kept.times) != kept.times:
            return _read(project, asset, contact, labels)
        if kept.labels == labels:
            return kept
        if kept.mesh is None:
            return _read(project, asset, contact, labels)
        return _Kept(kept.times, contact, labels, _labelled(project, asset, kept.mesh))


def _read(project: Project, asset: str, contact: float | None, labels: bytes) -> _Kept:
    path = project.path(asset)
    times = times_of([path, *source_files(path), project.layout.preparation(asset) / RECORD])
    try:
        mesh = project.mesh(asset)
    except MeshForgeError:
        return _Kept(times, contact, labels, None)
    referred = mesh.asset.files if mesh.asset else ()
    return _Kept(times_of(referred) | times, contact, labels, mesh)


def _renewed(kept: _Kept) -> _Kept:
    """The same with another mesh object; what was worked out about the old one goes with it."""
    return kept if kept.mesh is None else replace(kept, mesh=kept.mesh.with_hulls(kept.mesh.hulls))


def _labelled(project: Project, asset: str, mesh: SymbolicMesh) -> SymbolicMesh | None:
    """The mesh with the labels it has now; what was measured between its hulls stays known."""
    try:
        return follow_labels(project.labels(asset), mesh.with_labels(dict.fromkeys(mesh.index))).mesh
    except MeshForgeError:
        return None


def _labels(project: Project, asset: str) -> bytes:
    path = project.layout.labels(asset)
    return path.read_bytes() if path.exists() else b""
