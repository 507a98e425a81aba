"""Reading PLY, ASCII and binary, each row where it stands in the file, so that edits keep all its properties."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from meshforge.errors import AssetError
from meshforge.formats.meshfile.ply_header import Element, Header, parse_header
from meshforge.formats.meshfile.surface import RawSurface, checked
from meshforge.geometry import Floats, Ints

INDICES = ("vertex_indices", "vertex_index")
"""The names under which files keep the corners of a face."""


@dataclass(frozen=True, eq=False, slots=True)
class Rows:
    """The rows of an element: spans (n, 2), the bytes of each in the file; values of each property by its name."""

    element: Element
    spans: Ints
    values: dict[str, Any]


@dataclass(frozen=True, eq=False, slots=True)
class PlyText:
    """A PLY file taken apart.

    vertices: (n, 3); faces: (m, 3) triangles, polygons cut into fans; face_at: (m,) the face row of each triangle.
    """

    header: Header
    rows: tuple[Rows, ...]
    vertices: Floats
    faces: Ints
    face_at: Ints

    def surfaces(self, where: str) -> list[RawSurface]:
        """The one surface of the file. Raises AssetError."""
        return checked([RawSurface(None, self.vertices, self.faces)], where)


def parse_ply(data: bytes, where: str) -> PlyText:
    """A PLY file taken apart. Raises AssetError: cut short, damaged, or not a PLY file."""
    header = parse_header(data, where)
    rows: list[Rows] = []
    at = header.size
    for element in header.elements:
        if element.rows > len(data) - at:  # before any memory is taken for them
            raise _cut_short(element, where)
        try:
            rows.append((_binary if header.order else _ascii)(data, at, element, header.order))
        except (ValueError, IndexError):
            raise _cut_short(element, where) from None
        at = int(rows[-1].spans[-1, 1]) if element.rows else at
    vertices = _vertices(rows, where)
    faces, face_at = _faces(rows, len(vertices), where)
    return PlyText(header, tuple(rows), vertices, faces, face_at)


def _cut_short(element: Element, where: str) -> AssetError:
    problem = f"the file is cut short or damaged: its {element.rows} rows of {element.name} are not all there"
    return AssetError(problem, where=where, remedy="Export it again.")


def _ascii(data: bytes, at: int, element: Element, _: str) -> Rows:
    spans = np.empty((element.rows, 2), dtype=np.int64)
    read: list[list[float]] = []
    for k in range(element.rows):
        stop = data.find(b"\n", at)
        stop = len(data) if stop < 0 else stop + 1
        spans[k] = at, stop
        read.append([float(word) for word in data[at:stop].split()])
        at = stop
    values: dict[str, Any] = {p.name: [] for p in element.properties}
    for row in read:
        place = 0
        for p in element.properties:
            length = int(row[place]) if p.count else 1
            place += 1 if p.count else 0
            if length < 0 or place + length > len(row):
                raise ValueError(row)
            values[p.name].append(row[place : place + length] if p.count else row[place])
            place += length
    return Rows(element, spans, values)


def _binary(data: bytes, at: int, element: Element, order: str) -> Rows:
    if not element.has_lists:
        return _table(data, at, element, np.dtype([(p.name, order + p.type) for p in element.properties]))
    return _alike(data, at, element, order) or _one_by_one(data, at, element, order)


def _table(data: bytes, at: int, element: Element, row: np.dtype[Any]) -> Rows:
    table = np.frombuffer(data, row, element.rows, at)
    starts = at + row.itemsize * np.arange(element.rows, dtype=np.int64)
    spans = np.column_stack([starts, starts + row.itemsize])
    return Rows(element, spans, {p.name: table[p.name] for p in element.properties})


def _alike(data: bytes, at: int, element: Element, order: str) -> Rows | None:
    """The rows where all their lists are three long, as those of triangles are; else None."""
    fields: list[tuple[Any, ...]] = []
    for p in element.properties:
        if p.count:
            fields += [(f"{p.name}:count", order + p.count), (p.name, order + p.type, (3,))]
        else:
            fields.append((p.name, order + p.type))
    row = np.dtype(fields)
    if at + row.itemsize * element.rows > len(data):
        return None
    table: npt.NDArray[Any] = np.frombuffer(data, row, element.rows, at)
    if any((table[f"{p.name}:count"] != 3).any() for p in element.properties if p.count):
        return None
    return _table(data, at, element, row)


def _one_by_one(data: bytes, at: int, element: Element, order: str) -> Rows:
    spans = np.empty((element.rows, 2), dtype=np.int64)
    values: dict[str, Any] = {p.name: [] for p in element.properties}
    for k in range(element.rows):
        start = at
        for p in element.properties:
            length = 1
            if p.count:
                length = int(np.frombuffer(data, order + p.count, 1, at)[0])
                at += np.dtype(p.count).itemsize
            read = np.frombuffer(data, order + p.type, max(length, 0), at) if length else np.zeros(0)
            at += length * np.dtype(p.type).itemsize
            values[p.name].append(read if p.count else read[0])
        spans[k] = start, at
    return Rows(element, spans, values)


def _vertices(rows: list[Rows], where: str) -> Floats:
    found = next((r for r in rows if r.element.name == "vertex"), None)
    if found is None or not all(axis in found.values for axis in "xyz"):
        raise AssetError("there are no vertices in this file", where=where)
    return np.column_stack([np.asarray(found.values[axis], dtype=np.float64) for axis in "xyz"]).reshape(-1, 3)


def _faces(rows: list[Rows], count: int, where: str) -> tuple[Ints, Ints]:
    """Triangles (m, 3) and the row of each (m,)."""
    found = next((r for r in rows if r.element.name == "face"), None)
    key = next((k for k in INDICES if found and k in found.values), None)
    if found is None or key is None:
        return np.zeros((0, 3), dtype=np.int64), np.zeros(0, dtype=np.int64)
    at: list[int] = []
    triangles: list[tuple[int, int, int]] = []
    for k, corners in enumerate(found.values[key]):
        indices = [int(c) for c in corners]
        if indices and not (min(indices) >= 0 and max(indices) < count):
            raise AssetError(f"face {k} names a vertex that is not there, the file has {count}", where=where)
        for second, third in itertools.pairwise(indices[1:]):
            at.append(k)
            triangles.append((indices[0], second, third))
    return np.array(triangles, dtype=np.int64).reshape(-1, 3), np.array(at, dtype=np.int64)
