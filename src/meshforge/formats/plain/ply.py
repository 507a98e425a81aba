"""PLY: the pieces of the one surface are the hulls, counted in file order; other properties are kept."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from meshforge.asset import Asset, Feature, What
from meshforge.errors import AssetError
from meshforge.formats.meshfile import Soup, joined
from meshforge.formats.meshfile.ply import INDICES, PlyText, Rows, parse_ply
from meshforge.formats.plain.parts import Part, PlainDocument
from meshforge.formats.plain.plain import Edit, PlainFormat
from meshforge.formats.plain.ply_rows import ended, made_row, misfits, renumbered
from meshforge.geometry import Floats, Ints

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


class Ply(PlainFormat):
    """PLY files; new ones are binary, in double precision."""

    name = "ply"
    title = "PLY"
    could = frozenset({What.VERTEX_COLORS, What.TEXTURE_COORDINATES, What.COMMENTS})
    suffixes = (".ply",)

    def parse_soup(self, data: bytes, path: Path) -> Soup:
        return joined(parse_ply(data, str(path)).surfaces(str(path)))

    def apply_edit(self, edit: Edit) -> bytes:
        return _Editor(parse_ply(edit.document.data, str(edit.path)), edit).to_bytes()

    def features(self, asset: Asset) -> Iterator[Feature]:
        if isinstance(asset.document, PlainDocument):
            colors = len(_COLOR.findall(asset.document.data[:_HEAD].partition(b"end_header")[0]))
            yield Feature(What.VERTEX_COLORS, unnamed=colors)

    def format_parts(self, parts: Sequence[Part]) -> bytes:
        vertices, faces = _stacked(parts, 0)
        rows = np.zeros(len(faces), dtype=[("count", "u1"), ("corners", "<i4", (3,))])
        rows["count"], rows["corners"] = 3, faces
        head = _HEADER.format(len(vertices), len(faces)).encode()
        return head + vertices.astype("<f8").tobytes() + rows.tobytes()


def _stacked(parts: Sequence[Part], start: int) -> tuple[Floats, Ints]:
    """All vertices (n, 3) of parts and their faces (m, 3), numbered from `start`."""
    vertices, faces = [np.zeros((0, 3))], [np.zeros((0, 3), dtype=np.int64)]
    for part in parts:
        faces.append(part.surface.faces + start)
        vertices.append(part.surface.vertices + 0.0)
        start += len(part.surface.vertices)
    return np.concatenate(vertices), np.concatenate(faces)


class _Editor:
    """Writes the rows of a file that stay, with new vertex numbers, and rows for the parts."""

    def __init__(self, text: PlyText, edit: Edit) -> None:
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
        self.kept[self._corners_of_bare_faces(first["face"])] = True
        self.number = np.cumsum(self.kept) - 1
        self.gone = set(text.face_at[~edit.stays].tolist())
        self.vertices, self.faces = _stacked(edit.parts, int(self.kept.sum()))
        self._refuse_misfits()

    def _corners_of_bare_faces(self, faces: Rows) -> list[int]:
        """The vertices of faces of two corners, which stay."""
        bare = set(range(faces.element.rows)).difference(self.text.face_at.tolist())
        lists = [faces.values[key] for key in INDICES if key in faces.values]
        return [int(corner) for read in lists for k in bare for corner in read[k]]

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
        """Raise AssetError where a new row has a number that the type of its property cannot hold."""
        made = {"vertex": dict(zip("xyz", self.vertices.T, strict=True)), "face": dict.fromkeys(INDICES, self.faces)}
        for element in (rows.element for rows in self.text.rows):
            columns = made.get(element.name, {})
            for kind in (p for p in element.properties if p.name in columns):
                if (wrong := misfits(kind, columns[kind.name])).size:
                    problem = f"a made hull needs {wrong[0]:.6g} in the property {kind.name}, whose type cannot hold it"
                    raise AssetError(problem, where=str(self.edit.path), remedy="Convert it to OBJ first.")

    def _edit_rows(self, rows: Rows) -> Iterator[bytes]:
        data, order, properties = self.edit.document.data, self.text.header.order, rows.element.properties
        cut = [data[start:stop] for start, stop in rows.spans.tolist()]
        if rows.element.name == "vertex":
            yield from (ended(row, order) for row, keep in zip(cut, self.kept.tolist(), strict=True) if keep)
            yield from (made_row({"x": x, "y": y, "z": z}, properties, order) for x, y, z in self.vertices.tolist())
        elif rows.element.name == "face":
            yield from (
                renumbered(row, properties, order, self.number) for k, row in enumerate(cut) if k not in self.gone
            )
            yield from (made_row(dict.fromkeys(INDICES, face), properties, order) for face in self.faces.tolist())
