"""PLY: the pieces of the one surface are the hulls, counted in file order; an edited file is written anew."""

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt

from meshforge.common import AssetError
from meshforge.formats.base import feature_of_others
from meshforge.formats.meshfile.ply import INDEX_NAMES, TYPES, PlyElement, parse_ply
from meshforge.formats.meshfile.surface import Soup, join_surfaces, stack_triangles
from meshforge.formats.plain.base import MeshFileEdit, PlainFormat
from meshforge.formats.plain.parts import MeshPart, PlainDocument
from meshforge.geometry import Floats, Ints
from meshforge.symbolic import Asset, Feature

_HEAD = 10_000  # bytes, more than headers have
_COLOR = re.compile(rb"^property\s+\w+\s+red\s*$", re.M)
_COLOR_NAME = re.compile(r"(diffuse_|ambient_|specular_)?(red|green|blue|alpha)|[rgba]")
_TYPES = {kind: name for name, kind in reversed(TYPES.items())}
_POINT = [(axis, "<f8") for axis in "xyz"]
_FACE = [(" count", "<u1"), *((f" {corner}", "<i4") for corner in range(3))]


class PlyFormat(PlainFormat):
    """PLY files, in double precision; new ones are binary."""

    name = "ply"
    title = "PLY"
    suffixes = (".ply",)

    def parse_soup(self, data: bytes, path: Path) -> Soup:
        return join_surfaces(parse_ply(data, str(path)).surfaces(str(path)))

    def apply_edit(self, edit: MeshFileEdit) -> bytes:
        """Return the file of the triangles that stay, with all numbers of their rows, and of the parts.

        Raises AssetError: it has other elements or lists, which would be lost.
        """
        file = parse_ply(edit.document.data, str(edit.path))
        vertex, face = (next(e for e in file.elements if e.name == name) for name in ("vertex", "face"))
        others = [f"rows of {e.name}" for e in file.elements if e not in (vertex, face) and e.rows]
        others += [p.name for e in (vertex, face) for p in e.properties if p.count and p.name not in INDEX_NAMES]
        if others:
            problem = f"it has {others[0]}, which an edit would lose"
            raise AssetError(problem, where=str(edit.path), remedy="Convert it to OBJ first.")
        kept = np.ones(len(file.vertices), dtype=bool)
        kept[file.faces[~edit.stays]] = False
        kept[file.faces[edit.stays]] = True
        points, made = _stack_parts(edit.parts, int(kept.sum()))
        faces = np.concatenate([(np.cumsum(kept) - 1)[file.faces[edit.stays]], made])
        points = np.concatenate([file.vertices[kept], points])
        tables = _fill_rows(points, vertex, np.flatnonzero(kept)), _fill_rows(faces, face, file.face_at[edit.stays])
        return _format_ply(*tables, is_text=file.is_text)

    def features(self, asset: Asset) -> Iterator[Feature]:
        if isinstance(asset.document, PlainDocument):
            colors = len(_COLOR.findall(asset.document.data[:_HEAD].partition(b"end_header")[0]))
            yield feature_of_others(["vertex colour"] * colors)

    def format_parts(self, parts: Sequence[MeshPart]) -> bytes:
        vertices, faces = _stack_parts(parts, 0)
        return _format_ply(_fill_rows(vertices), _fill_rows(faces))


def _stack_parts(parts: Sequence[MeshPart], start: int) -> tuple[Floats, Ints]:
    """All vertices (n, 3) of parts and their faces (m, 3), numbered from `start`."""
    return stack_triangles(((part.surface.vertices + 0.0, part.surface.faces) for part in parts), start)


def _fill_rows(
    values: Floats | Ints, element: PlyElement | None = None, kept: Ints | None = None
) -> npt.NDArray[np.void]:
    """A table of vertices or faces (n, 3), the first of which were the rows `kept` (k,) of an element.

    These keep their other numbers; of the rest, colours are full, all others zero.
    """
    own, columns = (_POINT, values) if values.dtype.kind == "f" else (_FACE, np.insert(values, 0, 3, axis=1))
    others = [p for p in (element.properties if element else ()) if not p.count and p.name not in ("x", "y", "z")]
    types = [(p.name, f"<{p.type}" if p.type[0] in "iu" else "<f8") for p in others]
    table = np.zeros(len(values), [*own, *types])
    for (name, _), column in zip(own, columns.T, strict=True):
        table[name] = column
    for name, kind in types:
        if _COLOR_NAME.fullmatch(name):
            table[name] = 1.0 if kind == "<f8" else np.iinfo(kind).max
        if element is not None and kept is not None:
            table[name][: len(kept)] = np.asarray(element.values[name])[kept]
    return table


def _format_ply(vertices: npt.NDArray[np.void], faces: npt.NDArray[np.void], *, is_text: bool = False) -> bytes:
    head = ["ply", f"format {'ascii' if is_text else 'binary_little_endian'} 1.0", "comment made by MeshForge"]
    for element, table in (("vertex", vertices), ("face", faces)):
        head.append(f"element {element} {len(table)}")
        head += [f"property list uchar int {INDEX_NAMES[0]}"] if table is faces else []
        columns = [column for column in table.dtype.names or () if column not in dict(_FACE)]
        head += [f"property {_TYPES[table.dtype[column].str[1:]]} {column}" for column in columns]
    body = b"".join(_format_text(table) if is_text else table.tobytes() for table in (vertices, faces))
    return "\n".join([*head, "end_header\n"]).encode() + body


def _format_text(table: npt.NDArray[np.void]) -> bytes:
    return "".join(" ".join(map(repr, row)) + "\n" for row in table.tolist()).encode()
