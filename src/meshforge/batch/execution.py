"""How work on many assets is executed: options, in this process, in worker processes here, or on a Ray cluster."""

from __future__ import annotations

import logging
import math
import sys
from collections import deque
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from meshforge.batch.workers import (
    POLL_SECONDS,
    Item,
    Result,
    WorkerFailure,
    count_processors,
    memory_share,
    raise_if_stopped,
    run_isolated,
)
from meshforge.common import MeshForgeError

Backend = Literal["local", "ray"]
TIMEOUT = 600.0
"""Seconds for one asset: far above the slowest real one, so that only a hang is stopped."""

ITEMS_A_CHUNK = 32
"""Items for each processor of a chunk: a node that dies costs the work on so many, which another one does again."""
_CHUNKS_AHEAD = 2  # chunks handed out for each that can be worked on
_MOST_RETRIES = 5  # nodes that may die under one chunk


@dataclass(frozen=True, slots=True)
class ExecutionOptions:
    """All as of `run_isolated`; timeout [s] and memory [bytes] for one asset, an even share of the machine's when None.

    backend: the workers of this machine, or those of a Ray cluster, as of `run_on_cluster`. Results are the same.
    """

    workers: int | None = None
    timeout: float | None = TIMEOUT
    memory: int | None = None
    stop: Callable[[], bool] | None = None
    backend: Backend = "local"

    def run(
        self, function: Callable[[Item], Result], items: Sequence[Item], done: Callable[[], None] | None = None
    ) -> Generator[Result | WorkerFailure, None, None]:
        """The results of `function` on the items, in their order. Raises as `run_isolated` and `run_on_cluster`."""
        memory, work = self.memory, run_on_cluster if self.backend == "ray" else run_isolated
        if self.backend == "local" and memory is None:
            memory = memory_share(min(self.workers or count_processors(), len(items)))
        return work(
            function, items, workers=self.workers, timeout=self.timeout, memory=memory, done=done, stop=self.stop
        )


IN_PROCESS = ExecutionOptions(workers=0)
"""In this process, one asset after the other: nothing has to be started, and nothing is bounded."""


def run_on_cluster(
    function: Callable[[Item], Result],
    items: Sequence[Item],
    *,
    workers: int | None = None,
    timeout: float | None = None,
    memory: int | None = None,
    done: Callable[[], None] | None = None,
    stop: Callable[[], bool] | None = None,
) -> Generator[Result | WorkerFailure, None, None]:
    """The results of `function` on the items, in their order, as of `run_isolated`, computed on all nodes of a cluster.

    The cluster is that of RAY_ADDRESS, else one that runs on this machine, else one that is started here for as long as
    this takes. MeshForge and the files of the assets have to be on every node, under the same paths. workers: processes
    in all; memory: bytes for each, an even share of its node's when None. A chunk whose node dies is done again on
    another. Raises MeshForgeError where Ray is not installed or no cluster answers, and what `run_isolated` raises.
    """
    ray, ours = _connect()
    waiting: deque[tuple[Any, int]] = deque()
    try:
        cores, every = _count_cores(ray)
        cores = min(cores, workers or cores)
        at_once = max(1, (min(workers, every) if workers else every) // cores)
        remote = ray.remote(_run_chunk).options(num_cpus=cores, max_retries=_MOST_RETRIES, scheduling_strategy="SPREAD")
        length = max(1, min(ITEMS_A_CHUNK * cores, math.ceil(len(items) / (at_once * _CHUNKS_AHEAD))))
        starts = iter(range(0, len(items), length))
        while True:
            while len(waiting) < at_once * _CHUNKS_AHEAD and (start := next(starts, None)) is not None:
                chunk = list(items[start : start + length])
                waiting.append((remote.remote(function, chunk, cores, timeout, memory), len(chunk)))
            if not waiting:
                break
            task, count = waiting[0]
            while not ray.wait([task], timeout=POLL_SECONDS)[0]:
                raise_if_stopped(stop)
            waiting.popleft()
            for result in _collect_chunk(ray, task, count):
                if done:
                    done()
                yield result
    finally:  # also when the caller stops early, or on Ctrl-C
        for task, _ in waiting:
            ray.cancel(task, force=True)
        if ours:
            ray.shutdown()


def _connect() -> tuple[Any, bool]:
    """Ray, connected to a cluster, and whether this connection was made here."""
    try:
        import ray
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
    """The processors of the smallest node that has any, and of all nodes."""
    counts = [int(node["Resources"].get("CPU", 0)) for node in ray.nodes() if node["Alive"]]
    counts = [count for count in counts if count]
    if not counts:
        raise MeshForgeError("the Ray cluster has no processors", remedy="Start its nodes with --num-cpus.")
    return min(counts), sum(counts)


def _run_chunk(
    function: Callable[[Item], Result], items: list[Item], workers: int, timeout: float | None, memory: int | None
) -> list[Result | WorkerFailure]:
    """Runs on a node, in a process of Ray's; the workers that it starts need not load Ray's main module first."""
    vars(sys.modules["__main__"]).pop("__file__", None)
    bound = memory or memory_share(workers)
    return list(run_isolated(function, items, workers=workers, timeout=timeout, memory=bound))


def _collect_chunk(ray: Any, task: Any, count: int) -> list[Any]:
    """The results of a chunk; all of it is lost where one node after the other died under it."""
    try:
        return list(ray.get(task))
    except MeshForgeError:
        raise
    except ray.exceptions.RayError as error:
        why = str(error).strip().splitlines()[0]
        return [WorkerFailure(f"the nodes of the cluster that worked on it died ({why})")] * count
