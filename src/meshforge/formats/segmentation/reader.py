"""Read segmented points and meshes of every kind: PLY files, arrays as NumPy leaves them (`.npz` with several, `.npy`
with one), and classes of an asset's own mesh, as PartField and SAMPart3D leave them."""

from __future__ import annotations

import tokenize
import warnings
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from meshforge.common import AssetError
from meshforge.formats.mesh_reader import read_content, read_triangles
from meshforge.formats.meshfile import obj, surface
from meshforge.formats.meshfile.ply import PlyRows, PlyText, parse_ply
from meshforge.formats.segmentation import base
from meshforge.geometry import Floats, Ints

_MESHES = (".obj", ".ply", ".stl", ".glb", ".gltf")
_MESH_REMEDY = (
    'Write the mesh with them: np.savez("NAME.points.npz", vertices=mesh.vertices, faces=mesh.faces, labels=classes)'
)

Array = npt.NDArray[Any]
_POINTS = ("points", "vertices", "verts", "xyz", "coords", "coord", "pos", "pts")
_FACES = ("faces", "triangles", "face", "tris")
_NAMES = ("names", "classes", "class_names", "label_names", "part_names", "labels_names")
_MOST = 1 << 29  # bytes of arrays that an archive unpacks to: ten million points with classes and faces
_DAMAGED = (
    *(ValueError, EOFError, KeyError, SyntaxError, TypeError, NotImplementedError, RuntimeError, MemoryError),
    *(zipfile.BadZipFile, zlib.error, tokenize.TokenError),
)
"""What NumPy and the libraries below it raise for damaged files."""
_ARRAY_REMEDY = 'Write it so: np.savez("NAME.points.npz", points=xyz, labels=classes, names=["drawer", "handle"])'


def read_segmentation(path: Path) -> base.Segmentation:
    """The points or faces in a `.ply`, `.npz` or `.npy` file, with the class of each.

    Raises AssetError naming the file: unreadable, of another kind, without classes, with wrong lengths, not finite.
    """
    match path.suffix.lower():
        case ".ply":
            return read_ply(path)
        case ".npz" | ".npy":
            return read_arrays(path)
    problem = f"{path.suffix or 'a file without suffix'} is no kind of segmented points"
    raise AssetError(problem, where=str(path), remedy=f"It is one of {', '.join(base.POINTS_SUFFIXES)}.")


def read_ply(path: Path) -> base.Segmentation:
    """The points or faces of a PLY file with their classes; those of faces count where both have some.

    Raises AssetError: damaged, or nothing in it is a class by its name.
    """
    where, data = str(path), read_content(path)
    text = parse_ply(data, where)
    names = base.parse_comments(data[: text.header.size].decode("utf-8", "replace").splitlines())
    own = [rows for kind in ("face", "vertex") for rows in text.rows if rows.element.name == kind]
    found = [(rows, key) for rows in own if (key := _find_property(rows))]
    if not found:
        raise _no_classes_error(text, where)
    rows, key = next((pair for pair in found if pair[0].element.rows), found[0])
    classes = base.to_whole_numbers(rows.values[key], where)
    of_faces = rows.element.name == "face"
    classes = classes[text.face_at] if of_faces else classes
    return base.check_segmentation(base.Segmentation(classes, text.vertices, text.faces, names, of_faces), where)


def _find_property(rows: PlyRows) -> str | None:
    """The property that is most plainly one of classes."""
    ranks = [
        (rank, p.name)
        for p in rows.element.properties
        if not p.count and (rank := base.label_rank_of(p.name)) is not None
    ]
    return min(ranks)[1] if ranks else None


def _no_classes_error(text: PlyText, where: str) -> AssetError:
    known = [p.name for rows in text.rows for p in rows.element.properties if not p.count and p.name not in "xyz"]
    holds = f"it has {', '.join(np.unique(known))}" if known else "it has none but coordinates"
    remedy = "Export the class of each point or face as a number, called `label`; colours are not read."
    return AssetError(f"no property of this file is a class by its name: {holds}", where=where, remedy=remedy)


def read_arrays(path: Path) -> base.Segmentation:
    """The points or faces in an `.npz` or `.npy` file with their classes. Raises AssetError."""
    where, found = str(path), _load_arrays(path)
    read = _from_archive(found, where) if isinstance(found, dict) else _from_array(found, where)
    return base.check_segmentation(read, where)


def _load_arrays(path: Path) -> Array | dict[str, Array]:
    """What a file holds; pickled objects, which may run anything, are not read."""
    try:
        with path.open("rb") as stream, warnings.catch_warnings(action="ignore"):  # that a header is of Python 2
            found: Array | np.lib.npyio.NpzFile = np.load(stream, allow_pickle=False)
            return _unpack_archive(found, path) if isinstance(found, np.lib.npyio.NpzFile) else found
    except _DAMAGED as error:
        problem = "these arrays cannot be read: the file is damaged, of another kind, or holds Python objects"
        raise AssetError(problem, where=str(path), remedy=_ARRAY_REMEDY) from error
    except OSError as error:
        raise AssetError(f"cannot be read: {error.strerror or error}", where=str(path)) from error


def _unpack_archive(archive: np.lib.npyio.NpzFile, path: Path) -> dict[str, Array]:
    """The arrays of an archive. Raises AssetError: they are far larger than any asset's."""
    with zipfile.ZipFile(path) as listed:
        size = sum(entry.file_size for entry in listed.infolist())
    if size > _MOST:
        problem = f"its arrays would take {size >> 20:,} MiB, more than the {_MOST >> 20} MiB that are read"
        raise AssetError(problem, where=str(path), remedy="Thin the points out.")
    return {key.lower(): archive[key] for key in archive.files}


def _from_archive(arrays: Mapping[str, Array], where: str) -> base.Segmentation:
    names = next((arrays[key] for key in _NAMES if key in arrays and arrays[key].dtype.kind in "US"), None)
    ranks = [
        (rank, key)
        for key, array in arrays.items()
        if array.ndim and array.dtype.kind in "iufb" and (rank := base.label_rank_of(key)) is not None
    ]
    points = next((arrays[key] for key in _POINTS if key in arrays), None)
    if points is None or not ranks:
        lacks = "points (or vertices)" if points is None else "labels"
        holds = ", ".join(sorted(arrays)) or "nothing"
        raise AssetError(f"it has no array {lacks}, but {holds}", where=where, remedy=_ARRAY_REMEDY)
    faces = next((arrays[key] for key in _FACES if key in arrays), np.zeros((0, 3), dtype=np.int64))
    classes, vertices = base.to_whole_numbers(arrays[min(ranks)[1]], where), _to_points(points, where)
    if 0 < len(classes) == len(vertices) == len(faces):
        problem = f"it has {len(faces):,} vertices and as many faces, so that it is open whose the classes are"
        raise AssetError(problem, where=where, remedy="Leave the faces out if the classes are of vertices.")
    of_faces = len(classes) == len(faces)
    texts = [
        str(n, "utf-8", "replace") if isinstance(n, bytes) else str(n) for n in ([] if names is None else names.flat)
    ]
    called = base.number_names(texts)
    return base.Segmentation(classes, vertices, _to_faces(faces, where), called, of_faces=of_faces)


def _from_array(array: Array, where: str) -> base.Segmentation:
    if array.dtype.names:
        ranks = [(rank, key) for key in array.dtype.names if (rank := base.label_rank_of(key)) is not None]
        if not ranks or not {"x", "y", "z"} <= set(array.dtype.names):
            holds = ", ".join(array.dtype.names)
            problem = f"it needs the fields x, y, z and label, it has {holds}"
            raise AssetError(problem, where=where, remedy=_ARRAY_REMEDY)
        points = np.column_stack([array[axis].reshape(-1) for axis in "xyz"])
        return base.Segmentation(base.to_whole_numbers(array[min(ranks)[1]], where), _to_points(points, where))
    if array.ndim == 2 and array.shape[1] == 4:
        return base.Segmentation(base.to_whole_numbers(array[:, 3], where), _to_points(array[:, :3], where))
    if array.ndim == 1 or 1 in array.shape:
        return base.Segmentation(base.to_whole_numbers(array, where))
    shape = " x ".join(map(str, array.shape)) or "no"
    problem = f"it has {shape} numbers, where a class each is expected, or x, y, z and a class each"
    raise AssetError(problem, where=where, remedy=_ARRAY_REMEDY)


def _to_points(array: Array, where: str) -> Floats:
    if array.ndim != 2 or array.shape[1] != 3 or array.dtype.kind not in "iuf":
        shape = " x ".join(map(str, array.shape)) or "no"
        raise AssetError(f"its points are {shape} values of type {array.dtype}, not three numbers each", where=where)
    return array.astype(np.float64)


def _to_faces(array: Array, where: str) -> Ints:
    if array.ndim != 2 or array.shape[1] != 3 or array.dtype.kind not in "iu":
        shape = " x ".join(map(str, array.shape)) or "no"
        problem = f"its faces are {shape} values of type {array.dtype}, not three numbers of vertices each"
        raise AssetError(problem, where=where)
    return array.astype(np.int64)


def attach_own_mesh(found: base.Segmentation, asset: Path, where: str) -> base.Segmentation:
    """Classes with the mesh that they are of; where: their file.

    Raises AssetError: the asset is no single mesh, or has another number of faces, or polygons that tools cut up
    in their own order.
    """
    if asset.suffix.lower() not in _MESHES:
        problem = f"it has classes without points, and {asset.name} is no mesh file to which they could belong"
        raise AssetError(problem, where=where, remedy=_MESH_REMEDY)
    vertices, faces, polygon = _read_mesh(asset, where)
    count, polygons = len(found.classes), int(polygon[-1]) + 1 if len(polygon) else 0
    own = replace(found, vertices=vertices, faces=faces)
    if count == polygons and count != len(vertices):
        return replace(own, classes=found.classes[polygon], of_faces=True)
    if count == len(vertices) and count != polygons:
        return own
    problem = f"it has {count:,} classes, {asset.name} has {polygons:,} faces and {len(vertices):,} vertices"
    raise AssetError(problem, where=where, remedy=_MESH_REMEDY)


def _read_mesh(asset: Path, where: str) -> tuple[Floats, Ints, Ints]:
    """The vertices (n, 3) and triangles (m, 3) of a mesh file in its order, and the polygon (m,) of each triangle."""
    if asset.suffix.lower() == ".obj":
        text = obj.parse_obj(read_content(asset), str(asset))
        return text.vertices, text.faces, np.unique(text.face_at, return_inverse=True)[1].reshape(-1)
    if asset.suffix.lower() == ".ply":
        rows = parse_ply(read_content(asset), str(asset))
        return rows.vertices, rows.faces, rows.face_at
    surfaces = read_triangles(asset)
    if len(surfaces) > 1:
        problem = f"it has classes without points, and {asset.name} has {len(surfaces)} meshes"
        raise AssetError(problem, where=where, remedy=_MESH_REMEDY)
    soup = surface.join_surfaces(surfaces)
    return soup.vertices, soup.faces, np.arange(len(soup.faces))
