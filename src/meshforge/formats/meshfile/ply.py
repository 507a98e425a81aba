"""Read PLY, ASCII and binary, with all properties of its rows."""

import codecs
import itertools
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from meshforge.common import AssetError
from meshforge.formats.meshfile import surface
from meshforge.geometry import Floats, Ints

TYPES = {
    **{"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4"},
    **{"double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4"},
    **{"float32": "f4", "float64": "f8"},
}
_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
_SHOWN = 60  # characters of a row, or a line of the header, in a message
INDEX_NAMES = ("vertex_indices", "vertex_index")
"""The names under which files keep the corners of a face."""


@dataclass(frozen=True, slots=True)
class PlyProperty:
    """A property of an element: its name, numpy type, and the type of its length where it is a list."""

    name: str
    type: str
    count: str | None = None


@dataclass(eq=False, slots=True)
class PlyElement:
    """An element: its name, how many rows it has, its properties, and the values of each by its name."""

    name: str
    rows: int
    properties: list[PlyProperty] = field(default_factory=list)
    values: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, eq=False, slots=True)
class PlyFile:
    """The content of a PLY file.

    vertices: (n, 3); faces: (m, 3) triangles, polygons cut into fans; face_at: (m,) the face row of each triangle.
    """

    is_text: bool
    elements: list[PlyElement]
    vertices: Floats
    faces: Ints
    face_at: Ints

    def surfaces(self, where: str) -> list[surface.RawSurface]:
        """Return the one surface of the file. Raises AssetError."""
        return surface.check_surfaces([surface.RawSurface(None, self.vertices, self.faces)], where)


def parse_ply(data: bytes, where: str) -> PlyFile:
    """Return the content of a PLY file. Raises AssetError: cut short, damaged, or not a PLY file."""
    at, order, elements = _parse_header(data, where)
    for element in elements:
        if element.rows > len(data) - at:  # before any memory is taken for them
            raise _truncation_error(element, where)
        try:
            read = _read_binary(data, at, element, order) if order else _read_text(data, at, element, where)
        except (ValueError, IndexError):
            raise _truncation_error(element, where) from None
        element.values, at = read
    vertices = _find_vertices(elements, where)
    return PlyFile(not order, elements, vertices, *_find_faces(elements, len(vertices), where))


def _parse_header(data: bytes, where: str) -> tuple[int, str, list[PlyElement]]:
    """The size of the header, the byte order in numpy's letters, empty for text, and the elements without values."""
    if data.removeprefix(codecs.BOM_UTF8)[:3] != b"ply":
        raise AssetError("this is no PLY file", where=where, remedy="Export it again.")
    end = re.search(rb"^end_header[ \t]*(\r\n|\n|\r)", data, re.M)
    if end is None and re.search(rb"\rend_header\r", data):
        raise AssetError("its lines end in CR alone", where=where, remedy="Convert its line ends, or export it again.")
    if end is None:
        raise AssetError("the file is cut short: its header does not end", where=where, remedy="Export it again.")
    order: str | None = None
    elements: list[PlyElement] = []
    for number, line in enumerate(data[: end.start()].splitlines(), start=1):
        words = line.decode("ascii", "replace").split()
        try:
            match words:
                case ["format", kind, _]:
                    order = _ORDERS[kind]
                case ["element", name, rows] if rows.isdecimal():
                    elements.append(PlyElement(name, int(rows)))
                case ["element", _, rows]:
                    raise ValueError(rows)
                case ["property", *rest]:
                    made = _parse_property(rest)
                    if any(p.name == made.name for p in elements[-1].properties):
                        raise ValueError(made.name)
                    elements[-1].properties.append(made)
        except (KeyError, IndexError, ValueError):
            shown = " ".join(words)[:_SHOWN]
            raise AssetError(f"this line of the header makes no sense: {shown!r}", where=f"{where}:{number}") from None
    if order is None:
        raise AssetError("the header names no format", where=where)
    return end.end(), order, elements


def _parse_property(words: list[str]) -> PlyProperty:
    match words:
        case ["list", count, kind, name]:
            return PlyProperty(name, TYPES[kind], TYPES[count])
        case [kind, name]:
            return PlyProperty(name, TYPES[kind])
    raise ValueError(words)


def _truncation_error(element: PlyElement, where: str) -> AssetError:
    problem = f"the file is cut short or damaged: its {element.rows} rows of {element.name} are not all there"
    return AssetError(problem, where=where, remedy="Export it again.")


def _read_text(data: bytes, at: int, element: PlyElement, where: str) -> tuple[dict[str, Any], int]:
    """The values of an element and where they end; a row is a line. Raises AssetError at a line that is no row."""
    values: dict[str, Any] = {p.name: [] for p in element.properties}
    for k in range(element.rows):
        stop = _line_end_of(data, at)
        while element.properties and stop < len(data) and not data[at:stop].strip():  # blank lines between rows
            at, stop = stop, _line_end_of(data, stop)
        words = data[at:stop].split()
        try:
            row, place = list(map(float, words)), 0
            for p in element.properties:
                length = _to_whole(row[place : place + 1]) if p.count else 1
                place += 1 if p.count else 0
                if length < 0 or place + length > len(row):
                    raise ValueError(length)
                values[p.name].append(row[place : place + length] if p.count else row[place])
                place += length
        except ValueError:
            if not words:
                raise
            shown = surface.text_of(data[at:stop].strip())[:_SHOWN]
            problem = f"row {k} of {element.name} is cut short or damaged: {shown!r}"
            line = data.count(b"\n", 0, at) + 1
            raise AssetError(problem, where=f"{where}:{line}", remedy=surface.remedy_for(words)) from None
        at = stop
    return values, at


def _line_end_of(data: bytes, at: int) -> int:
    stop = data.find(b"\n", at)
    return len(data) if stop < 0 else stop + 1


def _to_whole(values: Sequence[float]) -> int:
    return int(values[0]) if len(values) and float(values[0]).is_integer() else -1


def _read_binary(data: bytes, at: int, element: PlyElement, order: str) -> tuple[dict[str, Any], int]:
    """The values of an element and where they end: all at once where its lists are three long, as of triangles."""
    fields: list[tuple[Any, ...]] = []
    for p in element.properties:
        fields += [(f"{p.name}:count", order + p.count)] if p.count else []
        fields.append((p.name, order + p.type, (3,)) if p.count else (p.name, order + p.type))
    row, lists = np.dtype(fields), [f"{p.name}:count" for p in element.properties if p.count]
    if not lists or at + row.itemsize * element.rows <= len(data):
        table: npt.NDArray[Any] = np.frombuffer(data, row, element.rows, at)
        if all((table[name] == 3).all() for name in lists):
            return {p.name: table[p.name] for p in element.properties}, at + row.itemsize * element.rows
    values: dict[str, Any] = {p.name: [] for p in element.properties}
    for _ in range(element.rows):
        for p in element.properties:
            length = 1
            if p.count:
                length = _to_whole(np.frombuffer(data, order + p.count, 1, at).tolist())
                if length < 0:
                    raise ValueError(length)
                at += np.dtype(p.count).itemsize
            read = np.frombuffer(data, order + p.type, length, at) if length else np.zeros(0)
            at += length * np.dtype(p.type).itemsize
            values[p.name].append(read if p.count else read[0])
    return values, at


def _find_vertices(elements: list[PlyElement], where: str) -> Floats:
    found = next((e for e in elements if e.name == "vertex"), None)
    if found is None or not all(axis in found.values for axis in "xyz"):
        raise AssetError("there are no vertices with x, y and z in this file", where=where)
    if any(p.count for p in found.properties if p.name in ("x", "y", "z")):
        raise AssetError("its coordinates are lists, not numbers", where=where)
    return np.column_stack([surface.to_doubles(found.values[axis]) for axis in "xyz"]).reshape(-1, 3)


def _find_corners(elements: list[PlyElement], where: str) -> Any:
    found = next((e for e in elements if e.name == "face"), None)
    if found is None and any(e.name == "tristrips" for e in elements):
        raise AssetError("its faces are triangle strips, which are not read", where=where, remedy="Export triangles.")
    if found is None:
        return []
    numbers = [p.name for p in found.properties if p.name in INDEX_NAMES and not p.count]
    if numbers:
        problem = f"the {numbers[0]} of its faces is a number, not a list"
        raise AssetError(problem, where=where, remedy="Export it again.")
    key = next((k for k in INDEX_NAMES if k in found.values), None)
    if key is None:
        raise AssetError(f"its faces have no list {' or '.join(INDEX_NAMES)}", where=where)
    return found.values[key]


def _find_faces(elements: list[PlyElement], count: int, where: str) -> tuple[Ints, Ints]:
    read = _find_corners(elements, where)
    if isinstance(read, np.ndarray) and read.dtype.kind in "iu":
        table = read.astype(np.int64)  # first, since -1 is out of bounds for a type without sign
        if table.min(initial=0) >= 0 and table.max(initial=-1) < count:
            return table, np.arange(len(table))
    for k, corners in enumerate(read):
        if not all(0 <= c < count and c == int(c) for c in corners):
            names = ", ".join(f"{c:g}" for c in corners[:8])
            problem = f"face {k} names vertices {names}, where the file has 0 to {count - 1}"
            raise AssetError(problem, where=where)
    counts = np.array([len(corners) for corners in read], dtype=np.int64)
    flat = np.fromiter(itertools.chain.from_iterable(read), np.int64, int(counts.sum()))
    at, triangles = surface.cut_fans(flat, counts)
    return triangles, at
