"""The numbers of a glTF file: its buffers, wherever they are, views of them, and accessors."""

from __future__ import annotations

import base64
import binascii
from pathlib import Path
from typing import Any
from urllib.parse import unquote, unquote_to_bytes

import numpy as np
import numpy.typing as npt

from meshforge.common import AssetError, is_beyond_reach
from meshforge.formats.meshfile.gltf_document import Json, entries, entry, extension
from meshforge.formats.meshfile.surface import to_doubles

TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
"""The types of the numbers of an accessor, by its `componentType`."""
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
_MESHOPT = ("EXT_meshopt_compression", "KHR_meshopt_compression")
_MOST_ZEROS = 10_000_000  # values of an accessor without a buffer, which a few bytes ask for


class Buffers:
    """The buffers of a file; chunk: the binary chunk of a GLB; path: of the file, beside which others may lie."""

    def __init__(self, tree: Json, chunk: bytes | None, path: Path) -> None:
        self.tree, self.chunk, self.path = tree, chunk, path
        self._held: dict[int, bytes] = {}
        self._refuse_compressed(entries(tree, "extensionsRequired"))

    def accessor(self, index: Any) -> npt.NDArray[Any]:
        """The values (count, width) of an accessor: floats where they are normalized or floats in the file."""
        accessor = entry(self.tree, "accessors", index)
        count, width, kind = _layout_of(accessor)
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
        """The values of an accessor that must have its own: geometry of all zeros is lost, never meant."""
        if not {"bufferView", "sparse"} & entry(self.tree, "accessors", index).keys():
            raise ValueError(f"the values of accessor {index}, geometry of a mesh, are not in it")
        return self.accessor(index)

    def view(self, index: Any) -> bytes:
        """The bytes of a buffer view. Raises ValueError where it goes beyond its buffer."""
        view = entry(self.tree, "bufferViews", index)
        start, length = view.get("byteOffset", 0), view["byteLength"]
        data = self.buffer(view["buffer"])
        if start < 0 or length < 0 or start + length > len(data):
            raise ValueError(f"buffer view {index} goes beyond its buffer")
        return data[start : start + length]

    def buffer(self, index: Any) -> bytes:
        """The bytes of a buffer. Raises AssetError: its file is not there; ValueError: it is shorter than it says."""
        if index not in self._held:
            buffer = entry(self.tree, "buffers", index)
            data = self._fetch(buffer, index)
            if len(data) < buffer.get("byteLength", 0):
                raise ValueError(f"a buffer is cut short: number {index}")
            self._held[index] = data
        return self._held[index]

    def files(self) -> list[Path]:
        """The files beside the main one that hold buffers."""
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
            raise AssetError(
                f"its buffer {uri[:100]} {why}",
                where=str(self.path),
                remedy="Put it there, or export the model as one .glb.",
            ) from error

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
            raise AssetError(
                f"its meshes are compressed by {needed[0]}, which is not read",
                where=str(self.path),
                remedy="Export it again without mesh compression (gltfpack: without -c and -cc).",
            )


def _layout_of(accessor: Json) -> tuple[int, int, np.dtype[Any]]:
    count, kind, width = accessor["count"], accessor["componentType"], accessor["type"]
    if not isinstance(count, int) or count < 0 or kind not in TYPES or width not in _WIDTHS:
        raise ValueError(f"an accessor of {count!r} {width!r} of type {kind!r}")
    return count, _WIDTHS[width], np.dtype(TYPES[kind])


def decode_data_uri(uri: str) -> bytes:
    """The bytes in a data URI. Raises ValueError: damaged."""
    head, comma, text = uri.partition(",")
    if not comma:
        raise ValueError("a data URI of it is damaged")
    if not head.endswith(";base64"):
        return unquote_to_bytes(text)
    try:
        return base64.b64decode(unquote(text) + "=" * (-len(text) % 4))
    except binascii.Error as error:
        raise ValueError("a data URI of it is damaged") from error
