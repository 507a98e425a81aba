"""The values of a binary layer: how long they say they are, and how deep they lie in each other."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from meshforge.formats.usd.reading.guard.packed import Bytes, ContradictionError, ExcessError
from meshforge.formats.usd.reading.guard.remedy import DEEPEST

_ARRAY, _INLINED, _PACKED, _EDIT = 1 << 63, 1 << 62, 1 << 61, 1 << 60
_PLACE = (1 << 48) - 1
_SHORT = 16  # numbers that are never packed
_INTEGERS, _REALS = range(3, 7), range(7, 10)
# bytes of an element of an array, by the number of its type
_SIZES = dict(enumerate((1, 1, 4, 4, 8, 8, 2, 4, 8, 4, 4, 4, 32, 72, 128, 32, 16, 8), 1))
_SIZES |= {19 + 4 * (n - 2) + k: n * size for n in (2, 3, 4) for k, size in enumerate((8, 4, 2, 4))}
PATH_EXPRESSION = 57
_SIZES |= {56: 8, PATH_EXPRESSION: 4}
_VECTORS = {40: 4, 41: 4, 45: 8, 48: 8, 49: 16, 50: 4, 58: 8}
_LISTS = {32: 4, 33: 4, 34: 4, 36: 4, 37: 8, 38: 4, 39: 8}
_DICTIONARY, _REFERENCES, _SAMPLES, _PAYLOADS, _SPLINE = 31, 35, 46, 55, 59
_VALUES, _UNKNOWN_LIST = (52, 53), 54
_LONG, _DOUBLES, _LAST = 5, 48, 60
_LISTED = 0b1111110  # the bits of a list's head that say which lists follow


def refuse_harmful_values(data: Bytes, values: NDArray[np.uint64], version: tuple[int, ...]) -> None:
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


def _as(value: int, kind: int, flags: int = 0) -> int:
    """A value that is read as one of a kind, whatever it says to be."""
    return value & (_PACKED | _INLINED | _PLACE) | kind << 48 | flags


class _Value:
    """What one value says about itself: its kind, and the place where it lies."""

    def __init__(self, data: Bytes, value: int, version: tuple[int, ...]) -> None:
        self.bits, self.kind, self.version = value, (value >> 48) & 0xFF, version
        self.file = Bytes(data.data, value & _PLACE, data.allowance)

    def find_inner(self) -> Iterator[int]:
        """The values within it. Raises ContradictionError where there are fewer things than it says."""
        file, kind, bits = self.file, self.kind, self.bits
        many = kind in _SIZES or kind > _LAST  # other kinds have no arrays, whatever their bits say
        if many and bits & (_ARRAY | _EDIT) and not bits & _PLACE:
            return
        if many and bits & _ARRAY:
            self._check_array()
        elif many and bits & _EDIT:
            yield from (_as(file.read_number(), kind, _ARRAY), _as(file.read_number(), _LONG, _ARRAY))
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
            found.append(_as(self._read_held(), _DOUBLES))
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
        """A value that is told where it lies."""
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
            file.skip(count, _SIZES.get(kind, 1))
        elif whole:
            file.skip_integers(count)
        else:
            if file.read_number(1) == ord("t"):
                file.skip(file.read_number(4), _SIZES[kind])
            file.skip_integers(count)
