"""Read VRML 2.0 as CoACD, V-HACD and MeshLab write it: face sets, each with its own points, none of them moved."""

import re
from collections.abc import Iterator

import numpy as np

from meshforge.common import AssetError
from meshforge.formats.meshfile.surface import RawSurface, check_surfaces, cut_fans
from meshforge.geometry import Floats, Ints

_ASIDE = re.compile(r'"(?:\\.|[^"\\])*"|#[^\n\r]*')  # texts and comments
_REFUSED = re.compile(
    r"\b(USE|PROTO|EXTERNPROTO|Inline|Box|Sphere|Cylinder|Cone|Extrusion|ElevationGrid)\b"
    r"|\b(translation|rotation|scale)\s+([^\s,A-Za-z{}\[\]][^A-Za-z{}\[\]]*)"
)
_NAME = re.compile(r"\bDEF\s+(\S+)\s+(?:Shape|Group|Transform)\b")
_POINTS = re.compile(r"\bCoordinate\s*\{\s*point\s*\[([^\]]*)\]")
_CORNERS = re.compile(r"\bcoordIndex\s*\[([^\]]*)\]")
_MIRRORED = re.compile(r"\bccw\s+FALSE\b")
_OTHER = "Export it as OBJ."


def parse_vrml(data: bytes, where: str) -> list[RawSurface]:
    """Return the surfaces of a VRML 2.0 file. Raises AssetError: not such a file, or one with more than face sets."""
    text = data.decode("utf-8-sig", "replace")
    if not text.startswith("#VRML V2.0"):
        raise AssetError("this is no VRML 2.0 file", where=where, remedy=_OTHER)
    text = _ASIDE.sub(" ", text)
    if any(text.count(opened) > text.count(closed) for opened, closed in ("{}", "[]")):
        raise AssetError("the file is cut short", where=where, remedy="Export it again.")
    for word, field, numbers in _REFUSED.findall(text):
        if not word and not _moves(field, numbers):
            continue
        problem = f"{word} is not read, only face sets are" if word else f"a shape has a {field}, which is not read"
        raise AssetError(problem, where=where, remedy=_OTHER)
    try:
        found = list(_list_surfaces(text))
    except (ValueError, OverflowError) as error:
        raise AssetError(str(error), where=where, remedy="Fix or export it again.") from error
    return check_surfaces(found, where)


def _moves(field: str, numbers: str) -> bool:
    """Whether the numbers of a field move, turn or scale what is below."""
    try:
        values = [float(word) for word in re.split(r"[\s,]+", numbers.strip(" \t\r\n,"))]
    except ValueError:
        return True
    still = {"translation": [0.0] * 3, "scale": [1.0] * 3, "rotation": [*values[:3], 0.0]}
    return values != still[field]


def _list_surfaces(text: str) -> Iterator[RawSurface]:
    before, *sets = re.split(r"\bIndexedFaceSet\b", text)
    for each in sets:
        names, points, corners = _NAME.findall(before), _POINTS.search(each), _CORNERS.search(each)
        before = each
        if points and corners:
            vertices = _to_numbers(points[1])
            if len(vertices) % 3:
                raise ValueError("its points are not all of three numbers")
            faces = _cut_faces(_to_numbers(corners[1]), len(vertices) // 3)
            ordered = faces[:, ::-1] if _MIRRORED.search(each) else faces
            yield RawSurface(names[-1] if names else None, vertices.reshape(-1, 3), ordered)


def _to_numbers(text: str) -> Floats:
    words = text.replace(",", " ").split()
    if odd := next((word for word in words if not re.fullmatch(r"[-+.\deE]+", word)), None):
        raise ValueError(f"a number was expected where {odd!r} stands")
    return np.array(list(map(float, words)))


def _cut_faces(indices: Floats, count: int) -> Ints:
    if (indices != np.floor(indices)).any() or ((indices < -1) | (indices >= count)).any():
        raise ValueError(f"a face names a vertex that is not there, there are {count}")
    ends = np.concatenate([[-1], np.flatnonzero(indices == -1), [len(indices)]])
    return cut_fans(indices[indices >= 0].astype(np.int64), np.diff(ends) - 1)[1]
