"""A cache of meshes: an asset is read again once one of its files changed, its labels alone where only they did."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING

from meshforge.batch import read_prepared, record_digest, source_files
from meshforge.common import FileStates, MeshForgeError, file_states
from meshforge.symbolic import Asset, SymbolicMesh

if TYPE_CHECKING:
    from meshforge.store.store import Store

MOST_MESHES = 400
"""Meshes in memory; the one that was not asked for longest goes."""


@dataclass(frozen=True, eq=False, slots=True)
class _SourceMesh:
    """An asset as it was read. times: modification [ns] and size of its files; prepared: the digest of that."""

    times: FileStates
    record: str | None
    mesh: SymbolicMesh


@dataclass(frozen=True, eq=False, slots=True)
class _CacheEntry:
    """An asset with its labels. labels: what their file holds; contact: the threshold that was set."""

    source: _SourceMesh
    labels: bytes
    contact: float | None
    mesh: SymbolicMesh


class MeshCache:
    """The meshes of the assets that were asked for last.

    read: reads the asset at a path with its preparation, in this process or another; most: meshes in memory.
    """

    def __init__(self, read: Callable[[Path, Path], Asset] = read_prepared, most: int = MOST_MESHES) -> None:
        self._read_asset, self._most = read, most
        self._lock = Lock()
        self._busy: dict[str, Lock] = {}
        self._entries: OrderedDict[str, _CacheEntry] = OrderedDict()

    def get(self, store: Store, asset: str) -> SymbolicMesh:
        """An asset as it is prepared, with the labels it has now. Raises AssetError where it cannot be read."""
        path = store.path(asset)
        with self._lock:
            busy = self._busy.setdefault(asset, Lock())
        with busy:  # who asks for it at the same time waits for one reading
            with self._lock:
                cached = self._entries.get(asset)
            is_current = cached and _is_current(cached.source, store, asset)
            read = cached.source if cached and is_current else self._read(store, asset, path)
            entry = _apply_labels(store, asset, read, cached)
            with self._lock:
                self._entries[asset] = entry
                self._entries.move_to_end(asset)
                while len(self._entries) > self._most:
                    self._entries.popitem(last=False)
        return entry.mesh

    def _read(self, store: Store, asset: str, path: Path) -> _SourceMesh:
        folder = store.layout.preparation(asset)
        prepared, times = record_digest(folder), file_states([*source_files(path), path])
        try:
            source = self._read_asset(path, folder)
        except MeshForgeError as error:
            raise error.at(str(path)) from None
        return _SourceMesh(times | file_states(source.files), prepared, SymbolicMesh.of(source))


def _is_current(read: _SourceMesh, store: Store, asset: str) -> bool:
    folder = store.layout.preparation(asset)
    return record_digest(folder) == read.record and file_states(read.times) == read.times


def _apply_labels(store: Store, asset: str, read: _SourceMesh, cached: _CacheEntry | None) -> _CacheEntry:
    contact, labels = store.settings.thresholds.contact, store.label_bytes(asset)
    same_mesh = cached and cached.source is read and cached.contact == contact
    if cached and same_mesh and cached.labels == labels:
        return cached
    mesh = store.relabel(asset, cached.mesh if cached and same_mesh else read.mesh)
    wanted = mesh if contact is None or mesh.epsilon == contact else replace(mesh, epsilon=contact)
    return _CacheEntry(read, labels, contact, wanted)
