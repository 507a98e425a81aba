"""How work on many assets is executed: options, in this process, in worker processes here, or on a Ray cluster."""

import logging
import math
import sys
from collections import deque
from collections.abc import Callable, Generator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from meshforge.batch import workers as processes
from meshforge.batch.workers import ExecutionOptions, Item, Result, WorkerFailure, run_isolated
from meshforge.common import MeshForgeError, Plugin, PluginKind, adopt_plugins, collect_plugins
from meshforge.common.processes import memory_share

ITEMS_A_CHUNK = 32
"""Items for each processor of a chunk: a node that dies costs the work on so many, which another one does again."""
_CHUNKS_AHEAD = 2  # chunks handed out for each that can be worked on
_MOST_RETRIES = 5  # nodes that may die under one chunk


def execute(
    function: Callable[[Item], Result], items: Sequence[Item], options: ExecutionOptions
) -> Generator[Result | WorkerFailure, None, None]:
    """Return the results of `function` on the items, in their order, from wherever `options` has them computed.

    Workers of this machine share its memory evenly where no bound is given. Raises as `run_isolated` and
    `run_on_cluster`.
    """
    if options.backend == "ray":
        return run_on_cluster(function, items, options)
    if options.memory is None:
        share = memory_share(min(options.workers or processes.count_processors(), len(items)))
        options = replace(options, memory=share)
    return run_isolated(function, items, options)


def run_on_cluster(
    function: Callable[[Item], Result], items: Sequence[Item], options: ExecutionOptions = processes.UNBOUNDED
) -> Generator[Result | WorkerFailure, None, None]:
    """Yield the results of `function` on the items, in their order, computed on all nodes of a cluster.

    The cluster is that of RAY_ADDRESS, else one that runs on this machine, else one that is started here for as long as
    this takes. MeshForge and the files of the assets have to be on every node, under the same paths. Here `workers` are
    processes in all, and `memory` is that of each, an even share of its node's when None. A chunk whose node dies is
    done again on another.
    Raises MeshForgeError where Ray is not installed or no cluster answers, and what `run_isolated` raises.
    """
    ray, ours = _connect()
    waiting: deque[tuple[Any, int]] = deque()
    try:
        cores, every = _count_cores(ray)
        workers = options.workers or every
        cores = min(cores, workers)
        at_once = max(1, min(workers, every) // cores)
        remote = ray.remote(_run_chunk).options(num_cpus=cores, max_retries=_MOST_RETRIES, scheduling_strategy="SPREAD")
        length = max(1, min(ITEMS_A_CHUNK * cores, math.ceil(len(items) / (at_once * _CHUNKS_AHEAD))))
        starts, plugins = iter(range(0, len(items), length)), collect_plugins()
        while True:
            while len(waiting) < at_once * _CHUNKS_AHEAD and (start := next(starts, None)) is not None:
                chunk = list(items[start : start + length])
                waiting.append(
                    (remote.remote(function, chunk, cores, options.timeout, options.memory, plugins), len(chunk))
                )
            if not waiting:
                break
            task, count = waiting[0]
            while not ray.wait([task], timeout=processes.POLL_SECONDS)[0]:
                processes.raise_if_stopped(options.stop)
            waiting.popleft()
            for result in _collect_chunk(ray, task, count):
                if options.progress:
                    options.progress()
                yield result
    finally:  # also when the caller stops early, or on Ctrl-C
        for task, _ in waiting:
            ray.cancel(task, force=True)
        if ours:
            ray.shutdown()


def _connect() -> tuple[Any, bool]:
    """Ray, connected to a cluster, and whether this connection was made here."""
    try:
        import ray  # lazy: an extra, which takes a second
    except ImportError as error:
        remedy = "Install it: pip install 'meshforge[ray]'."
        raise MeshForgeError("the backend ray needs Ray, which is not installed", remedy=remedy) from error
    if ray.is_initialized():
        return ray, False
    try:
        ray.init(log_to_driver=False, logging_level=logging.ERROR, include_dashboard=False)
    except (ConnectionError, RuntimeError, OSError, ValueError) as error:
        remedy = "Start one with `ray start --head`, and set RAY_ADDRESS where it is on another machine."
        raise MeshForgeError(f"no Ray cluster answers: {error}", remedy=remedy) from error
    return ray, True


def _count_cores(ray: Any) -> tuple[int, int]:
    counts = [int(node["Resources"].get("CPU", 0)) for node in ray.nodes() if node["Alive"]]
    counts = [count for count in counts if count]
    if not counts:
        raise MeshForgeError("the Ray cluster has no processors", remedy="Start its nodes with --num-cpus.")
    return min(counts), sum(counts)


def _run_chunk(
    function: Callable[[Item], Result],
    items: list[Item],
    workers: int,
    timeout: float | None,
    memory: int | None,
    plugins: Mapping[PluginKind, tuple[Plugin, ...]],
) -> list[Result | WorkerFailure]:
    """Runs on a node, in a process of Ray's; the workers that it starts need not load Ray's main module first."""
    adopt_plugins(plugins)
    vars(sys.modules["__main__"]).pop("__file__", None)
    return list(run_isolated(function, items, ExecutionOptions(workers, timeout, memory or memory_share(workers))))


def _collect_chunk(ray: Any, task: Any, count: int) -> list[Any]:
    """The results of a chunk; all of it is lost where one node after the other died under it."""
    try:
        return list(ray.get(task))
    except MeshForgeError:
        raise
    except ray.exceptions.RayError as error:
        why = str(error).strip().splitlines()[0]
        return [WorkerFailure(f"the nodes of the cluster that worked on it died ({why})")] * count
