"""The bytes and values of a binary layer: read never beyond their end, unpacked within an allowance, no deeper in
each other than the library can follow."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from itertools import chain

import numpy as np
from numpy.typing import NDArray

REMEDY = "Fetch or export it anew."
NEEDLESS = "No asset needs that."
DEEPEST = 1000
"""Things within things: the library goes down by recursion, and overflows its stack at some ten thousands."""

_DENSEST = 255  # bytes that one byte can stand for, by LZ4
_COST = 16  # bytes of memory that the library takes for one number while it unpacks it, about
_FREE = 1 << 28
_TIMES = 16
_CODED_SIZES = np.array([0, 1, 2, 4])  # bytes of a number by its code; 0: the one that is met most
_FEWER = "its numbers are fewer than it says"

_ARRAY, _INLINED, _PACKED, _EDIT = 1 << 63, 1 << 62, 1 << 61, 1 << 60
_PLACE = (1 << 48) - 1
_SHORT = 16  # numbers that are never packed
_INTEGERS, _REALS = range(3, 7), range(7, 10)
# bytes of an element of an array, by the number of its type
_ELEMENT_SIZES = dict(enumerate((1, 1, 4, 4, 8, 8, 2, 4, 8, 4, 4, 4, 32, 72, 128, 32, 16, 8), 1))
_ELEMENT_SIZES |= {19 + 4 * (n - 2) + k: n * size for n in (2, 3, 4) for k, size in enumerate((8, 4, 2, 4))}
PATH_EXPRESSION = 57
_ELEMENT_SIZES |= {56: 8, PATH_EXPRESSION: 4}
_VECTORS = {40: 4, 41: 4, 45: 8, 48: 8, 49: 16, 50: 4, 58: 8}
_LISTS = {32: 4, 33: 4, 34: 4, 36: 4, 37: 8, 38: 4, 39: 8}
_DICTIONARY, _REFERENCES, _SAMPLES, _PAYLOADS, _SPLINE = 31, 35, 46, 55, 59
_VALUES, _UNKNOWN_LIST = (52, 53), 54
_LONG, _DOUBLES, _LAST = 5, 48, 60
_LISTED = 0b1111110  # the bits of a list's head that say which lists follow


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


class CrateBytes:
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
        import lz4.block  # lazy: an optional package

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
        sizes = _CODED_SIZES[kinds]
        places = 4 + codes + np.cumsum(sizes) - sizes
        if count and places[-1] + sizes[-1] > len(coded):
            raise ContradictionError(_FEWER)
        steps = np.full(count, int.from_bytes(coded[:4], "little", signed=True), np.int64)
        for kind, number in enumerate((np.int8, np.int16, np.int32), 1):
            which = np.flatnonzero(kinds == kind)
            own = letters[places[which, None] + np.arange(_CODED_SIZES[kind])]
            steps[which] = np.ascontiguousarray(own).view(number).reshape(-1)
        return np.cumsum(steps).astype(np.int32)

    def skip_integers(self, count: int) -> None:
        """Go over numbers that are coded and packed, as many as such bytes can stand for."""
        self.allowance.take(count)
        size = self.read_number()
        self.skip(size)
        if count > 4 * _DENSEST * (size + 16):
            raise ContradictionError(_FEWER)


def refuse_harmful_values(data: CrateBytes, values: NDArray[np.uint64], version: tuple[int, ...]) -> None:
    """Look at the values and all within them.

    Raises ContradictionError where they lie about their length or in each other, ExcessError where they are too deep.
    """
    inside: dict[int, list[int]] = {}
    waiting = np.unique(values[(values & np.uint64(_INLINED | _ARRAY | _EDIT)) != _INLINED]).tolist()
    roots = list(waiting)
    while waiting:
        value = waiting.pop()
        if value not in inside:
            inside[value] = list(_Value(data, value, version).find_inner())
            waiting += inside[value]
    _refuse_deep(inside, roots)


def _refuse_deep(inside: dict[int, list[int]], roots: Iterable[int]) -> None:
    """Go from the outer to the inner values, each after all that hold it."""
    holders = dict.fromkeys(inside, 0)
    for value in chain.from_iterable(inside.values()):
        holders[value] += 1
    depths = dict.fromkeys(inside, 0)
    free = deque(value for value in roots if not holders[value])
    seen = 0
    while free:
        seen += 1
        value = free.popleft()
        for inner in inside[value]:
            depths[inner] = max(depths[inner], depths[value] + 1)
            holders[inner] -= 1
            if not holders[inner]:
                free.append(inner)
    if seen < len(inside):
        raise ContradictionError("values in it lie in each other")
    if max(depths.values(), default=0) > DEEPEST:
        raise ExcessError(f"values in it are nested more than {DEEPEST} deep")


def _retype(value: int, kind: int, flags: int = 0) -> int:
    """A value that is read as one of a kind, whatever it says to be."""
    return value & (_PACKED | _INLINED | _PLACE) | kind << 48 | flags


class _Value:
    """What one value says about itself: its kind, and the place where it lies."""

    def __init__(self, data: CrateBytes, value: int, version: tuple[int, ...]) -> None:
        self.bits, self.kind, self.version = value, (value >> 48) & 0xFF, version
        self.file = CrateBytes(data.data, value & _PLACE, data.allowance)

    def find_inner(self) -> Iterator[int]:
        """The values within it. Raises ContradictionError where there are fewer things than it says."""
        file, kind, bits = self.file, self.kind, self.bits
        many = kind in _ELEMENT_SIZES or kind > _LAST  # other kinds have no arrays, whatever their bits say
        if many and bits & (_ARRAY | _EDIT) and not bits & _PLACE:
            return
        if many and bits & _ARRAY:
            self._check_array()
        elif many and bits & _EDIT:
            yield from (_retype(file.read_number(), kind, _ARRAY), _retype(file.read_number(), _LONG, _ARRAY))
        elif bits & _INLINED:
            return
        elif kind in _VECTORS:
            file.skip(file.read_number(), _VECTORS[kind])
        elif kind in _LISTS:
            self._visit_lists(lambda: file.skip(file.read_number(), _LISTS[kind]))
        elif kind == _PAYLOADS:
            self._visit_lists(lambda: file.skip(file.read_number(), 24 if self.version >= (0, 8, 0) else 8))
        elif kind in _VALUES:
            yield self._read_held()
        else:
            yield from self._find_nested()

    def _find_nested(self) -> list[int]:
        found: list[int] = []
        file, kind = self.file, self.kind

        def dictionary() -> None:
            for _ in range(file.read_number()):
                file.skip(4)
                found.append(self._read_held())

        def reference() -> None:
            file.skip(24)
            dictionary()

        def many(read: Callable[[], None]) -> None:
            for _ in range(file.read_number()):
                read()

        if kind == _DICTIONARY:
            dictionary()
        elif kind == _REFERENCES:
            self._visit_lists(lambda: many(reference))
        elif kind == _UNKNOWN_LIST:
            self._visit_lists(lambda: many(lambda: found.append(self._read_held())))
        elif kind == _SAMPLES:
            found.append(_retype(self._read_held(), _DOUBLES))
            self._jump()
            count = file.read_number()
            start = file.skip(count, 8)
            found += np.frombuffer(file.data, "<u8", count, start).tolist()
        elif kind == _SPLINE:
            file.skip(file.read_number())
            for _ in range(file.read_number()):
                file.skip(8)
                dictionary()
        return found

    def _visit_lists(self, read: Callable[[], object]) -> None:
        for _ in range((self.file.read_number(1) & _LISTED).bit_count()):
            read()

    def _read_held(self) -> int:
        """A value, by the place where it lies."""
        self._jump()
        return self.file.read_number()

    def _jump(self) -> None:
        start = self.file.at
        offset = self.file.read_number()
        if offset < 8:
            raise ContradictionError("values in it lie in each other")
        self.file.at = start + offset

    def _check_array(self) -> None:
        file, kind = self.file, self.kind
        if self.version < (0, 5, 0):
            file.skip(4)
        count = file.read_number(4 if self.version < (0, 7, 0) else 8)
        whole = kind in _INTEGERS and self.version >= (0, 5, 0)
        real = kind in _REALS and self.version >= (0, 6, 0)
        if not (self.bits & _PACKED and (whole or real)) or count < _SHORT:
            file.skip(count, _ELEMENT_SIZES.get(kind, 1))
        elif whole:
            file.skip_integers(count)
        else:
            if file.read_number(1) == ord("t"):
                file.skip(file.read_number(4), _ELEMENT_SIZES[kind])
            file.skip_integers(count)


def bracket_depth(text: bytes) -> int:
    """How often brackets lie within brackets, at most. Expressions in strings are parsed like any others."""
    if sum(map(text.count, (b"(", b"[", b"{"))) <= DEEPEST:
        return 0  # not deep, however they lie
    letters = np.frombuffer(text, dtype=np.uint8)
    steps = np.isin(letters, list(b"([{")).astype(np.int64) - np.isin(letters, list(b")]}"))
    return int(steps.cumsum().max(initial=0))
