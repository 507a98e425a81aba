"""The worklist of the search: partial programs, the simplest first."""

from __future__ import annotations

from collections import deque

from meshforge.synthesis.paper.partial import Partial, nodes


class Worklist:
    """Partial programs by syntactic complexity; of those as complex, the first put in comes out first.

    One queue a size gives the order of a heap and keeps no keys: there are millions of entries.
    max_size: what is larger is not taken in.
    """

    def __init__(self, max_size: int) -> None:
        self._queues: list[deque[Partial]] = [deque() for _ in range(max_size + 1)]

    def put(self, partial: Partial) -> None:
        size = nodes(partial)
        if size < len(self._queues):
            self._queues[size].append(partial)

    def pop(self) -> tuple[int, Partial] | None:
        """The simplest with its size, None when there is none left."""
        for size, queue in enumerate(self._queues):
            if queue:
                return size, queue.popleft()
        return None
