"""Assets in memory: read in worker processes, so that a crash of a reader is one message, and kept while they last."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass, field, replace
from pathlib import Path
from threading import Lock

from meshforge.asset import Asset
from meshforge.batch import Found, source_files
from meshforge.errors import MeshForgeError
from meshforge.files import Times, times_of
from meshforge.preparation import read_prepared, record_digest
from meshforge.project import Project
from meshforge.studio.workers import Workers
from meshforge.symbolic import SymbolicMesh, follow_labels

MOST = 80
"""Assets that are kept; the one that was not asked for longest goes."""


@dataclass(frozen=True, eq=False, slots=True)
class _Read:
    """An asset as it was read. times: modification [ns] and size of its files; prepared: the digest of that."""

    times: Times
    record: str | None
    mesh: SymbolicMesh


@dataclass(frozen=True, eq=False, slots=True)
class _Labelled:
    """An asset with its labels. labels: what their file holds; contact: the threshold that was set."""

    source: _Read
    labels: bytes
    contact: float | None
    mesh: SymbolicMesh


class Meshes:
    """The assets of a project that were asked for last."""

    def __init__(self, workers: Workers) -> None:
        self._workers = workers
        self._lock = Lock()
        self._busy: dict[str, Lock] = {}
        self._entries: OrderedDict[str, _Labelled] = OrderedDict()

    def get(self, project: Project, asset: str) -> SymbolicMesh:
        """An asset as it is prepared, with the labels it has now. Raises AssetError where it cannot be read."""
        path = project.path(asset)
        with self._lock:
            busy = self._busy.setdefault(asset, Lock())
        with busy:  # who asks for it at the same time waits for one reading
            with self._lock:
                kept = self._entries.get(asset)
            read = kept.source if kept and _holds(kept.source, project, asset) else self._read(project, asset, path)
            labelled = _labelled(project, asset, read, kept)
            with self._lock:
                self._entries[asset] = labelled
                self._entries.move_to_end(asset)
                while len(self._entries) > MOST:
                    self._entries.popitem(last=False)
        return labelled.mesh

    def _read(self, project: Project, asset: str, path: Path) -> _Read:
        folder = project.layout.preparation(asset)
        prepared, times = record_digest(folder), times_of([*source_files(path), path])
        try:
            source: Asset = self._workers.run(read_prepared, path, folder)
        except MeshForgeError as error:
            raise error.at(str(path)) from None
        return _Read(times | times_of(source.files), prepared, SymbolicMesh.of(source))


@dataclass(frozen=True)
class KeptProject(Project):
    """A project whose assets stay in memory, so that what is done to one need not read its files again."""

    mesh_cache: Meshes = field(repr=False, compare=False)

    @staticmethod
    def of(project: Project, meshes: Meshes) -> KeptProject:
        """The same project with a memory."""
        return KeptProject(project.folder, project.found, meshes)

    def with_assets(self, found: Found) -> KeptProject:
        """The same project with other assets."""
        return replace(self, found=found)

    def mesh(self, asset: str) -> SymbolicMesh:
        return self.mesh_cache.get(self, asset)


def _holds(read: _Read, project: Project, asset: str) -> bool:
    folder = project.layout.preparation(asset)
    return record_digest(folder) == read.record and times_of(read.times) == read.times


def _labelled(project: Project, asset: str, read: _Read, kept: _Labelled | None) -> _Labelled:
    contact, path = project.settings.thresholds.contact, project.layout.labels(asset)
    labels = path.read_bytes() if path.exists() else b""
    if kept and kept.source is read and kept.labels == labels and kept.contact == contact:
        return kept
    bare = _bare(kept.mesh) if kept and kept.source is read and kept.contact == contact else read.mesh
    mesh = follow_labels(project.labels(asset), bare).mesh
    wanted = mesh if contact is None or mesh.epsilon == contact else replace(mesh, epsilon=contact)
    return _Labelled(read, labels, contact, wanted)


def _bare(mesh: SymbolicMesh) -> SymbolicMesh:
    """The mesh without labels; what was measured between its hulls stays known."""
    return mesh.with_labels(dict.fromkeys(mesh.index))
