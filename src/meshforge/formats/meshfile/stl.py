"""Read STL, binary and ASCII: triangles without shared vertices."""

import codecs
import re
from dataclasses import dataclass

import numpy as np

from meshforge.common import AssetError
from meshforge.formats.meshfile.surface import RawSurface, check_surfaces, is_number, remedy_for, text_of, to_doubles
from meshforge.geometry import Floats, Ints

HEADER = 84  # bytes before the first triangle of a binary file: 80 of text, 4 of count
RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_AGAIN = "Export it again."
_TEXT = 200  # bytes at the start of a file, beyond the title of a binary one, that tell text from numbers
_FACET = re.compile(rb"facet\b.*?\bendfacet\b[^\S\n]*\n?", re.S | re.I)
_SOLID = re.compile(rb"^[^\S\n]*solid\b[^\S\n]*([^\r\n]*)", re.M | re.I)
_OPENED = re.compile(rb"\bfacet\s+normal\b", re.I)
_NAME = re.compile(
    rb"^[^\S\n]*(?:end)?solid\b(?:(?!\bvertex\b)[^\r\n])*(?=[\r\n]|\Z)(?!\s*(?:outer|vertex)\b)", re.M | re.I
)
_VERTEX = re.compile(rb"\bvertex\s+(\S+)\s+(\S+)\s+(\S+)", re.I)


@dataclass(frozen=True, eq=False, slots=True)
class StlText:
    """An STL file taken apart.

    corners: (m, 3, 3) of each triangle; solid: (m,) into `solids`, the names in a text; binary: whether it is none.
    """

    corners: Floats
    solid: Ints
    solids: tuple[str, ...]
    binary: bool

    def surfaces(self, where: str) -> list[RawSurface]:
        """A surface for each solid, named where there are several. Raises AssetError."""
        if len(self.solids) == 1:
            return check_surfaces([_surface_of(None, self.corners)], where)
        several = len(np.unique(self.solid)) > 1
        names = [(name or None) if several else None for name in self.solids]
        return check_surfaces([_surface_of(name, self.corners[self.solid == k]) for k, name in enumerate(names)], where)


def _surface_of(name: str | None, corners: Floats) -> RawSurface:
    return RawSurface(name, corners.reshape(-1, 3), np.arange(3 * len(corners), dtype=np.int64).reshape(-1, 3))


def parse_stl(data: bytes, where: str) -> StlText:
    """An STL file taken apart. Raises AssetError: cut short, or not an STL file."""
    count = int.from_bytes(data[80:HEADER], "little") if len(data) >= HEADER else -1
    room = (len(data) - HEADER) // RECORD.itemsize
    # the title of a binary file may say `solid` too, the numbers behind it are no text
    text = data.removeprefix(codecs.BOM_UTF8).lstrip()[:5].lower() == b"solid" and b"\0" not in data[:_TEXT]
    if 0 <= count <= room and (not text or len(data) == HEADER + count * RECORD.itemsize):
        if count == 0 and room > 0:
            raise AssetError(f"it says it has no triangle, yet {room} may follow", where=where, remedy=_AGAIN)
        corners = to_doubles(np.frombuffer(data, RECORD, count, HEADER)["corners"])
        return StlText(corners, np.zeros(count, dtype=np.int64), ("",), True)
    if text:
        return _parse_ascii(data.removeprefix(codecs.BOM_UTF8), where)
    if count < 0 or all(byte in b"\t\n\r" or 32 <= byte < 127 for byte in data[:HEADER]):
        raise AssetError("this is no STL file", where=where, remedy=_AGAIN)
    raise AssetError(f"the file is cut short: it says {count} triangles and holds {room}", where=where, remedy=_AGAIN)


def _parse_ascii(data: bytes, where: str) -> StlText:
    solids = [(m.start(), text_of(m[1].strip())) for m in _SOLID.finditer(data)]
    plain = _NAME.sub(lambda title: b" " * len(title[0]), data)  # titles may hold any word
    facets = list(_FACET.finditer(plain))
    numbers: list[tuple[bytes, ...]] = []
    for facet in facets:
        found = _VERTEX.findall(facet[0])
        if len(found) != 3:
            whole = len(re.findall(rb"\bvertex\b", facet[0], re.I)) == 3
            problem = "a vertex needs three numbers" if whole else "a facet needs three vertices"
            raise AssetError(problem, where=f"{where}:{_line_of(data, facet.start())}")
        numbers += found
    if len(_OPENED.findall(plain)) > len(facets):
        raise AssetError("the file is cut short: a facet does not end", where=where, remedy=_AGAIN)
    try:
        corners = np.array([[float(x) for x in row] for row in numbers], dtype=np.float64).reshape(-1, 3, 3)
        if any(b"_" in x for row in numbers for x in row):  # Python's own digit separators, which no one else reads
            raise ValueError
    except ValueError:
        k = next(k for k, row in enumerate(numbers) if not all(map(is_number, row)))
        line = _line_of(data, facets[k // 3].start())
        problem = f"a vertex needs three numbers, here is {text_of(b' '.join(numbers[k]))!r}"
        raise AssetError(problem, where=f"{where}:{line}", remedy=remedy_for(numbers[k])) from None
    starts = [facet.start() for facet in facets]
    solid = np.searchsorted([start for start, _ in solids], starts, side="right") - 1
    return StlText(corners, np.maximum(solid, 0), tuple(name for _, name in solids) or ("",), False)


def _line_of(data: bytes, offset: int) -> int:
    return data.count(b"\n", 0, offset) + 1
