"""Read STL, binary and ASCII: triangles without shared vertices, each where it stands in the file."""

from __future__ import annotations

import codecs
import itertools
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
_FACET = re.compile(rb"facet\b.*?\bendfacet\b[^\S\n]*\n?", re.S)
_SOLID = re.compile(rb"^[^\S\n]*solid\b[^\S\n]*([^\r\n]*)", re.M | re.I)
_OPENED = re.compile(rb"\bfacet\s+normal\b")
_NAME = re.compile(
    rb"^[^\S\n]*(?:end)?solid\b(?:(?!\bvertex\b)[^\r\n])*(?=[\r\n]|\Z)(?!\s*(?:outer|vertex)\b)", re.M | re.I
)
_VERTEX = re.compile(rb"\bvertex\s+(\S+)\s+(\S+)\s+(\S+)")


@dataclass(frozen=True, eq=False, slots=True)
class StlText:
    """An STL file taken apart.

    corners: (m, 3, 3) of each triangle; solid: (m,) into `solids`, the names of an ASCII file's solids;
    binary: whether it is a binary file.
    """

    corners: Floats
    solid: Ints
    solids: tuple[str, ...]
    binary: bool

    def surfaces(self, where: str) -> list[RawSurface]:
        """Return a surface for each solid, named where there are several. Raises AssetError."""
        several = len(self.solids) > 1 and len(np.unique(self.solid)) > 1
        found = []
        for k, name in enumerate(self.solids):
            own = self.corners[self.solid == k].reshape(-1, 3)
            found.append(RawSurface((name or None) if several else None, own, np.arange(len(own)).reshape(-1, 3)))
        return check_surfaces(found, where)


def parse_stl(data: bytes, where: str) -> StlText:
    """Return an STL file taken apart. Raises AssetError: cut short, or not an STL file."""
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
        return _parse_ascii(data, where)
    if count < 0 or all(byte in b"\t\n\r" or 32 <= byte < 127 for byte in data[:HEADER]):
        raise AssetError("this is no STL file", where=where, remedy=_AGAIN)
    raise AssetError(f"the file is cut short: it says {count} triangles and holds {room}", where=where, remedy=_AGAIN)


def facet_spans(data: bytes) -> Ints:
    """Return the bytes (m, 2) of each triangle in an ASCII file."""
    return _spans_in(_blank_names(data))


def _spans_in(plain: bytes) -> Ints:
    return np.array([facet.span() for facet in _FACET.finditer(plain)], dtype=np.int64).reshape(-1, 2)


def _blank_names(data: bytes) -> bytes:
    """The text in small letters, with blanks for titles of solids, which may hold any word, but for those that go on
    with a facet."""
    return _NAME.sub(lambda title: b" " * len(title[0]), data).lower()


def _parse_ascii(data: bytes, where: str) -> StlText:
    solids = [(m.start(), text_of(m[1].strip())) for m in _SOLID.finditer(data)]
    plain = _blank_names(data)
    spans = _spans_in(plain)
    found = list(_VERTEX.finditer(plain))
    at = np.array([vertex.start() for vertex in found], dtype=np.int64)
    owner = np.searchsorted(spans[:, 0], at, side="right") - 1
    inside = (owner >= 0) & (at < spans[owner, 1]) if len(spans) else np.zeros(len(at), dtype=bool)
    odd = np.flatnonzero(np.bincount(owner[inside], minlength=len(spans)) != 3)
    if len(odd):
        start, stop = spans[odd[0]].tolist()
        whole = len(re.findall(rb"\bvertex\b", plain[start:stop])) == 3
        problem = "a vertex needs three numbers" if whole else "a facet needs three vertices"
        raise AssetError(problem, where=f"{where}:{_line_of(data, start)}")
    if len(_OPENED.findall(plain)) > len(spans):
        raise AssetError("the file is cut short: a facet does not end", where=where, remedy=_AGAIN)
    found = list(itertools.compress(found, inside.tolist()))
    words = [word for vertex in found for word in vertex.groups()]
    try:
        if b"_" in plain and any(b"_" in word for word in words):  # digit separators of Python, which no one else reads
            raise ValueError
        corners = np.array(list(map(float, words)), dtype=np.float64).reshape(-1, 3, 3)
    except ValueError:
        k = next(k for k, vertex in enumerate(found) if not all(map(is_number, vertex.groups())))
        line = _line_of(data, int(spans[k // 3, 0]))
        authored = data[slice(*found[k].span())].split()[1:]
        problem = f"a vertex needs three numbers, here is {text_of(b' '.join(authored))!r}"
        raise AssetError(problem, where=f"{where}:{line}", remedy=remedy_for(authored)) from None
    solid = np.searchsorted([start for start, _ in solids], spans[:, 0], side="right") - 1
    return StlText(corners, np.maximum(solid, 0), tuple(name for _, name in solids) or ("",), False)


def _line_of(data: bytes, offset: int) -> int:
    return data.count(b"\n", 0, offset) + 1
