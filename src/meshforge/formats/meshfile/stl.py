"""Reading STL, binary and ASCII: triangles without shared vertices, each where it stands in the file."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from meshforge.errors import AssetError
from meshforge.formats.meshfile.surface import RawSurface, checked
from meshforge.geometry import Floats, Ints

HEADER = 84  # bytes before the first triangle of a binary file: 80 of text, 4 of count
RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_FACET = re.compile(rb"facet\b.*?\bendfacet\b[^\S\n]*\n?", re.S | re.I)
_SOLID = re.compile(rb"^[^\S\n]*solid\b[^\S\n]*([^\r\n]*)", re.M | re.I)
_VERTEX = re.compile(rb"\bvertex\s+(\S+)\s+(\S+)\s+(\S+)", re.I)


@dataclass(frozen=True, eq=False, slots=True)
class StlText:
    """An STL file taken apart.

    corners: (m, 3, 3) of each triangle; spans: (m, 2) the bytes of each triangle in the file;
    solid: (m,) into `solids`, the names of an ASCII file's solids; binary: whether it is a binary file.
    """

    corners: Floats
    spans: Ints
    solid: Ints
    solids: tuple[str, ...]
    binary: bool

    def surfaces(self, where: str) -> list[RawSurface]:
        """A surface for each solid, named where there are several. Raises AssetError."""
        several = len(np.unique(self.solid)) > 1
        parts = []
        for k, name in enumerate(self.solids):
            corners = self.corners[self.solid == k].reshape(-1, 3)
            parts.append(RawSurface((name or None) if several else None, corners, _in_order(corners)))
        return checked(parts, where)


def _in_order(corners: Floats) -> Ints:
    return np.arange(len(corners), dtype=np.int64).reshape(-1, 3)


def parse_stl(data: bytes, where: str) -> StlText:
    """An STL file taken apart. Raises AssetError: cut short, or not an STL file."""
    count = int.from_bytes(data[80:HEADER], "little") if len(data) >= HEADER else -1
    size = HEADER + count * RECORD.itemsize
    text = data.lstrip()[:5].lower() == b"solid"
    if count >= 0 and (size == len(data) or (size < len(data) and not text)):
        return _binary(data, count)
    if text:
        return _ascii(data, where)
    if count < 0:
        raise AssetError("this is no STL file", where=where, remedy="Export it again.")
    room = (len(data) - HEADER) // RECORD.itemsize
    problem = f"the file is cut short: it says {count} triangles and holds {room}"
    raise AssetError(problem, where=where, remedy="Export it again.")


def _binary(data: bytes, count: int) -> StlText:
    corners = np.frombuffer(data, RECORD, count, HEADER)["corners"].astype(np.float64)
    starts = HEADER + RECORD.itemsize * np.arange(count, dtype=np.int64)
    spans = np.column_stack([starts, starts + RECORD.itemsize])
    return StlText(corners, spans, np.zeros(count, dtype=np.int64), ("",), True)


def _ascii(data: bytes, where: str) -> StlText:
    solids = [(m.start(), m[1].strip().decode("utf-8", "surrogateescape")) for m in _SOLID.finditer(data)]
    facets = list(_FACET.finditer(data))
    numbers: list[tuple[bytes, ...]] = []
    for facet in facets:
        found = _VERTEX.findall(facet[0])
        if len(found) != 3:
            raise AssetError("a facet needs three vertices", where=f"{where}:{_line(data, facet.start())}")
        numbers += found
    if len(re.findall(rb"\bfacet\s+normal\b", data, re.I)) > len(facets):
        raise AssetError("the file is cut short: a facet does not end", where=where, remedy="Export it again.")
    try:
        corners = np.array([[float(x) for x in row] for row in numbers], dtype=np.float64).reshape(-1, 3, 3)
    except ValueError as error:
        raise AssetError(f"a coordinate is not a number ({error})", where=where) from None
    spans = np.array([f.span() for f in facets], dtype=np.int64).reshape(-1, 2)
    solid = np.searchsorted([start for start, _ in solids], spans[:, 0], side="right") - 1
    return StlText(corners, spans, np.maximum(solid, 0), tuple(name for _, name in solids) or ("",), False)


def _line(data: bytes, offset: int) -> int:
    return data.count(b"\n", 0, offset) + 1
