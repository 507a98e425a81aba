"""The files that a mesh file needs beside it, materials, textures, buffers, found without reading its geometry."""

from __future__ import annotations

import os
import posixpath
import re
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import unquote

from meshforge.common import AssetError, is_file
from meshforge.formats.meshfile.gltf_document import entries, parse_json, report_damage

_LIBRARY = re.compile(rb"mtllib[ \t]+([^\r\n]+)")  # at the start of a line; asking for that here takes 50 times as long
_MAP = re.compile(rb"^[ \t]*(?:map_\w+|bump|disp|decal|refl|norm)[ \t]+([^\r\n]+)", re.M | re.I)
_IMAGE = re.compile(rb"<init_from[^>]*>\s*(?:<ref>)?\s*([^<]+?)\s*<")
_GLB_HEADER = 20  # bytes: magic, version, length; length and type of the chunk of JSON


def find_companions(mesh: Path) -> dict[str, Path]:
    """The files beside a mesh file that it refers to and that are there, by their path relative to its folder.

    An OBJ's material libraries and their textures, a Collada file's images, a glTF file's buffers and images.
    Never raises for what the file holds: what cannot be understood has no companions.
    """
    found: dict[str, Path] = {}
    for reference in _find_references(mesh):
        _add_files(found, mesh.parent, "", reference)
    for key, library in [(k, p) for k, p in found.items() if p.suffix.lower() == ".mtl"]:
        for reference in _find_matches(_MAP, _read_or_empty(library)):
            _add_files(found, mesh.parent, posixpath.dirname(key), reference)
    return found


def add_copy(copies: dict[str, Path], place: str, path: Path, remedy: str = "Rename one of them.") -> None:
    """Copy a file, with its companions, to a place in an output. Raises AssetError where another file goes there."""
    if copies.setdefault(place, path) != path:
        raise AssetError(f"{copies[place]} and {path} would both become {place!r}", where=str(path), remedy=remedy)
    for key, companion in find_companions(path).items():
        copies.setdefault(posixpath.normpath(posixpath.join(posixpath.dirname(place), key)), companion)


def note_absolute(reference: str) -> str:
    """The note on a file that is not copied."""
    return f"{reference!r} is an absolute reference: the file is used where it is, not copied"


def _find_references(mesh: Path) -> Iterator[str]:
    match mesh.suffix.lower():
        case ".obj":
            yield from _find_libraries(_read_or_empty(mesh))
        case ".dae":
            yield from (unquote(text.removeprefix("file://")) for text in _find_matches(_IMAGE, _read_or_empty(mesh)))
        case ".gltf" | ".glb":
            yield from map(unquote, _find_uris(mesh))


def _find_libraries(data: bytes) -> Iterator[str]:
    for found in _LIBRARY.finditer(data):
        if not data[data.rfind(b"\n", 0, found.start()) + 1 : found.start()].strip(b" \t"):
            yield found[1].decode("utf-8", "replace").strip()


def _find_matches(pattern: re.Pattern[bytes], data: bytes) -> Iterator[str]:
    for found in pattern.finditer(data):
        yield found[1].decode("utf-8", "replace").strip()


def _find_uris(mesh: Path) -> Iterator[str]:
    data = _read_or_empty(mesh)
    if data[:4] == b"glTF":
        data = data[_GLB_HEADER : _GLB_HEADER + int.from_bytes(data[12:16], "little")]
    try:
        with report_damage(str(mesh)):
            scene = parse_json(data)
            things = [thing for kind in ("buffers", "images") for thing in entries(scene, kind)]
            uris = [thing["uri"] for thing in things if "uri" in thing]
    except AssetError:
        return
    yield from (uri for uri in uris if isinstance(uri, str) and not uri.startswith("data:"))


def _add_files(found: dict[str, Path], folder: Path, inside: str, reference: str) -> None:
    """Add what a reference names: a file whose name may hold blanks, else those of its words that are files.

    A line of an OBJ may name several libraries; options may stand before the name of a texture.
    """
    for text in (reference, *reference.split()):
        key = posixpath.normpath(posixpath.join(inside, text.replace("\\", "/")))
        path = Path(os.path.normpath(folder / key))
        if text and not posixpath.isabs(key) and "\0" not in key and is_file(path):
            found.setdefault(key, path)
            if text == reference:
                return


def _read_or_empty(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError:
        return b""
