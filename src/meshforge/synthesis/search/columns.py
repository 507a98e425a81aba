"""An index over many bit sets that finds, in a few operations, all that hold one set and avoid another."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np


class Columns:
    """Bit sets ("rows") kept by position: column p is the set of the rows that have bit p.

    Answers are sets of rows, bit k for row k.
    """

    __slots__ = ("_columns", "every")

    def __init__(self, rows: Sequence[int], width: int) -> None:
        self.every = (1 << len(rows)) - 1
        self._columns = _transposed(rows, width)

    def rows_with(self, need: int, among: int) -> int:
        """The rows of `among` that have every bit of `need`."""
        for p in positions(need):
            if not among:
                break
            among &= self._columns[p]
        return among

    def rows_without(self, avoid: int, among: int) -> int:
        """The rows of `among` that have no bit of `avoid`."""
        for p in positions(avoid):
            if not among:
                break
            among &= ~self._columns[p]
        return among


def positions(mask: int) -> Iterator[int]:
    """The set bits, lowest first."""
    while mask:
        low = mask & -mask
        yield low.bit_length() - 1
        mask ^= low


def _transposed(rows: Sequence[int], width: int) -> list[int]:
    if not rows:
        return [0] * width
    size = (width + 7) // 8
    packed = np.frombuffer(b"".join(row.to_bytes(size, "little") for row in rows), np.uint8).reshape(len(rows), size)
    table = np.unpackbits(packed, axis=1, count=width, bitorder="little")
    columns = np.packbits(table.T, axis=1, bitorder="little")
    return [int.from_bytes(column.tobytes(), "little") for column in columns]
