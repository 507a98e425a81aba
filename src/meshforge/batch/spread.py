"""How work on many assets is spread over worker processes, and what one asset may take of time and memory."""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass

from meshforge.batch.memory import share
from meshforge.batch.pool import Item, Lost, Result, isolated, processors

TIMEOUT = 600.0
"""Seconds for one asset: far above the slowest real one, so that only a hang is stopped."""


@dataclass(frozen=True, slots=True)
class Spread:
    """All as of `isolated`; timeout [s] and memory [bytes] for one asset, an even share of the machine's when None."""

    workers: int | None = None
    timeout: float | None = TIMEOUT
    memory: int | None = None
    stop: Callable[[], bool] | None = None

    def over(
        self, function: Callable[[Item], Result], items: Sequence[Item], done: Callable[[], None] | None = None
    ) -> Generator[Result | Lost, None, None]:
        """The results of `function` on the items, in their order. Raises as `isolated`."""
        memory = self.memory or share(min(self.workers or processors(), len(items)))
        return isolated(
            function, items, workers=self.workers, timeout=self.timeout, memory=memory, done=done, stop=self.stop
        )


HERE = Spread(workers=0)
"""In this process, one asset after the other: nothing has to be started, and nothing is bounded."""
