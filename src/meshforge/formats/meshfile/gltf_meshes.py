"""The numbers of a glTF file: buffers, views of them, accessors; and the triangles of its meshes, plain or by Draco."""

import base64
import binascii
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import unquote, unquote_to_bytes

import numpy as np
import numpy.typing as npt

from meshforge.common import AssetError, MissingFilesError, is_beyond_reach
from meshforge.formats.meshfile.gltf_document import Json, entries, entry, extension
from meshforge.formats.meshfile.surface import stack_triangles, to_doubles
from meshforge.geometry import Floats, Ints

TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
"""The types of the numbers of an accessor, by its `componentType`."""
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
_MESHOPT = ("EXT_meshopt_compression", "KHR_meshopt_compression")
_MOST_ZEROS = 10_000_000  # values of an accessor without a buffer, which a few bytes ask for
_TRIANGLES, _STRIP, _FAN = 4, 5, 6

DRACO = "KHR_draco_mesh_compression"


class Buffers:
    """The buffers of a file; chunk: the binary chunk of a GLB; path: of the file, beside which others may lie."""

    def __init__(self, tree: Json, chunk: bytes | None, path: Path) -> None:
        self.tree, self.chunk, self.path = tree, chunk, path
        self._loaded: dict[int, bytes] = {}
        self._refuse_compressed(entries(tree, "extensionsRequired"))

    def accessor(self, index: Any) -> npt.NDArray[Any]:
        """Return the values (count, width) of an accessor: floats where they are normalized or floats in the file."""
        accessor = entry(self.tree, "accessors", index)
        count, number, shape = accessor["count"], accessor["componentType"], accessor["type"]
        if not isinstance(count, int) or count < 0 or number not in TYPES or shape not in _WIDTHS:
            raise ValueError(f"an accessor of {count!r} {shape!r} of type {number!r}")
        width, kind = _WIDTHS[shape], np.dtype(TYPES[number])
        if "bufferView" in accessor:
            values = self._read_strided(accessor["bufferView"], accessor, count, kind, width)
        elif count > _MOST_ZEROS:
            raise ValueError(f"accessor {index} has {count:,} values and no buffer")
        else:
            values = np.zeros((count, width), kind)
        if "sparse" in accessor:
            values = self._apply_sparse(values, accessor["sparse"])
        if kind.kind == "f":
            return to_doubles(values)
        if accessor.get("normalized"):
            return np.maximum(values.astype(np.float64) / np.iinfo(kind).max, -1.0)
        return values

    def geometry(self, index: Any) -> npt.NDArray[Any]:
        """Return the values of an accessor that must have its own: geometry of all zeros is lost, never meant."""
        if not {"bufferView", "sparse"} & entry(self.tree, "accessors", index).keys():
            raise ValueError(f"the values of accessor {index}, geometry of a mesh, are not in it")
        return self.accessor(index)

    def view(self, index: Any) -> bytes:
        """Return the bytes of a buffer view. Raises ValueError where it goes beyond its buffer."""
        view = entry(self.tree, "bufferViews", index)
        start, length = view.get("byteOffset", 0), view["byteLength"]
        data = self.buffer(view["buffer"])
        if start < 0 or length < 0 or start + length > len(data):
            raise ValueError(f"buffer view {index} goes beyond its buffer")
        return data[start : start + length]

    def buffer(self, index: Any) -> bytes:
        """Return the bytes of a buffer. Raises AssetError: its file is not there; ValueError: it is too short."""
        if index not in self._loaded:
            buffer = entry(self.tree, "buffers", index)
            data = self._fetch(buffer, index)
            if len(data) < buffer.get("byteLength", 0):
                raise ValueError(f"a buffer is cut short: number {index}")
            self._loaded[index] = data
        return self._loaded[index]

    def files(self) -> list[Path]:
        """Return the files beside the main one that hold buffers."""
        uris = [b.get("uri") for b in entries(self.tree, "buffers") if isinstance(b, dict)]
        return [self._beside(uri) for uri in uris if isinstance(uri, str) and not uri.startswith("data:")]

    def _fetch(self, buffer: Json, index: int) -> bytes:
        uri = buffer.get("uri")
        if uri is None:
            if self.chunk is None or index > 0:
                raise ValueError(f"buffer {index} has neither a uri nor a binary chunk")
            return self.chunk
        if not isinstance(uri, str):
            raise ValueError(f"the uri of buffer {index} is no text")
        if uri.startswith("data:"):
            return decode_data_uri(uri)
        try:
            return self._file(uri).read_bytes()
        except OSError as error:
            why = "is not there" if isinstance(error, FileNotFoundError) else f"cannot be read: {error.strerror}"
            problem = f"its buffer {uri[:100]} {why}"
            remedy = "Put it there, or export the model as one .glb."
            raise MissingFilesError(problem, missing=(uri[:100],), where=str(self.path), remedy=remedy) from error

    def _file(self, uri: str) -> Path:
        """The file of a buffer. Raises OSError: a pipe would be waited for, a device may never end."""
        path = self._beside(uri)
        if "\0" in str(path) or is_beyond_reach(path):
            raise FileNotFoundError(uri)
        if path.exists() and not path.is_file():
            raise OSError(0, "it is a folder, a pipe or a device")
        return path

    def _beside(self, uri: str) -> Path:
        return self.path.parent / unquote(uri).replace("\\", "/")

    def _apply_sparse(self, values: npt.NDArray[Any], sparse: Json) -> npt.NDArray[Any]:
        count = sparse["count"]
        if not isinstance(count, int) or count < 0:
            raise ValueError(f"a sparse accessor of {count!r} values")
        kind = np.dtype(TYPES[sparse["indices"]["componentType"]])
        at = self._read_strided(sparse["indices"]["bufferView"], sparse["indices"], count, kind, 1).ravel()
        new = self._read_strided(sparse["values"]["bufferView"], sparse["values"], count, values.dtype, values.shape[1])
        values = values.copy()
        values[at] = new
        return values

    def _read_strided(self, index: Any, source: Json, count: int, kind: np.dtype[Any], width: int) -> npt.NDArray[Any]:
        data, view = self.view(index), entry(self.tree, "bufferViews", index)
        start, row = source.get("byteOffset", 0), kind.itemsize * width
        stride = view.get("byteStride") or row
        if start < 0 or stride < 0 or (count and start + stride * (count - 1) + row > len(data)):
            raise ValueError(f"an accessor goes beyond buffer view {index}")
        return np.ndarray((count, width), kind, data, start, (stride, kind.itemsize))

    def _refuse_compressed(self, required: list[Any]) -> None:
        """Raise AssetError where only a decoder of meshopt could read a buffer, or the file says so itself."""
        needed = [name for name in _MESHOPT if name in required]
        buffers = [b for b in entries(self.tree, "buffers") if isinstance(b, dict)]
        needed += [name for name in _MESHOPT if any(extension(b, name) is not None for b in buffers)]
        if needed:
            problem = f"its meshes are compressed by {needed[0]}, which is not read"
            remedy = "Export it again without mesh compression (gltfpack: without -c and -cc)."
            raise AssetError(problem, where=str(self.path), remedy=remedy)


def decode_data_uri(uri: str) -> bytes:
    """Return the bytes in a data URI. Raises ValueError: damaged."""
    head, comma, text = uri.partition(",")
    if not comma:
        raise ValueError("a data URI of it is damaged")
    if not head.endswith(";base64"):
        return unquote_to_bytes(text)
    try:
        return base64.b64decode(unquote(text) + "=" * (-len(text) % 4))
    except binascii.Error as error:
        raise ValueError("a data URI of it is damaged") from error


@dataclass(frozen=True, eq=False, slots=True)
class GltfPrimitive:
    """The triangles (m, 3) of one primitive; index: its number in the mesh."""

    index: int
    faces: Ints
    points: Floats


@dataclass(frozen=True, eq=False, slots=True)
class GltfMesh:
    """Vertices (n, 3) and faces (m, 3) of a mesh, and the patches in the order in which they stand in both."""

    vertices: Floats
    faces: Ints
    patches: tuple[GltfPrimitive, ...]


def read_mesh(mesh: Json, buffers: Buffers) -> GltfMesh:
    """Return the triangles of a mesh; points and lines are passed over. Raises ValueError: damaged."""
    found = [_read_primitive(k, part, buffers) for k, part in enumerate(entries(mesh, "primitives"))]
    patches = tuple(patch for patch in found if patch is not None)
    return GltfMesh(*stack_triangles((patch.points, patch.faces) for patch in patches), patches)


def _read_primitive(index: int, part: Json, buffers: Buffers) -> GltfPrimitive | None:
    mode, attributes = part.get("mode", _TRIANGLES), part.get("attributes", {})
    if mode not in (_TRIANGLES, _STRIP, _FAN) or "POSITION" not in attributes:
        return None
    packed = extension(part, DRACO)
    if packed is not None and "POSITION" in packed["attributes"]:
        data = buffers.view(packed["bufferView"])
        return _check_primitive(GltfPrimitive(index, *_decode_draco(data, packed["attributes"]["POSITION"])))
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


def _decode_draco(data: bytes, number: Any) -> tuple[Ints, Floats]:
    """The triangles (m, 3) and points (n, 3) of a compressed primitive; number: of the attribute of positions."""
    import DracoPy  # lazy: few files are compressed

    try:
        mesh = DracoPy.decode(data)
    except Exception as error:  # DracoPy raises several kinds, none of which tells more
        raise ValueError(f"its Draco data is damaged: {error}") from error
    if not hasattr(mesh, "faces"):
        raise ValueError("its Draco data holds points without triangles")
    found = [attribute["data"] for attribute in mesh.attributes if attribute["unique_id"] == number]
    if not found:
        raise ValueError("its Draco data has no POSITION")
    return np.asarray(mesh.faces, dtype=np.int64).reshape(-1, 3), np.asarray(found[0], dtype=np.float64)
