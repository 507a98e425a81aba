"""New geometry for a glTF file: behind what its binary chunk holds, or in a buffer of its own."""

from __future__ import annotations

import base64
from typing import Any

import numpy as np
import numpy.typing as npt

from meshforge.formats.meshfile.gltf import Json
from meshforge.formats.meshfile.gltf.items import entries
from meshforge.geometry import Floats, Ints

_VERTICES, _INDICES = 34962, 34963  # targets of buffer views
_TYPES = {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123, "u4": 5125, "f4": 5126}
_WIDTHS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}


class NewGeometry:
    """Collects bytes, and puts views and accessors of them into a tree.

    before: the bytes of the chunk that they follow; None where they make a buffer of their own.
    """

    def __init__(self, tree: Json, before: bytes | None) -> None:
        self.tree, self.before = tree, before
        self._start = len(before) + -len(before) % 4 if before is not None else 0
        self.added = bytearray()

    @property
    def buffer(self) -> int:
        """The number of the buffer that holds the new bytes."""
        return 0 if self.before is not None else self._own

    @property
    def _own(self) -> int:
        return len(entries(self.tree, "buffers"))

    @property
    def chunk(self) -> bytes:
        """The binary chunk, new bytes included."""
        before = self.before or b""
        return before + b"\0" * (self._start - len(before)) + bytes(self.added)

    def add_triangles(self, faces: Ints) -> int:
        """The accessor of triangles (m, 3)."""
        kind = "<u2" if faces.max(initial=0) < 65535 else "<u4"
        return self._add_accessor(faces.ravel().astype(kind)[:, None], _INDICES)

    def add_points(self, points: Floats) -> int:
        """The accessor of vertices (n, 3) in single precision."""
        return self.add_vertex_data(points.astype("<f4"), bounds=True)

    def add_vertex_data(self, rows: npt.NDArray[Any], *, bounds: bool = False, normalized: bool = False) -> int:
        """The accessor of a vertex attribute (n, k); bounds: with the least and the largest of each column."""
        index = self._add_accessor(rows, _VERTICES)
        accessor = self.tree["accessors"][index]
        if bounds:
            accessor |= {"min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()}
        if normalized:
            accessor["normalized"] = True
        return index

    def finish(self, *, embed: bool, uri: str) -> None:
        """Write down the length of the chunk, or a buffer at `uri`, or in the file itself with `embed`."""
        if not self.added:
            return
        if self.before is not None:
            buffers = self.tree.setdefault("buffers", [])
            if not buffers:
                buffers.append({"byteLength": 0})
            buffers[0]["byteLength"] = self._start + len(self.added)
            return
        if embed:
            uri = "data:application/octet-stream;base64," + base64.b64encode(self.added).decode()
        self.tree.setdefault("buffers", []).append({"uri": uri, "byteLength": len(self.added)})

    def _add_accessor(self, rows: npt.NDArray[Any], target: int) -> int:
        row = rows.dtype.itemsize * rows.shape[1]
        stride = row + -row % 4 if target == _VERTICES else row
        padded = np.zeros((len(rows), stride), np.uint8)
        padded[:, :row] = np.ascontiguousarray(rows).view(np.uint8).reshape(len(rows), row)
        view: Json = {"buffer": self.buffer, "byteOffset": self._start + len(self.added), "byteLength": padded.size}
        if stride != row:
            view["byteStride"] = stride
        view["target"] = target
        self.added += padded.tobytes() + b"\0" * (-padded.size % 4)
        kind = _TYPES[rows.dtype.str[1:]]
        shape = {"componentType": kind, "count": len(rows), "type": _WIDTHS[rows.shape[1]]}
        return self._append("accessors", {"bufferView": self._append("bufferViews", view), **shape})

    def _append(self, key: str, value: Json) -> int:
        found: list[Any] = self.tree.setdefault(key, [])
        found.append(value)
        return len(found) - 1
