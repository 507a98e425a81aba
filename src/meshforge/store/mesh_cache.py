"""A cache of meshes: an asset is read again once one of its files changed, its labels alone where only they did."""

from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from threading import Lock

from meshforge import symbolic
from meshforge.batch import read_prepared, record_digest, source_files
from meshforge.common import FileStates, MeshForgeError, file_states
from meshforge.store.meshes import AssetFiles

MOST_MESHES = 400
"""Meshes in memory; the one that was not asked for longest goes."""


@dataclass(frozen=True, eq=False, slots=True)
class _CacheEntry:
    """An asset as it was read. times: modification [ns] and size of its files; record: the digest of its preparation;
    seen: the threshold set, and what is up; labels: what its files of labels and classes held; mesh: with these."""

    times: FileStates
    record: str | None
    seen: tuple[float | None, str | None]
    labels: tuple[bytes, ...]
    mesh: symbolic.SymbolicMesh


class MeshCache:
    """The meshes of the assets that were asked for last.

    read: reads the asset at a path with its preparation, in this process or another; most: meshes in memory.
    """

    def __init__(self, read: Callable[[Path, Path], symbolic.Asset] = read_prepared, most: int = MOST_MESHES) -> None:
        self._read_asset, self._most = read, most
        self._lock = Lock()
        self._busy: dict[Path, Lock] = {}
        self._entries: OrderedDict[Path, _CacheEntry] = OrderedDict()

    def get(self, files: AssetFiles) -> symbolic.SymbolicMesh:
        """Return an asset as it is prepared, with the labels it has now. Raises AssetError where it cannot be read."""
        with self._lock:
            busy = self._busy.setdefault(files.path, Lock())
        with busy:  # who asks for it at the same time waits for one reading
            with self._lock:
                cached = self._entries.get(files.path)
            entry = self._update(files, cached)
            with self._lock:
                self._entries[files.path] = entry
                self._entries.move_to_end(files.path)
                while len(self._entries) > self._most:
                    self._entries.popitem(last=False)
        return entry.mesh

    def renew(self) -> None:
        """Forget what was worked out about the meshes, not what they are."""
        with self._lock:
            for path, one in self._entries.items():
                self._entries[path] = replace(one, mesh=one.mesh.with_hulls(one.mesh.hulls))

    def _update(self, files: AssetFiles, cached: _CacheEntry | None) -> _CacheEntry:
        labels = tuple(path.read_bytes() if path.exists() else b"" for path in (files.labels, files.classes))
        record, seen = record_digest(files.preparation), (files.contact, files.up)
        is_current = cached and (cached.record, cached.seen) == (record, seen)
        if not cached or not is_current or file_states(cached.times) != cached.times:
            times = file_states([*source_files(files.path), files.path])
            try:
                source = self._read_asset(files.path, files.preparation)
            except MeshForgeError as error:
                raise error.at(str(files.path)) from None
            times |= file_states(source.files)
            cached = _CacheEntry(times, record, seen, (b"", b""), files.to_mesh(source))
        if cached.labels == labels:
            return cached
        plain = cached.mesh.with_labels(dict.fromkeys(cached.mesh.index))
        return replace(cached, labels=labels, mesh=symbolic.transfer_labels(files.read_labels(), plain).mesh)
