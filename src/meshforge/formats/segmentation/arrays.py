"""Segmented points and meshes as NumPy leaves them: `.npz` with several arrays, `.npy` with one."""

from __future__ import annotations

import tokenize
import warnings
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from meshforge.common import AssetError
from meshforge.formats.segmentation.base import Segmentation, check_segmentation, label_rank_of, to_whole_numbers
from meshforge.formats.segmentation.class_names import number_names
from meshforge.geometry import Floats, Ints

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
_REMEDY = 'Write it so: np.savez("NAME.points.npz", points=xyz, labels=classes, names=["drawer", "handle"])'


def read_arrays(path: Path) -> Segmentation:
    """The points or faces in an `.npz` or `.npy` file with their classes. Raises AssetError."""
    where = str(path)
    found = _load(path)
    return check_segmentation(
        _from_archive(found, where) if isinstance(found, dict) else _from_array(found, where), where
    )


def _load(path: Path) -> Array | dict[str, Array]:
    """What a file holds; pickled objects, which may run anything, are not read."""
    try:
        with path.open("rb") as stream, warnings.catch_warnings(action="ignore"):  # that a header is of Python 2
            found: Array | np.lib.npyio.NpzFile = np.load(stream, allow_pickle=False)
            return _unpack(found, path) if isinstance(found, np.lib.npyio.NpzFile) else found
    except _DAMAGED as error:
        problem = "these arrays cannot be read: the file is damaged, of another kind, or holds Python objects"
        raise AssetError(problem, where=str(path), remedy=_REMEDY) from error
    except OSError as error:
        raise AssetError(f"cannot be read: {error.strerror or error}", where=str(path)) from error


def _unpack(archive: np.lib.npyio.NpzFile, path: Path) -> dict[str, Array]:
    """The arrays of an archive. Raises AssetError: they are far larger than any asset's."""
    with zipfile.ZipFile(path) as listed:
        size = sum(entry.file_size for entry in listed.infolist())
    if size > _MOST:
        problem = f"its arrays would take {size >> 20:,} MiB, more than the {_MOST >> 20} MiB that are read"
        raise AssetError(problem, where=str(path), remedy="Thin the points out.")
    return {key.lower(): archive[key] for key in archive.files}


def _from_archive(arrays: Mapping[str, Array], where: str) -> Segmentation:
    names = next((arrays[key] for key in _NAMES if key in arrays and arrays[key].dtype.kind in "US"), None)
    ranks = [
        (rank, key)
        for key, array in arrays.items()
        if array.ndim and array.dtype.kind in "iufb" and (rank := label_rank_of(key)) is not None
    ]
    points = next((arrays[key] for key in _POINTS if key in arrays), None)
    if points is None or not ranks:
        lacks = "points (or vertices)" if points is None else "labels"
        holds = ", ".join(sorted(arrays)) or "nothing"
        raise AssetError(f"it has no array {lacks}, but {holds}", where=where, remedy=_REMEDY)
    faces = next((arrays[key] for key in _FACES if key in arrays), np.zeros((0, 3), dtype=np.int64))
    classes, vertices = to_whole_numbers(arrays[min(ranks)[1]], where), _to_points(points, where)
    if 0 < len(classes) == len(vertices) == len(faces):
        problem = f"it has {len(faces):,} vertices and as many faces, so that it is open whose the classes are"
        raise AssetError(problem, where=where, remedy="Leave the faces out if the classes are of vertices.")
    of_faces = len(classes) == len(faces)
    return Segmentation(classes, vertices, _to_faces(faces, where), _name_classes(names), of_faces=of_faces)


def _from_array(array: Array, where: str) -> Segmentation:
    if array.dtype.names:
        ranks = [(rank, key) for key in array.dtype.names if (rank := label_rank_of(key)) is not None]
        if not ranks or not {"x", "y", "z"} <= set(array.dtype.names):
            holds = ", ".join(array.dtype.names)
            raise AssetError(f"it needs the fields x, y, z and label, it has {holds}", where=where, remedy=_REMEDY)
        points = np.column_stack([array[axis].reshape(-1) for axis in "xyz"])
        return Segmentation(to_whole_numbers(array[min(ranks)[1]], where), _to_points(points, where))
    if array.ndim == 2 and array.shape[1] == 4:
        return Segmentation(to_whole_numbers(array[:, 3], where), _to_points(array[:, :3], where))
    if array.ndim == 1 or 1 in array.shape:
        return Segmentation(to_whole_numbers(array, where))
    shape = " x ".join(map(str, array.shape)) or "no"
    problem = f"it has {shape} numbers, where a class each is expected, or x, y, z and a class each"
    raise AssetError(problem, where=where, remedy=_REMEDY)


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


def _name_classes(names: Array | None) -> dict[int, str]:
    if names is None:
        return {}
    return number_names(
        [str(name, "utf-8", "replace") if isinstance(name, bytes) else str(name) for name in names.ravel()]
    )
