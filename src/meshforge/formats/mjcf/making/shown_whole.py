"""Which mesh files MuJoCo shows whole, so that they can go into a model as they are."""

from __future__ import annotations

import re
from pathlib import Path

from meshforge.errors import MeshForgeError
from meshforge.formats.triangles import contents

_FACE = re.compile(rb"^[ \t]*f[ \t]+([^\r\n#]*)", re.M)
_GROUP = re.compile(rb"^[ \t]*[og](?=\s|$)", re.M)
_NUMBER = re.compile(rb"[+-]?\d+")
_HEADER, _RECORD = 84, 50  # bytes of a binary STL: before the first triangle, and each
_MOST = 200_000  # triangles of an STL that MuJoCo takes
_LEAST = 4  # vertices


def shown_whole(path: Path) -> bool:
    """Whether MuJoCo shows all triangles of a mesh file.

    Of an OBJ it shows the first group alone, and refuses corners of different kinds; of STLs it takes binary ones.
    """
    try:
        data = contents(path)
    except MeshForgeError:
        return False
    match path.suffix.lower():
        case ".obj":
            return _is_one_group(data) and _is_uniform(data)
        case ".stl":
            count = int.from_bytes(data[_HEADER - 4 : _HEADER], "little")
            return len(data) == _HEADER + count * _RECORD and _LEAST <= 3 * count <= 3 * _MOST
        case _:
            return False


def _is_one_group(data: bytes) -> bool:
    """Whether no group begins after the first face of an OBJ."""
    first = _FACE.search(data)
    return first is not None and b"\\\n" not in data and _GROUP.search(data, first.end()) is None


def _is_uniform(data: bytes) -> bool:
    """Whether all corners of an OBJ name vertices, texture coordinates and normals alike, of enough vertices."""
    kinds = {_NUMBER.sub(b"1", corner) for face in _FACE.findall(data) for corner in face.split()}
    enough = len(re.findall(rb"^[ \t]*v[ \t]", data[:_MOST], re.M)) >= _LEAST
    return len(kinds) == 1 and enough
