"""Triangles of a mesh file of any kind that a description refers to: named surfaces, and their pieces."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from meshforge.errors import AssetError
from meshforge.formats.lookalike import refuse_lookalike
from meshforge.formats.meshfile import RawSurface, joined
from meshforge.geometry import Piece, pieces

MESH_SUFFIXES = (".obj", ".stl", ".ply", ".dae", ".glb", ".gltf", ".wrl")
"""The mesh files that `read_triangles` reads."""


def read_triangles(path: Path) -> list[RawSurface]:
    """The surfaces of an OBJ, STL, PLY, Collada, glTF, GLB or VRML file, node transforms applied.

    Raises AssetError naming the file, and the line where there is one: unreadable, damaged, empty, or not finite.
    """
    if path.suffix.lower() not in MESH_SUFFIXES:
        raise _unknown(path)
    return surfaces_in(contents(path), path)


def contents(path: Path) -> bytes:
    """The bytes of a file.

    Raises AssetError: it is not there, may not be read, is no regular file, or plainly is of another kind.
    """
    try:
        if path.exists() and not path.is_file():  # a pipe would be waited for, a device may never end
            raise AssetError("cannot be read: it is a folder, a pipe or a device", where=str(path))
        data = path.read_bytes()
    except OSError as error:
        raise AssetError(f"cannot be read: {error.strerror}", where=str(path)) from error
    refuse_lookalike(data, path)
    return data


def surfaces_in(data: bytes, path: Path) -> list[RawSurface]:
    """The surfaces in the bytes of the mesh file at a path. Raises AssetError."""
    where = str(path)
    match path.suffix.lower():
        case ".obj":
            from meshforge.formats.meshfile.obj import parse_obj

            return parse_obj(data, where).surfaces(where)
        case ".stl":
            from meshforge.formats.meshfile.stl import parse_stl

            return parse_stl(data, where).surfaces(where)
        case ".ply":
            from meshforge.formats.meshfile.ply import parse_ply

            return parse_ply(data, where).surfaces(where)
        case ".dae":
            from meshforge.formats.meshfile.dae import parse_dae

            return parse_dae(data, where)
        case ".glb" | ".gltf":
            from meshforge.formats.meshfile.gltf import parse_gltf

            return parse_gltf(data, path)
        case ".wrl":
            from meshforge.formats.meshfile.vrml import parse_vrml

            return parse_vrml(data, where)
    raise _unknown(path)


def pieces_of(surfaces: Sequence[RawSurface], *, name: str) -> list[Piece]:
    """The pieces of all surfaces of a file together; a piece's `group` is the index of its surface."""
    if not surfaces:
        return []
    soup = joined(surfaces)
    return pieces(soup.vertices, soup.faces, name=name, groups=soup.group)


def _unknown(path: Path) -> AssetError:
    kind = path.suffix or "a file without suffix"
    remedy = f"It reads {', '.join(MESH_SUFFIXES)}."
    return AssetError(f"{kind} is no mesh file that MeshForge reads", where=str(path), remedy=remedy)
