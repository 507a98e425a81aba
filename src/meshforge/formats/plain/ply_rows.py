"""Rows of a PLY file: those that stay with new vertex numbers, and new ones."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from meshforge.formats.meshfile.ply import INDICES
from meshforge.formats.meshfile.ply_header import Property
from meshforge.geometry import Ints

_COLOR = re.compile(r"(diffuse_|ambient_|specular_)?(red|green|blue|alpha)|[rgba]")


def ended(row: bytes, order: str) -> bytes:
    """A row with a line end, which the last of an ASCII file may lack."""
    return row if order or row.endswith(b"\n") else row + b"\n"


def renumbered(row: bytes, properties: Sequence[Property], order: str, number: Ints) -> bytes:
    """The row of a face with the new numbers of its corners; all else is as it was."""
    return _renumbered_bytes(row, properties, order, number) if order else _renumbered_text(row, properties, number)


def _renumbered_text(row: bytes, properties: Sequence[Property], number: Ints) -> bytes:
    words, at = row.split(), 0
    for kind in properties:
        length = int(words[at]) if kind.count else 0
        if kind.name in INDICES:
            words[at + 1 : at + 1 + length] = [
                b"%d" % number[int(float(word))] for word in words[at + 1 : at + 1 + length]
            ]
        at += 1 + length
    return b" ".join(words) + (row[len(row.rstrip()) :] or b"\n")


def _renumbered_bytes(row: bytes, properties: Sequence[Property], order: str, number: Ints) -> bytes:
    out, at = row, 0
    for kind in properties:
        length = 1
        if kind.count:
            length = int(np.frombuffer(row, order + kind.count, 1, at)[0])
            at += np.dtype(kind.count).itemsize
        stop = at + length * np.dtype(kind.type).itemsize
        if kind.name in INDICES and length:
            corners = np.frombuffer(row, order + kind.type, length, at).astype(np.int64)
            out = out[:at] + number[corners].astype(order + kind.type).tobytes() + out[stop:]
        at = stop
    return out


def misfits(kind: Property, values: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Those of new values that the type of a property cannot hold; a coordinate may be rounded to single precision."""
    if kind.type[0] == "f" and not kind.count:
        return values[:0]
    with np.errstate(invalid="ignore"):
        wrong: npt.NDArray[np.bool_] = values.astype(kind.type) != values
    return values[wrong]


def made_row(values: Mapping[str, Any], properties: Sequence[Property], order: str) -> bytes:
    """A new row; colours that are not given are full, the rest is zero."""
    cells = [_cell(kind, values.get(kind.name, [] if kind.count else _default(kind)), order) for kind in properties]
    return b"".join(cells) if order else b" ".join(cells) + b"\n"


def _default(kind: Property) -> float:
    if not _COLOR.fullmatch(kind.name):
        return 0
    return int(np.iinfo(kind.type).max) if kind.type[0] in "iu" else 1.0


def _cell(kind: Property, value: Any, order: str) -> bytes:
    if order:
        head = np.array([len(value)], order + kind.count).tobytes() if kind.count else b""
        return head + np.asarray(value).astype(order + kind.type).tobytes()
    numbers = [str(int(x)) if kind.type[0] in "iu" else repr(float(x)) for x in (value if kind.count else [value])]
    return " ".join([str(len(numbers)), *numbers] if kind.count else numbers).encode()
