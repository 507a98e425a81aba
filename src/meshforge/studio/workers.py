"""Worker processes in which a crash is one error, and a cache of the meshes that they read."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from concurrent.futures import Future, TimeoutError
from dataclasses import dataclass, field, replace
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING, ParamSpec, TypeVar

from meshforge.batch import AssetSet, count_processors, read_prepared, record_digest, source_files, worker_context
from meshforge.common import FileStates, MeshForgeError, file_states
from meshforge.project import Project
from meshforge.symbolic import Asset, SymbolicMesh, transfer_labels

if TYPE_CHECKING:
    from pebble import ProcessPool


Params = ParamSpec("Params")
Result = TypeVar("Result")

WORK_TIMEOUT = 300.0
"""Seconds for one piece of work: far above what is usual, so that only a hang is stopped."""

MOST_MESHES = 80
"""Assets that are kept; the one that was not asked for longest goes."""


class Workers:
    """Some worker processes, started with the first work."""

    def __init__(self, count: int | None = None, timeout: float = WORK_TIMEOUT) -> None:
        self.count = count or count_processors()
        self._timeout = timeout
        self._lock = Lock()
        self._pool: ProcessPool | None = None
        self._closed = False

    def start(self, function: Callable[Params, Result], *args: Params.args, **kwargs: Params.kwargs) -> Future[Result]:
        """Begin some work. Its result raises what the function raises; see `wait_for`."""
        from pebble import ProcessPool

        with self._lock:
            if self._closed:
                raise MeshForgeError("the studio is being closed")
            self._pool = self._pool or ProcessPool(max_workers=self.count, context=worker_context())
            future: Future[Result] = self._pool.schedule(function, args=args, kwargs=kwargs, timeout=self._timeout)
        return future

    def run(self, function: Callable[Params, Result], *args: Params.args, **kwargs: Params.kwargs) -> Result:
        """Do some work and wait for it. Raises what the function raises, MeshForgeError where its process died."""
        return wait_for(self.start(function, *args, **kwargs))

    def close(self) -> None:
        """Stop all work at once."""
        with self._lock:
            pool, self._pool, self._closed = self._pool, None, True
        if pool:
            pool.stop()  # type: ignore[no-untyped-call]  # pebble has no types
            pool.join()


def project_of_one(project: Project, asset: str) -> Project:
    """The same project with one asset, for a worker process."""
    return Project(project.folder, AssetSet(project.found.base, (project.path(asset),)))


def wait_for(future: Future[Result]) -> Result:
    """The result of some work. Raises MeshForgeError where its process died, or took too long."""
    from pebble import ProcessExpired

    try:
        return future.result()
    except ProcessExpired as error:
        raise MeshForgeError(f"the process that worked on this died (exit code {error.exitcode})") from None
    except TimeoutError:
        raise MeshForgeError("this took too long and was stopped") from None


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
    """The assets of a project that were asked for last."""

    def __init__(self, workers: Workers) -> None:
        self._workers = workers
        self._lock = Lock()
        self._busy: dict[str, Lock] = {}
        self._entries: OrderedDict[str, _CacheEntry] = OrderedDict()

    def get(self, project: Project, asset: str) -> SymbolicMesh:
        """An asset as it is prepared, with the labels it has now. Raises AssetError where it cannot be read."""
        path = project.path(asset)
        with self._lock:
            busy = self._busy.setdefault(asset, Lock())
        with busy:  # who asks for it at the same time waits for one reading
            with self._lock:
                kept = self._entries.get(asset)
            read = (
                kept.source if kept and _is_current(kept.source, project, asset) else self._read(project, asset, path)
            )
            labelled = _apply_labels(project, asset, read, kept)
            with self._lock:
                self._entries[asset] = labelled
                self._entries.move_to_end(asset)
                while len(self._entries) > MOST_MESHES:
                    self._entries.popitem(last=False)
        return labelled.mesh

    def _read(self, project: Project, asset: str, path: Path) -> _SourceMesh:
        folder = project.layout.preparation(asset)
        prepared, times = record_digest(folder), file_states([*source_files(path), path])
        try:
            source: Asset = self._workers.run(read_prepared, path, folder)
        except MeshForgeError as error:
            raise error.at(str(path)) from None
        return _SourceMesh(times | file_states(source.files), prepared, SymbolicMesh.of(source))


@dataclass(frozen=True)
class ProjectWithCache(Project):
    """A project whose assets stay in memory, so that what is done to one need not read its files again."""

    mesh_cache: MeshCache = field(repr=False, compare=False)

    @staticmethod
    def of(project: Project, meshes: MeshCache) -> ProjectWithCache:
        """The same project with a memory."""
        return ProjectWithCache(project.folder, project.found, meshes)

    def with_assets(self, found: AssetSet) -> ProjectWithCache:
        """The same project with other assets."""
        return replace(self, found=found)

    def mesh(self, asset: str) -> SymbolicMesh:
        return self.mesh_cache.get(self, asset)


def _is_current(read: _SourceMesh, project: Project, asset: str) -> bool:
    folder = project.layout.preparation(asset)
    return record_digest(folder) == read.record and file_states(read.times) == read.times


def _apply_labels(project: Project, asset: str, read: _SourceMesh, kept: _CacheEntry | None) -> _CacheEntry:
    contact, path = project.settings.thresholds.contact, project.layout.labels(asset)
    labels = path.read_bytes() if path.exists() else b""
    if kept and kept.source is read and kept.labels == labels and kept.contact == contact:
        return kept
    bare = _remove_labels(kept.mesh) if kept and kept.source is read and kept.contact == contact else read.mesh
    mesh = transfer_labels(project.labels(asset), bare).mesh
    wanted = mesh if contact is None or mesh.epsilon == contact else replace(mesh, epsilon=contact)
    return _CacheEntry(read, labels, contact, wanted)


def _remove_labels(mesh: SymbolicMesh) -> SymbolicMesh:
    """The mesh without labels; what was measured between its hulls stays known."""
    return mesh.with_labels(dict.fromkeys(mesh.index))
