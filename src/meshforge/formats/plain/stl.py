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

    def soup(self, data: bytes, path: Path) -> Soup:
        text = parse_stl(data, str(path))
        text.surfaces(str(path))  # raises where there is nothing to read
        corners = text.corners.reshape(-1, 3)
        several = len(text.solids) > 1 and len(np.unique(text.solid)) > 1
        names = tuple((name or None) if several else None for name in text.solids)
        return Soup(corners, np.arange(len(corners)).reshape(-1, 3), text.solid, names)

    def edited(self, edit: Edit) -> bytes:
        data = edit.document.data
        text = parse_stl(data, str(edit.path))
        if text.binary:
            kept = np.frombuffer(data, RECORD, len(text.corners), HEADER)[edit.stays]
            return _binary(data[:80], [kept, _records(edit.parts)])
        return _ascii(data, text, edit)

    def made(self, parts: Sequence[Part]) -> bytes:
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
    kept, at = [], 0
    for start, stop in facet_spans(data)[~edit.stays].tolist():
        kept.append(data[at:start].rstrip(b" \t"))
        at = stop
    body = b"".join([*kept, data[at:]])
    if len(text.solids) > 1:
        solids = [b"solid %s\n%sendsolid %s\n" % (n, _facets(p), n) for p in edit.parts for n in [_word(p.name)]]
        return b"".join([body if body.endswith(b"\n") else body + b"\n", *solids])
    cut = body.lower().rfind(b"endsolid")
    cut = len(body) if cut < 0 else cut
    return body[:cut] + b"".join(map(_facets, edit.parts)) + body[cut:]


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
