"""Worker processes in which a crash is one error, and a cache of the meshes that they read."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from concurrent.futures import CancelledError, Future, TimeoutError
from dataclasses import dataclass, field, replace
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar
from weakref import WeakSet

from meshforge.batch import AssetSet, count_processors, read_prepared, record_digest, server_context, source_files
from meshforge.common import FileStates, MeshForgeError, StoppedError, file_states
from meshforge.project import Project
from meshforge.symbolic import Asset, SymbolicMesh

if TYPE_CHECKING:
    from pebble import ProcessPool


Params = ParamSpec("Params")
Result = TypeVar("Result")

WORK_TIMEOUT = 300.0
"""Seconds for one piece of work: far above what is usual, so that only a hang is stopped."""

MOST_MESHES = 80
"""Meshes in memory; the one that was not asked for longest goes."""


class Workers:
    """Some worker processes, started with the first call."""

    def __init__(self, count: int | None = None, timeout: float = WORK_TIMEOUT) -> None:
        self.count = count or count_processors()
        self._timeout = timeout
        self._lock = Lock()
        self._pool: ProcessPool | None = None
        self._closed = False
        self._futures: WeakSet[Future[Any]] = WeakSet()

    def start(self, function: Callable[Params, Result], *args: Params.args, **kwargs: Params.kwargs) -> Future[Result]:
        """Start some work. Its result raises what the function raises; see `wait_for`."""
        from pebble import ProcessPool  # lazy: 0.1 s, and processes that unpickle work of this module need none

        with self._lock:
            if self._closed:
                raise MeshForgeError("the studio is being closed")
            self._pool = self._pool or ProcessPool(max_workers=self.count, context=server_context())
            future: Future[Result] = self._pool.schedule(function, args=args, kwargs=kwargs, timeout=self._timeout)
            self._futures.add(future)
        return future

    def run(self, function: Callable[Params, Result], *args: Params.args, **kwargs: Params.kwargs) -> Result:
        """Do some work and wait for it. Raises what the function raises, MeshForgeError where its process died."""
        return wait_for(self.start(function, *args, **kwargs))

    def close(self) -> None:
        """Stop all work at once."""
        with self._lock:
            pool, self._pool, self._closed = self._pool, None, True
            futures = list(self._futures)
        for future in futures:  # a pool that is stopped leaves who waits for it waiting
            future.cancel()
        if pool:
            pool.stop()  # type: ignore[no-untyped-call]  # pebble has no types
            pool.join()


def future_of(result: Result) -> Future[Result]:
    """A future that has its result already."""
    future: Future[Result] = Future()
    future.set_result(result)
    return future


def project_of_one(project: Project, asset: str) -> Project:
    """The same project with one asset, for a worker process."""
    return Project(project.folder, replace(project.found, paths=(project.path(asset),)))


def wait_for(future: Future[Result]) -> Result:
    """The result of some work. Raises MeshForgeError where its process died, took too long or was stopped."""
    from pebble import ProcessExpired  # lazy: as above

    try:
        return future.result()
    except CancelledError:
        raise StoppedError("the studio is being closed") from None
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
    """The meshes of the assets that were asked for last."""

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
                cached = self._entries.get(asset)
            is_current = cached and _is_current(cached.source, project, asset)
            read = cached.source if cached and is_current else self._read(project, asset, path)
            entry = _apply_labels(project, asset, read, cached)
            with self._lock:
                self._entries[asset] = entry
                self._entries.move_to_end(asset)
                while len(self._entries) > MOST_MESHES:
                    self._entries.popitem(last=False)
        return entry.mesh

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
    """A project whose meshes stay in memory, so that an edit need not read the files of its asset again."""

    mesh_cache: MeshCache = field(repr=False, compare=False)

    @staticmethod
    def of(project: Project, meshes: MeshCache) -> ProjectWithCache:
        """A project whose meshes are cached."""
        return ProjectWithCache(project.folder, project.found, meshes)

    def with_assets(self, found: AssetSet) -> ProjectWithCache:
        """The same project with other assets."""
        return replace(self, found=found)

    def mesh(self, asset: str) -> SymbolicMesh:
        return self.mesh_cache.get(self, asset)


def _is_current(read: _SourceMesh, project: Project, asset: str) -> bool:
    folder = project.layout.preparation(asset)
    return record_digest(folder) == read.record and file_states(read.times) == read.times


def _apply_labels(project: Project, asset: str, read: _SourceMesh, cached: _CacheEntry | None) -> _CacheEntry:
    contact, labels = project.settings.thresholds.contact, project.label_bytes(asset)
    same_mesh = cached and cached.source is read and cached.contact == contact
    if cached and same_mesh and cached.labels == labels:
        return cached
    mesh = project.relabel(asset, cached.mesh if cached and same_mesh else read.mesh)
    wanted = mesh if contact is None or mesh.epsilon == contact else replace(mesh, epsilon=contact)
    return _CacheEntry(read, labels, contact, wanted)
