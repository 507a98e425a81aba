"""The triangles of a glTF mesh, of all its primitives together: plain, or compressed by Draco."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from meshforge.formats.meshfile import gltf_buffers, surface
from meshforge.formats.meshfile.gltf_document import Json, entries, extension
from meshforge.geometry import Floats, Ints

_TRIANGLES, _STRIP, _FAN = 4, 5, 6

DRACO = "KHR_draco_mesh_compression"

_ALIKE = 1e-12  # how far the square of a quaternion's length may be from one, to be taken as it is


@dataclass(frozen=True, eq=False, slots=True)
class GltfPrimitive:
    """The triangles (m, 3) of one primitive; index: its number in the mesh; decoded: where Draco compressed it."""

    index: int
    faces: Ints
    points: Floats
    decoded: DracoMesh | None = None


@dataclass(frozen=True, eq=False, slots=True)
class GltfMesh:
    """Vertices (n, 3) and faces (m, 3) of a mesh, and the patches in the order in which they stand in both."""

    vertices: Floats
    faces: Ints
    patches: tuple[GltfPrimitive, ...]


def read_mesh(mesh: Json, buffers: gltf_buffers.Buffers) -> GltfMesh:
    """The triangles of a mesh; points and lines are passed over. Raises ValueError: damaged."""
    found = [_read_primitive(k, part, buffers) for k, part in enumerate(entries(mesh, "primitives"))]
    patches = tuple(patch for patch in found if patch is not None)
    return GltfMesh(*surface.stack_triangles((patch.points, patch.faces) for patch in patches), patches)


def _read_primitive(index: int, part: Json, buffers: gltf_buffers.Buffers) -> GltfPrimitive | None:
    mode, attributes = part.get("mode", _TRIANGLES), part.get("attributes", {})
    if mode not in (_TRIANGLES, _STRIP, _FAN) or "POSITION" not in attributes:
        return None
    packed = extension(part, DRACO)
    if packed is not None and "POSITION" in packed["attributes"]:
        unpacked = decode_draco(buffers.view(packed["bufferView"]), packed["attributes"])
        points = unpacked.attributes["POSITION"].astype(np.float64)
        return _check_primitive(GltfPrimitive(index, unpacked.faces, points, unpacked))
    points = buffers.geometry(attributes["POSITION"]).astype(np.float64)
    order: Any = buffers.geometry(part["indices"]).ravel() if "indices" in part else np.arange(len(points))
    if order.dtype.kind not in "iu":
        raise ValueError("the indices of a mesh are no whole numbers")
    return _check_primitive(GltfPrimitive(index, _to_triangles(order.astype(np.int64), mode), points))


def _check_primitive(patch: GltfPrimitive) -> GltfPrimitive:
    """The patch. Raises ValueError: its positions are no points, or a face names none, or one that is not finite."""
    if patch.points.shape[1:] != (3,):
        raise ValueError("the positions of a mesh are no points")
    if len(patch.faces) and (patch.faces.min() < 0 or patch.faces.max() >= len(patch.points)):
        raise ValueError("a face names a vertex that is not there")
    if not np.isfinite(patch.points[patch.faces]).all():
        raise ValueError("a coordinate is not a finite number")
    return patch


def _to_triangles(order: Ints, mode: int) -> Ints:
    if mode == _TRIANGLES:
        return order[: len(order) // 3 * 3].reshape(-1, 3)
    if len(order) < 3:
        return np.empty((0, 3), dtype=np.int64)
    if mode == _FAN:
        return np.column_stack([np.full(len(order) - 2, order[0]), order[1:-1], order[2:]])
    strip = np.column_stack([order[:-2], order[1:-1], order[2:]])
    strip[1::2] = strip[1::2, ::-1]
    return strip


@dataclass(frozen=True, eq=False, slots=True)
class DracoMesh:
    """The triangles (m, 3) of a primitive, and the attributes that were compressed, each (n, k), by their names."""

    faces: Ints
    attributes: dict[str, npt.NDArray[Any]]


def decode_draco(data: bytes, names: Json) -> DracoMesh:
    """What the bytes of a compressed primitive hold; names: the number of each attribute by its name.

    Raises ValueError: they are damaged, hold no triangles, or not all of the attributes.
    """
    import DracoPy  # lazy: few files are compressed

    try:
        mesh = DracoPy.decode(data)
    except Exception as error:  # DracoPy raises several kinds, none of which tells more
        raise ValueError(f"its Draco data is damaged: {error}") from error
    if not hasattr(mesh, "faces"):
        raise ValueError("its Draco data holds points without triangles")
    by_number = {attribute["unique_id"]: attribute["data"] for attribute in mesh.attributes}
    missing = [name for name, number in names.items() if number not in by_number]
    if missing:
        raise ValueError(f"its Draco data has no {missing[0]}")
    found = {name: np.asarray(by_number[number]) for name, number in names.items()}
    rows = {len(values) for values in found.values()}
    if len(rows) > 1:
        raise ValueError("its Draco data holds attributes of several lengths")
    return DracoMesh(np.asarray(mesh.faces, dtype=np.int64).reshape(-1, 3), found)


def rotations_of(quaternions: Floats) -> Floats:
    """The rotations (..., 3, 3) of quaternions (..., 4), x y z w, of any length. Raises ValueError: one of zeros."""
    largest = np.abs(quaternions).max(axis=-1, keepdims=True)
    if not largest.all():
        raise ValueError("a rotation of all zeros")
    near = quaternions / largest  # lest a square has no number
    squares = np.square(quaternions).sum(axis=-1, keepdims=True)
    unit = np.where(np.abs(squares - 1.0) > _ALIKE, near / np.linalg.norm(near, axis=-1, keepdims=True), quaternions)
    x, y, z, w = np.moveaxis(unit, -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))
