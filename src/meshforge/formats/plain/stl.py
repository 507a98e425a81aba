"""The formats of triangles that only list them: STL, whose pieces are the hulls, counted in file order since it has no
names; and VRML 2.0, which CoACD writes, a shape a hull: only read, and written back as it is."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt

from meshforge.common import AssetError
from meshforge.formats.base import Output
from meshforge.formats.meshfile.stl import HEADER, RECORD, StlText, parse_stl
from meshforge.formats.meshfile.surface import Soup, join_surfaces
from meshforge.formats.meshfile.vrml import parse_vrml
from meshforge.formats.plain.base import MeshFileEdit, PlainFormat
from meshforge.formats.plain.parts import MeshPart, corners_of
from meshforge.geometry import Floats
from meshforge.symbolic import Asset

_TITLE = b"MeshForge".ljust(80, b" ")  # must not begin with "solid", the mark of ASCII files


class StlFormat(PlainFormat):
    """STL files, binary and ASCII; new ones are binary."""

    name = "stl"
    title = "STL"
    suffixes = (".stl",)

    def parse_soup(self, data: bytes, path: Path) -> Soup:
        return join_surfaces(parse_stl(data, str(path)).surfaces(str(path)))

    def apply_edit(self, edit: MeshFileEdit) -> bytes:
        data = edit.document.data
        text = parse_stl(data, str(edit.path))
        if text.binary:
            kept = np.frombuffer(data, RECORD, len(text.corners), HEADER)[edit.stays]
            return _format_binary(data[:80], [kept, _make_records(edit.parts)])
        return _format_ascii(text, edit)

    def format_parts(self, parts: Sequence[MeshPart]) -> bytes:
        return _format_binary(_TITLE, [_make_records(parts)])


def _format_binary(title: bytes, records: Sequence[npt.NDArray[np.void]]) -> bytes:
    count = sum(map(len, records))
    return title + count.to_bytes(4, "little") + b"".join(r.tobytes() for r in records)


def _normals_of(corners: Floats) -> Floats:
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    return normals / np.where(lengths > 0, lengths, 1.0) + 0.0


def _make_records(parts: Sequence[MeshPart]) -> npt.NDArray[np.void]:
    corners = corners_of(parts)
    records = np.zeros(len(corners), RECORD)
    records["normal"] = _normals_of(corners)
    records["corners"] = corners
    return records


def _format_ascii(text: StlText, edit: MeshFileEdit) -> bytes:
    """The facets that stay and those of the parts, in the one solid of a file, or in solids of their own."""
    kept = [(name, text.corners[edit.stays & (text.solid == k)]) for k, name in enumerate(text.solids)]
    made = [(" ".join(part.name.split()), corners_of([part])) for part in edit.parts]
    if len(kept) == 1:
        made, kept = [], [(kept[0][0], np.concatenate([kept[0][1], *(corners for _, corners in made)]))]
    lines: list[str] = []
    for name, corners in (solid for solid in (*kept, *made) if len(solid[1])):
        lines.append(f"solid {name}")
        for normal, triangle in zip(_normals_of(corners).tolist(), corners.tolist(), strict=True):
            lines.append("facet normal {!r} {!r} {!r}\n  outer loop".format(*normal))
            lines += ["    vertex {!r} {!r} {!r}".format(*corner) for corner in triangle]
            lines.append("  endloop\nendfacet")
        lines.append(f"endsolid {name}")
    return "".join(line + "\n" for line in lines).encode("utf-8", "surrogateescape")


class WrlFormat(PlainFormat):
    """VRML files, to be read only."""

    name = "wrl"
    title = "VRML"
    suffixes = (".wrl",)
    writable = False

    def parse_soup(self, data: bytes, path: Path) -> Soup:
        return join_surfaces(parse_vrml(data, str(path)))

    def apply_edit(self, edit: MeshFileEdit) -> bytes:
        raise _read_only_error(str(edit.path))

    def format_parts(self, parts: Sequence[MeshPart]) -> bytes:
        raise _read_only_error(None)

    def create(self, asset: Asset, name: str) -> Output:
        raise _read_only_error(str(asset.path))


def _read_only_error(where: str | None) -> AssetError:
    return AssetError("VRML files are read, not written", where=where, remedy="Write an .obj, which keeps the names.")
