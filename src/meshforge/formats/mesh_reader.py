"""Read a mesh file of any kind as triangles; refuse files whose bytes are something else than their suffix says."""

import errno
import os
import re
import tomllib
from collections.abc import Sequence
from pathlib import Path

from meshforge.common import AssetError, is_beyond_reach
from meshforge.formats.meshfile import dae, gltf_scene, obj, ply, stl, vrml
from meshforge.formats.meshfile.surface import RawSurface, join_surfaces
from meshforge.geometry import Piece, split_pieces

READABLE_MESH_SUFFIXES = (".obj", ".stl", ".ply", ".dae", ".glb", ".gltf", ".wrl")
"""The mesh files that `read_triangles` reads."""

_HEAD = 1000  # bytes that tell what a file is
_STL_HEADER, _STL_RECORD = 84, 50
_XML = re.compile(rb"(?:\s|<\?.*?\?>|<!--.*?-->|<!DOCTYPE[^>\[]*>)*<([A-Za-z][\w.:-]*)", re.S)
_CONFLICT = re.compile(rb"^<{7} .*?^={7}\r?$", re.M | re.S)
_MARK = b"\xef\xbb\xbf"  # the byte order mark of UTF-8

_LOADED = "The download went wrong: take the raw file, not the page that shows it."
_KINDS = tomllib.loads(Path(__file__).with_name("file_kinds.toml").read_text(encoding="utf-8"))
_NEVER_XML = (".obj", ".stl", ".ply", ".wrl", ".glb", ".gltf")

Mismatch = tuple[str, str | None]


def read_triangles(path: Path) -> list[RawSurface]:
    """Return the surfaces of an OBJ, STL, PLY, Collada, glTF, GLB or VRML file, node transforms applied.

    Raises AssetError naming the file, and the line where there is one: unreadable, damaged, empty, or not finite.
    """
    if path.suffix.lower() not in READABLE_MESH_SUFFIXES:
        raise _unknown_kind_error(path)
    return parse_surfaces(read_content(path), path)


def read_content(path: Path) -> bytes:
    """Return the bytes of a file.

    Raises AssetError: it is not there, may not be read, is no regular file, or plainly is of another kind.
    """
    try:
        if is_beyond_reach(path):
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT))
        if path.exists() and not path.is_file():  # a pipe would be waited for, a device may never end
            raise AssetError("cannot be read: it is a folder, a pipe or a device", where=str(path))
        data = path.read_bytes()
    except OSError as error:
        raise AssetError(f"cannot be read: {error.strerror}", where=str(path)) from error
    refuse_lookalike(data, path)
    return data


def parse_surfaces(data: bytes, path: Path) -> list[RawSurface]:
    """Return the surfaces in the bytes of the mesh file at a path. Raises AssetError."""
    where = str(path)
    match path.suffix.lower():
        case ".obj":
            return obj.parse_obj(data, where).surfaces(where)
        case ".stl":
            return stl.parse_stl(data, where).surfaces(where)
        case ".ply":
            return ply.parse_ply(data, where).surfaces(where)
        case ".dae":
            return dae.parse_dae(data, where)
        case ".glb" | ".gltf":
            return gltf_scene.parse_gltf(data, path)
        case ".wrl":
            return vrml.parse_vrml(data, where)
    raise _unknown_kind_error(path)


def split_into_pieces(surfaces: Sequence[RawSurface], *, name: str) -> list[Piece]:
    """Return the pieces of all surfaces of a file together; a piece's `group` is the index of its surface."""
    if not surfaces:
        return []
    soup = join_surfaces(surfaces)
    return split_pieces(soup.vertices, soup.faces, name=name, groups=soup.group)


def _unknown_kind_error(path: Path) -> AssetError:
    kind = path.suffix or "a file without suffix"
    remedy = f"It reads {', '.join(READABLE_MESH_SUFFIXES)}."
    return AssetError(f"{kind} is no mesh file that MeshForge reads", where=str(path), remedy=remedy)


def refuse_lookalike(data: bytes, path: Path) -> None:
    """Raise AssetError where the bytes of a file plainly are something else than its suffix says."""
    problem, remedy = _check_kind(data, path.suffix.lower()) or (None, None)
    if problem:
        raise AssetError(problem, where=str(path), remedy=remedy)


def is_binary_stl(data: bytes) -> bool:
    """Return whether the length of a file is just what a binary STL's count of triangles says."""
    if len(data) <= _STL_HEADER:
        return False
    count = int.from_bytes(data[80:_STL_HEADER], "little")
    return count > 0 and len(data) == _STL_HEADER + _STL_RECORD * count


def _check_kind(data: bytes, suffix: str) -> Mismatch | None:
    if not data:
        return "the file is empty", None
    if not data.strip(b"\0"):
        return "the file holds nothing but zero bytes", "The copy or download broke off: fetch it again."
    if is_binary_stl(data):
        return None if suffix == ".stl" else _wrong_suffix("a binary STL file", ".stl")
    if suffix in _NEVER_XML and data[:2] in (b"\xff\xfe", b"\xfe\xff"):  # XML files may be in UTF-16
        return "this is text in UTF-16", "Save it as plain text (ASCII or UTF-8)."
    if found := _check_signature(data, suffix) or _check_markup(data, suffix):
        return found
    if b"<<<<<<< " in data and _CONFLICT.search(data):
        return "a merge of two versions of this file is not finished", "Take one of them: git checkout --ours FILE."
    return None


def _check_signature(data: bytes, suffix: str) -> Mismatch | None:
    for known in _KINDS["signatures"]:
        if re.match(rb"(?:\xef\xbb\xbf)?\s*" + known["begins"].encode(), data[:_HEAD], re.S | re.I):
            name, suffixes, remedy = known["name"], known.get("suffixes", ()), known.get("remedy")
            if suffix in suffixes:
                return None
            return (f"this is {name}", remedy) if remedy or not suffixes else _wrong_suffix(name, suffixes[0])
    return None


def _check_markup(data: bytes, suffix: str) -> Mismatch | None:
    if suffix not in _NEVER_XML or not (root := _XML.match(data[:_HEAD].removeprefix(_MARK))):
        return None
    tag = root[1].decode("ascii", "replace")
    name, right, remedy = _KINDS["roots"].get(tag.lower(), (f"XML, its root element is <{tag}>", "", _LOADED))
    return _wrong_suffix(name, right) if right else (f"this is {name}", remedy)


def _wrong_suffix(name: str, suffix: str) -> Mismatch:
    return f"this is {name} under another suffix", f"Rename it to {suffix}."
