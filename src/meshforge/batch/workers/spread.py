"""How work on many assets is spread over worker processes, here or on a cluster, and what one asset may take."""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass
from typing import Literal

from meshforge.batch.workers.cluster import on_cluster
from meshforge.batch.workers.memory import share
from meshforge.batch.workers.pool import Item, Lost, Result, isolated, processors

Backend = Literal["local", "ray"]
TIMEOUT = 600.0
"""Seconds for one asset: far above the slowest real one, so that only a hang is stopped."""


@dataclass(frozen=True, slots=True)
class Spread:
    """All as of `isolated`; timeout [s] and memory [bytes] for one asset, an even share of the machine's when None.

    backend: the workers of this machine, or those of a Ray cluster, as of `on_cluster`. Results are the same.
    """

    workers: int | None = None
    timeout: float | None = TIMEOUT
    memory: int | None = None
    stop: Callable[[], bool] | None = None
    backend: Backend = "local"

    def run(
        self, function: Callable[[Item], Result], items: Sequence[Item], done: Callable[[], None] | None = None
    ) -> Generator[Result | Lost, None, None]:
        """The results of `function` on the items, in their order. Raises as `isolated` and `on_cluster`."""
        memory, work = self.memory, on_cluster if self.backend == "ray" else isolated
        if self.backend == "local" and memory is None:
            memory = share(min(self.workers or processors(), len(items)))
        return work(
            function, items, workers=self.workers, timeout=self.timeout, memory=memory, done=done, stop=self.stop
        )


HERE = Spread(workers=0)
"""In this process, one asset after the other: nothing has to be started, and nothing is bounded."""
