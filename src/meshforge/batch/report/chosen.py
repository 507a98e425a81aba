"""The assets that a report shows of very many, chosen as they come."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from itertools import chain
from typing import Generic, TypeVar

from meshforge.batch.summary import SHOWN

Item = TypeVar("Item")


class Chosen(Generic[Item]):
    """The first of the lowest ranks, never more than `most` at a time; in order of ranks, then as they came."""

    def __init__(self, most: int = SHOWN) -> None:
        self._most = most
        self._kept = 0
        self._ranks: defaultdict[int, list[Item]] = defaultdict(list)

    def add(self, rank: int, item: Item) -> None:
        """Keep one more, or not; rank: the lower, the sooner it is shown."""
        self._ranks[rank].append(item)
        self._kept += 1
        if self._kept > self._most:
            last = max(rank for rank, items in self._ranks.items() if items)
            self._ranks[last].pop()
            self._kept -= 1

    def __iter__(self) -> Iterator[Item]:
        return chain.from_iterable(self._ranks[rank] for rank in sorted(self._ranks))
