"""A bell that is heard in another process: work that was begun before it rang comes to its end."""

from __future__ import annotations

import mmap
import os
import struct
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Literal, get_args

Kind = Literal["lesson", "reach", "generalise"]
KINDS: tuple[Kind, ...] = get_args(Kind)

_COUNT = struct.Struct("<q")


@dataclass(frozen=True, slots=True)
class Ticket:
    """What a piece of work takes with it: of which kind it is, and how often the bell had rung for that."""

    path: Path
    kind: Kind
    count: int

    @property
    def stop(self) -> Callable[[], bool]:
        """Whether the bell has rung since."""
        counts, place = _shared(self.path), KINDS.index(self.kind) * _COUNT.size
        return lambda: int(_COUNT.unpack_from(counts, place)[0]) != self.count


class Bell:
    """Counts, in a small file that processes share, how often it rang for each kind of work."""

    def __init__(self) -> None:
        handle, name = tempfile.mkstemp(prefix="meshforge-", suffix=".bell")
        os.write(handle, bytes(_COUNT.size * len(KINDS)))
        self.path = Path(name)
        self._counts = mmap.mmap(handle, 0)
        os.close(handle)

    def cancel(self, *kinds: Kind) -> None:
        """End the work of some kinds that is going on."""
        for kind in kinds:
            _COUNT.pack_into(self._counts, self._offset_of(kind), self._count_of(kind) + 1)

    def make_token(self, kind: Kind) -> Ticket:
        """The ticket of work that begins now."""
        return Ticket(self.path, kind, self._count_of(kind))

    def close(self) -> None:
        """Take the file away."""
        self._counts.close()
        self.path.unlink(missing_ok=True)

    def _count_of(self, kind: Kind) -> int:
        return int(_COUNT.unpack_from(self._counts, self._offset_of(kind))[0])

    def _offset_of(self, kind: Kind) -> int:
        return KINDS.index(kind) * _COUNT.size


@cache
def _shared(path: Path) -> mmap.mmap:
    with path.open("rb") as file:
        return mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
