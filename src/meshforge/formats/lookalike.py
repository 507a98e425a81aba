"""What the bytes of a file look like, whatever its name says: pointers, web pages, archives, other formats."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from meshforge.errors import AssetError

_HEAD = 1000  # bytes that tell what a file is
_STL_HEADER, _STL_RECORD = 84, 50
_XML = re.compile(rb"(?:\s|<\?.*?\?>|<!--.*?-->|<!DOCTYPE[^>\[]*>)*<([A-Za-z][\w.:-]*)", re.S)
_CONFLICT = re.compile(rb"^<{7} .*?^={7}\r?$", re.M | re.S)
_MARK = b"\xef\xbb\xbf"  # the byte order mark of UTF-8


@dataclass(frozen=True, slots=True)
class Look:
    """A kind of file: how it begins, its name for people, the suffixes under which it is right, and the remedy.

    Without a remedy, it is to be renamed to the first of its suffixes.
    """

    begins: re.Pattern[bytes]
    name: str
    suffixes: tuple[str, ...] = ()
    remedy: str | None = None


def _look(begins: bytes, name: str, *suffixes: str, remedy: str | None = None) -> Look:
    return Look(re.compile(rb"(?:\xef\xbb\xbf)?\s*" + begins, re.S | re.I), name, suffixes, remedy)


_FETCH = "Fetch the file itself: git lfs pull."
_OTHER = "MeshForge does not read such files: export it as OBJ."
_LOADED = "The download went wrong: take the raw file, not the page that shows it."
_LOOKS = (
    _look(rb"version https://git-lfs\.github\.com/spec", "a Git LFS pointer, not the file itself", remedy=_FETCH),
    _look(rb"<!doctype html|<html", "a web page", remedy=_LOADED),
    _look(rb"\x1f\x8b", "a file compressed by gzip", remedy="Unpack it first (gunzip)."),
    _look(rb"PK\x03\x04", "a ZIP archive", ".usdz", ".zae", remedy="Unpack it first (unzip)."),
    _look(rb"7z\xbc\xaf|Rar!", "a compressed archive", remedy="Unpack it first."),
    _look(rb"\x89PNG|\xff\xd8\xff|GIF8|BM.{4}\0\0\0\0", "a picture"),
    _look(rb"%PDF-", "a PDF document"),
    _look(rb"glTF", "a binary glTF file", ".glb", ".gltf"),
    _look(rb"ply\s+(?:format|comment|element|obj_info)\b", "a PLY file", ".ply"),
    _look(rb"#VRML V", "a VRML file", ".wrl"),
    _look(rb"solid\b.*\bfacet\b", "an ASCII STL file", ".stl"),
    _look(rb"n?OFF\s+[\d#]", "an OFF file", remedy=_OTHER),
    _look(rb"Kaydara FBX|; FBX", "an FBX file", remedy=_OTHER),
    _look(rb"BLENDER", "a Blender file", remedy=_OTHER),
    _look(rb"PXR-USDC|#usda", "a USD file", ".usd", ".usda", ".usdc"),
    _look(rb"(?:#[^\n]*\n\s*)*(?:mtllib\s|o\s|g\s|v\s+[-\d.])", "an OBJ file", ".obj"),
    _look(rb"\{\s*\"asset\"", "a glTF file", ".gltf"),
    _look(rb"\{\s*[\"}]", "JSON, not a mesh", ".gltf", remedy=_LOADED),
)
_ROOTS = {
    "collada": ("a Collada file", ".dae"),
    "robot": ("a URDF file", ".urdf"),
    "mujoco": ("an MJCF file", ".xml"),
    "mujocoinclude": ("an MJCF file", ".xml"),
    "sdf": ("an SDF file", ".sdf"),
    "x3d": ("an X3D file", ""),
    "error": ("the error of a web server", ""),
}
_MESHES = (".obj", ".stl", ".ply", ".wrl", ".glb", ".gltf")
"""The suffixes of files that never are XML."""


def refuse_lookalike(data: bytes, path: Path) -> None:
    """Raise AssetError where the bytes of a file plainly are something else than its suffix says."""
    suffix = path.suffix.lower()
    problem, remedy = _nothing(data) or _other(data, suffix) or (None, None)
    if problem:
        raise AssetError(problem, where=str(path), remedy=remedy)


def is_binary_stl(data: bytes) -> bool:
    """Whether the length of a file is just what a binary STL's count of triangles says."""
    if len(data) <= _STL_HEADER:
        return False
    count = int.from_bytes(data[80:_STL_HEADER], "little")
    return count > 0 and len(data) == _STL_HEADER + _STL_RECORD * count


Found = tuple[str, str | None]


def _nothing(data: bytes) -> Found | None:
    if not data:
        return "the file is empty", None
    if not data.strip(b"\0"):
        return "the file holds nothing but zero bytes", "The copy or download broke off: fetch it again."
    return None


def _other(data: bytes, suffix: str) -> Found | None:
    binary = is_binary_stl(data)
    if binary:
        return None if suffix == ".stl" else _misnamed("a binary STL file", ".stl")
    checks: tuple[Callable[[bytes, str], Found | None], ...] = (_wide, _known, _markup, _conflict)
    return next((found for check in checks if (found := check(data, suffix))), None)


def _wide(data: bytes, suffix: str) -> Found | None:
    """Text in UTF-16, which XML files may be."""
    if suffix in _MESHES and data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return "this is text in UTF-16", "Save it as plain text (ASCII or UTF-8)."
    return None


def _known(data: bytes, suffix: str) -> Found | None:
    for look in _LOOKS:
        if look.begins.match(data[:_HEAD]):
            if suffix in look.suffixes:
                return None
            if look.remedy or not look.suffixes:
                return f"this is {look.name}", look.remedy
            return _misnamed(look.name, look.suffixes[0])
    return None


def _markup(data: bytes, suffix: str) -> Found | None:
    if suffix not in _MESHES or not (root := _XML.match(data[:_HEAD].removeprefix(_MARK))):
        return None
    tag = root[1].decode("ascii", "replace")
    name, right = _ROOTS.get(tag.lower(), (f"XML, its root element is <{tag}>", ""))
    return _misnamed(name, right) if right else (f"this is {name}", _OTHER if tag.lower() == "x3d" else _LOADED)


def _conflict(data: bytes, suffix: str) -> Found | None:
    if b"<<<<<<< " in data and _CONFLICT.search(data):
        return "a merge of two versions of this file is not finished", "Take one of them: git checkout --ours FILE."
    return None


def _misnamed(name: str, suffix: str) -> Found:
    return f"this is {name} under another suffix", f"Rename it to {suffix}."
