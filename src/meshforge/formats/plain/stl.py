"""STL: the pieces of a soup of triangles are the hulls, counted in file order, since the format has no names."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt

from meshforge.formats.meshfile import Soup
from meshforge.formats.meshfile.stl import HEADER, RECORD, StlText, facet_spans, parse_stl
from meshforge.formats.plain.parts import Part, corners_of
from meshforge.formats.plain.plain import Edit, PlainFormat
from meshforge.geometry import Floats

_TITLE = b"MeshForge".ljust(80, b" ")  # must not begin with "solid", the mark of ASCII files


class Stl(PlainFormat):
    """STL files, binary and ASCII; new ones are binary."""

    name = "stl"
    title = "STL"
    suffixes = (".stl",)

    def parse_soup(self, data: bytes, path: Path) -> Soup:
        text = parse_stl(data, str(path))
        text.surfaces(str(path))  # raises where there is nothing to read
        corners = text.corners.reshape(-1, 3)
        several = len(text.solids) > 1 and len(np.unique(text.solid)) > 1
        names = tuple((name or None) if several else None for name in text.solids)
        return Soup(corners, np.arange(len(corners)).reshape(-1, 3), text.solid, names)

    def apply_edit(self, edit: Edit) -> bytes:
        data = edit.document.data
        text = parse_stl(data, str(edit.path))
        if text.binary:
            kept = np.frombuffer(data, RECORD, len(text.corners), HEADER)[edit.stays]
            return _binary(data[:80], [kept, _records(edit.parts)])
        return _ascii(data, text, edit)

    def format_parts(self, parts: Sequence[Part]) -> bytes:
        return _binary(_TITLE, [_records(parts)])


def _binary(title: bytes, records: Sequence[npt.NDArray[np.void]]) -> bytes:
    count = sum(map(len, records))
    return title + count.to_bytes(4, "little") + b"".join(r.tobytes() for r in records)


def _normals(corners: Floats) -> Floats:
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    return normals / np.where(lengths > 0, lengths, 1.0) + 0.0


def _records(parts: Sequence[Part]) -> npt.NDArray[np.void]:
    corners = corners_of(parts)
    records = np.zeros(len(corners), RECORD)
    records["normal"] = _normals(corners)
    records["corners"] = corners
    return records


def _ascii(data: bytes, text: StlText, edit: Edit) -> bytes:
    """The text without the facets that go, and with those of the parts: in the one solid, or in solids of their own."""
    spans, kept, at = facet_spans(data), [], 0
    for start, stop in spans[~edit.stays].tolist():
        kept.append(data[at:start].rstrip(b" \t"))
        at = stop
    if len(text.solids) > 1:
        end = len(data)
        made = b"".join(b"solid %s\n%sendsolid %s\n" % (n, _facets(p), n) for p in edit.parts for n in [_word(p.name)])
    else:
        end = _end_of_solid(data, int(spans[-1, 1]))
        made = b"".join(map(_facets, edit.parts))
    body = b"".join([*kept, data[at:end]])
    gap = b"\n" if made and not body.rstrip(b" \t").endswith((b"\n", b"\r")) else b""
    return body + gap + made + data[end:]


def _end_of_solid(data: bytes, at: int) -> int:
    """Where the last solid ends, whose last facet ends at `at`."""
    found = data[at:].lower().find(b"endsolid")
    return len(data) if found < 0 else at + found


def _word(name: str) -> bytes:
    return " ".join(name.split()).encode("utf-8", "surrogateescape")


def _facets(part: Part) -> bytes:
    corners = corners_of([part])
    lines = []
    for normal, triangle in zip(_normals(corners).tolist(), corners.tolist(), strict=True):
        lines.append("facet normal {!r} {!r} {!r}\n  outer loop".format(*normal))
        lines += ["    vertex {!r} {!r} {!r}".format(*corner) for corner in triangle]
        lines.append("  endloop\nendfacet")
    return "".join(line + "\n" for line in lines).encode()
