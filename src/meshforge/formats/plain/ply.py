"""PLY: the pieces of the one surface are the hulls, counted in file order; other properties are kept."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from meshforge.common import AssetError
from meshforge.formats.base import feature_of_others
from meshforge.formats.meshfile.ply import INDEX_NAMES, PlyProperty, PlyRows, PlyText, parse_ply
from meshforge.formats.meshfile.surface import Soup, join_surfaces, stack_triangles
from meshforge.formats.plain.base import MeshFileEdit, PlainFormat
from meshforge.formats.plain.parts import MeshPart, PlainDocument
from meshforge.geometry import Floats, Ints
from meshforge.symbolic import Asset, Feature

_HEADER = """ply
format binary_little_endian 1.0
comment made by MeshForge
element vertex {}
property double x
property double y
property double z
element face {}
property list uchar int vertex_indices
end_header
"""

_HEAD = 10_000  # bytes, more than headers have
_COLOR = re.compile(rb"^property\s+\w+\s+red\s*$", re.M)

_COLOR_NAME = re.compile(r"(diffuse_|ambient_|specular_)?(red|green|blue|alpha)|[rgba]")


class PlyFormat(PlainFormat):
    """PLY files; new ones are binary, in double precision."""

    name = "ply"
    title = "PLY"
    suffixes = (".ply",)

    def parse_soup(self, data: bytes, path: Path) -> Soup:
        return join_surfaces(parse_ply(data, str(path)).surfaces(str(path)))

    def apply_edit(self, edit: MeshFileEdit) -> bytes:
        return _PlyEditor(parse_ply(edit.document.data, str(edit.path)), edit).to_bytes()

    def features(self, asset: Asset) -> Iterator[Feature]:
        if isinstance(asset.document, PlainDocument):
            colors = len(_COLOR.findall(asset.document.data[:_HEAD].partition(b"end_header")[0]))
            yield feature_of_others(["vertex colour"] * colors)

    def format_parts(self, parts: Sequence[MeshPart]) -> bytes:
        vertices, faces = _stack_parts(parts, 0)
        rows = np.zeros(len(faces), dtype=[("count", "u1"), ("corners", "<i4", (3,))])
        rows["count"], rows["corners"] = 3, faces
        head = _HEADER.format(len(vertices), len(faces)).encode()
        return head + vertices.astype("<f8").tobytes() + rows.tobytes()


def _stack_parts(parts: Sequence[MeshPart], start: int) -> tuple[Floats, Ints]:
    """All vertices (n, 3) of parts and their faces (m, 3), numbered from `start`."""
    return stack_triangles(((part.surface.vertices + 0.0, part.surface.faces) for part in parts), start)


class _PlyEditor:
    """Writes the rows of a file that stay, with new vertex numbers, and rows for the parts."""

    def __init__(self, text: PlyText, edit: MeshFileEdit) -> None:
        self.text = text
        self.edit = edit
        first = {r.element.name: r for r in reversed(text.rows)}
        read = (first["vertex"], first["face"])
        others = [r.element.name for r in text.rows if r not in read and r.element.rows]
        if others:
            problem = f"it has rows of {others[0]}, which may count on vertices that the edit moves"
            raise AssetError(problem, where=str(edit.path), remedy="Convert it to OBJ first.")
        self.kept = np.ones(len(text.vertices), dtype=bool)
        self.kept[np.unique(text.faces[~edit.stays])] = False
        self.kept[np.unique(text.faces[edit.stays])] = True
        bare = set(range(first["face"].element.rows)).difference(text.face_at.tolist())  # of fewer corners than three
        lists = [first["face"].values[key] for key in INDEX_NAMES if key in first["face"].values]
        self.kept[[int(corner) for read in lists for k in bare for corner in read[k]]] = True
        self.number = np.cumsum(self.kept) - 1
        self.gone = set(text.face_at[~edit.stays].tolist())
        self.vertices, self.faces = _stack_parts(edit.parts, int(self.kept.sum()))
        self._refuse_misfits()

    def to_bytes(self) -> bytes:
        head = self.edit.document.data[: self.text.header.size]
        body = b""
        for rows in self.text.rows:
            written = list(self._edit_rows(rows))
            count = b"element %s %d" % (rows.element.name.encode(), len(written))
            head = re.sub(rb"(?m)^element\s+%s\s+\d+" % rows.element.name.encode(), count, head, count=1)
            body += b"".join(written)
        return head + body

    def _refuse_misfits(self) -> None:
        """Raise AssetError where the type of a property cannot hold a made hull; coordinates may lose digits."""
        made = {
            "vertex": dict(zip("xyz", self.vertices.T, strict=True)),
            "face": dict.fromkeys(INDEX_NAMES, self.faces),
        }
        for element in (rows.element for rows in self.text.rows):
            columns = made.get(element.name, {})
            for kind in (p for p in element.properties if p.name in columns and (p.count or p.type[0] != "f")):
                values = columns[kind.name]
                with np.errstate(invalid="ignore"):
                    wrong = values[values.astype(kind.type) != values]
                if wrong.size:
                    problem = f"a made hull needs {wrong[0]:.6g} in the property {kind.name}, whose type cannot hold it"
                    raise AssetError(problem, where=str(self.edit.path), remedy="Convert it to OBJ first.")

    def _edit_rows(self, rows: PlyRows) -> Iterator[bytes]:
        data, order, properties = self.edit.document.data, self.text.header.order, rows.element.properties
        if rows.element.name == "vertex":
            for start, stop in rows.spans[self.kept].tolist():
                row = data[start:stop]
                yield row if order or row.endswith(b"\n") else row + b"\n"  # the last may lack it
            yield from (_make_row({"x": x, "y": y, "z": z}, properties, order) for x, y, z in self.vertices.tolist())
        elif rows.element.name == "face":
            for k in range(rows.element.rows):
                if k not in self.gone:
                    own = {p.name: rows.values[p.name][k] for p in properties}
                    own |= {key: self.number[np.asarray(own[key], np.int64)] for key in INDEX_NAMES if key in own}
                    yield _make_row(own, properties, order)
            yield from (_make_row(dict.fromkeys(INDEX_NAMES, face), properties, order) for face in self.faces.tolist())


def _make_row(values: Mapping[str, Any], properties: Sequence[PlyProperty], order: str) -> bytes:
    """A row; of values that are not given, colours are full, the rest is zero."""
    cells = []
    for kind in properties:
        default: Any = [] if kind.count else 0
        if not kind.count and _COLOR_NAME.fullmatch(kind.name):
            default = int(np.iinfo(kind.type).max) if kind.type[0] in "iu" else 1.0
        cells.append(_format_cell(kind, values.get(kind.name, default), order))
    return b"".join(cells) if order else b" ".join(cells) + b"\n"


def _format_cell(kind: PlyProperty, value: Any, order: str) -> bytes:
    if order:
        head = np.array([len(value)], order + kind.count).tobytes() if kind.count else b""
        return head + np.asarray(value).astype(order + kind.type).tobytes()
    numbers = [str(int(x)) if kind.type[0] in "iu" else repr(float(x)) for x in (value if kind.count else [value])]
    return " ".join([str(len(numbers)), *numbers] if kind.count else numbers).encode()
