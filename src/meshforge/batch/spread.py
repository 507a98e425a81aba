"""Where the work of a batch is done: on this machine, or on a cluster. Results are the same."""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from typing import Literal, TypeVar

from meshforge.batch.cluster import on_cluster
from meshforge.batch.memory import share
from meshforge.batch.pool import Lost, isolated, processors

Item = TypeVar("Item")
Result = TypeVar("Result")

Backend = Literal["local", "ray"]
TIMEOUT = 600.0
"""Seconds for one asset: far above the slowest real one, so that only a hang is stopped."""


def spread(
    backend: Backend,
    function: Callable[[Item], Result],
    items: Sequence[Item],
    *,
    workers: int | None = None,
    timeout: float | None = TIMEOUT,
    memory: int | None = None,
    done: Callable[[], None] | None = None,
    stop: Callable[[], bool] | None = None,
) -> Generator[Result | Lost, None, None]:
    """The results of `function` on the items, in their order, as of `isolated` or of `on_cluster`.

    memory: bytes for one item; None is an even share of what the machine has.
    """
    work = on_cluster if backend == "ray" else isolated
    if backend == "local" and memory is None:
        memory = share(min(workers or processors(), len(items)))
    return work(function, items, workers=workers, timeout=timeout, memory=memory, done=done, stop=stop)
