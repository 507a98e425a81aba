"""Bytes of a binary layer, read in order and never beyond their end; what is packed in them by LZ4."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_DENSEST = 255  # bytes that one byte can stand for, by LZ4
_COST = 16  # bytes of memory that the library takes for one number while it unpacks it, about
_FREE = 1 << 28
_TIMES = 16
_SIZES = np.array([0, 1, 2, 4])  # bytes of a number by its code; 0: the one that is met most
_FEWER = "its numbers are fewer than it says"


class ContradictionError(Exception):
    """The bytes contradict themselves; the message says how."""


class ExcessError(Exception):
    """More than any asset needs; the message says of what."""


class Allowance:
    """What a file may cost: memory for what it unpacks to, and steps over its bytes."""

    def __init__(self, size: int) -> None:
        self.memory = max(_FREE, _TIMES * size)
        self.steps = 4 * size

    def take(self, numbers: int) -> None:
        """Count numbers that are unpacked. Raises ExcessError where they are too many for a file of this size."""
        self.memory -= _COST * numbers
        if self.memory < 0:
            raise ExcessError("it unpacks to far more than its size")


class Bytes:
    """A place in the data, which goes on with what is read. Raises ContradictionError beyond the end."""

    def __init__(self, data: bytes, at: int, allowance: Allowance, end: int | None = None) -> None:
        self.data, self.at, self.allowance = data, at, allowance
        self.end = len(data) if end is None else end

    def skip(self, count: int, size: int = 1) -> int:
        """Go on by so many things of so many bytes; where they began."""
        start, self.at = self.at, self.at + count * size
        self.allowance.steps -= count * size
        if start < 0 or self.at > self.end or count < 0:
            raise ContradictionError("what it lists lies outside of it")
        if self.allowance.steps < 0:
            raise ContradictionError("its parts lie over each other")
        return start

    def read_number(self, size: int = 8) -> int:
        """An unsigned number."""
        return int.from_bytes(self.data[self.skip(size) : self.at], "little")

    def unpack(self, size: int, most: int) -> bytes:
        """So many bytes, unpacked: at most so many."""
        start = self.skip(size)
        if not size:
            return b""
        blocks, at = self.data[start], start + 1
        if not blocks:
            return self._unpack_block(at, self.at, most)
        parts = []
        for _ in range(blocks):
            length = int.from_bytes(self.data[at : at + 4], "little", signed=True)
            if length < 0 or at + 4 + length > self.at:
                raise ContradictionError("what is packed in it lies outside of it")
            parts.append(self._unpack_block(at + 4, at + 4 + length, most))
            at, most = at + 4 + length, most - len(parts[-1])
        return b"".join(parts)

    def _unpack_block(self, start: int, end: int, most: int) -> bytes:
        import lz4.block

        room = min(most, _DENSEST * (end - start) + 64)
        self.allowance.take(room // _COST)
        try:
            return bytes(lz4.block.decompress(self.data[start:end], uncompressed_size=room))
        except (lz4.block.LZ4BlockError, ValueError) as error:
            raise ContradictionError("what is packed in it cannot be unpacked") from error

    def read_integers(self, count: int) -> NDArray[np.int32]:
        """(count,) numbers of four bytes, coded by their differences and packed."""
        self.allowance.take(count)
        codes = (count + 3) // 4
        coded = self.unpack(self.read_number(), 4 + codes + 4 * count)
        letters = np.frombuffer(coded, np.uint8)
        if len(coded) < 4 + codes:
            raise ContradictionError(_FEWER)
        kinds = ((letters[4 : 4 + codes, None] >> np.array([0, 2, 4, 6], np.uint8)) & 3).reshape(-1)[:count]
        sizes = _SIZES[kinds]
        places = 4 + codes + np.cumsum(sizes) - sizes
        if count and places[-1] + sizes[-1] > len(coded):
            raise ContradictionError(_FEWER)
        steps = np.full(count, int.from_bytes(coded[:4], "little", signed=True), np.int64)
        for kind, number in enumerate((np.int8, np.int16, np.int32), 1):
            which = np.flatnonzero(kinds == kind)
            own = letters[places[which, None] + np.arange(_SIZES[kind])]
            steps[which] = np.ascontiguousarray(own).view(number).reshape(-1)
        return np.cumsum(steps).astype(np.int32)

    def skip_integers(self, count: int) -> None:
        """Go over numbers that are coded and packed, as many as such bytes can stand for."""
        self.allowance.take(count)
        size = self.read_number()
        self.skip(size)
        if count > 4 * _DENSEST * (size + 16):
            raise ContradictionError(_FEWER)
