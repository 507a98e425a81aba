"""Reading glTF 2.0 and GLB: a surface for each mesh in each node of the scene, node transforms applied."""

from __future__ import annotations

import base64
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np
import numpy.typing as npt

from meshforge.errors import AssetError
from meshforge.formats.meshfile.surface import RawSurface, checked
from meshforge.geometry import Floats, Ints

_COMPRESSED = ("KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression")
_TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
_TRIANGLES, _STRIP, _FAN = 4, 5, 6
_JSON = 0x4E4F534A


def parse_gltf(data: bytes, path: Path) -> list[RawSurface]:
    """The surfaces of a glTF or GLB file, whose buffers may lie beside it.

    Raises AssetError: damaged, compressed in a way that is not read, or a buffer is missing.
    """
    where = str(path)
    try:
        text, chunk = _chunks(data)
        scene = _Scene(json.loads(text), chunk, path)
        found = list(scene.surfaces())
    except (ValueError, KeyError, IndexError, TypeError, AttributeError, RecursionError) as error:
        raise AssetError(f"this glTF file is damaged: {error}", where=where, remedy="Export it again.") from error
    return checked(found, where)


def _chunks(data: bytes) -> tuple[bytes, bytes]:
    """The JSON of a file, and the binary chunk that a GLB has behind it."""
    if data[:4] != b"glTF":
        return data, b""
    length, kind = (int.from_bytes(data[at : at + 4], "little") for at in (12, 16))
    if kind != _JSON or 20 + length > len(data):
        raise ValueError("it is cut short")
    return data[20 : 20 + length], data[28 + length :]


class _Scene:
    def __init__(self, tree: Any, chunk: bytes, path: Path) -> None:
        self.tree = tree
        self.chunk = chunk
        self.path = path
        self.buffers: dict[int, bytes] = {}
        used = [name for name in _COMPRESSED if name in tree.get("extensionsRequired", [])]
        if used:
            raise AssetError(
                f"its meshes are compressed by {used[0]}", where=str(path), remedy="Export it without compression."
            )

    def surfaces(self) -> Iterator[RawSurface]:
        nodes, scenes = self.tree.get("nodes", []), self.tree.get("scenes", [])
        children = {child for node in nodes for child in node.get("children", [])}
        roots = [k for k in range(len(nodes)) if k not in children]
        if scenes:
            roots = scenes[self.tree.get("scene", 0)].get("nodes", [])
        for root in roots:
            yield from self._walk(root, np.eye(4))

    def _walk(self, index: int, world: Floats) -> Iterator[RawSurface]:
        node = self.tree["nodes"][index]
        world = world @ _matrix(node)
        if "mesh" in node:
            mesh = self.tree["meshes"][node["mesh"]]
            yield from self._mesh(mesh, world, node.get("name") or mesh.get("name"))
        for child in node.get("children", []):
            yield from self._walk(child, world)

    def _mesh(self, mesh: Any, world: Floats, name: str | None) -> Iterator[RawSurface]:
        vertices, faces, start = [], [], 0
        for part in mesh["primitives"]:
            mode = part.get("mode", _TRIANGLES)
            if mode not in (_TRIANGLES, _STRIP, _FAN) or "POSITION" not in part["attributes"]:
                continue
            points = self._accessor(part["attributes"]["POSITION"])
            order = self._accessor(part["indices"]).ravel() if "indices" in part else np.arange(len(points))
            vertices.append(points @ world[:3, :3].T + world[:3, 3])
            faces.append(_triangles(order.astype(np.int64), mode) + start)
            start += len(points)
        if faces:
            yield RawSurface(name, np.concatenate(vertices), np.concatenate(faces))

    def _accessor(self, index: int) -> npt.NDArray[Any]:
        """The values (count, width) of an accessor."""
        accessor = self.tree["accessors"][index]
        width, kind = _WIDTHS[accessor["type"]], np.dtype(_TYPES[accessor["componentType"]])
        values = np.zeros((accessor["count"], width), kind)
        if "bufferView" in accessor:
            values = self._view(accessor, accessor["count"], kind, width)
        if "sparse" in accessor:
            sparse = accessor["sparse"]
            at = self._view(sparse["indices"], sparse["count"], np.dtype(_TYPES[sparse["indices"]["componentType"]]), 1)
            values = values.copy()
            values[at.ravel()] = self._view(sparse["values"], sparse["count"], kind, width)
        if accessor.get("normalized") and kind.kind in "iu":
            return np.maximum(values.astype(np.float64) / np.iinfo(kind).max, -1.0)
        return values.astype(np.float64) if kind.kind == "f" or width == 3 else values

    def _view(self, source: Any, count: int, kind: np.dtype[Any], width: int) -> npt.NDArray[Any]:
        view = self.tree["bufferViews"][source["bufferView"]]
        start = view.get("byteOffset", 0) + source.get("byteOffset", 0)
        stride = view.get("byteStride") or kind.itemsize * width
        data = self._buffer(view["buffer"])
        if count and start + stride * (count - 1) + kind.itemsize * width > len(data):
            raise ValueError("a buffer is cut short")
        return np.ndarray((count, width), kind, data, start, (stride, kind.itemsize))

    def _buffer(self, index: int) -> bytes:
        if index not in self.buffers:
            uri = self.tree["buffers"][index].get("uri")
            self.buffers[index] = self.chunk if uri is None else self._fetched(uri)
        return self.buffers[index]

    def _fetched(self, uri: str) -> bytes:
        if uri.startswith("data:"):
            return base64.b64decode(uri.partition(",")[2])
        try:
            return (self.path.parent / unquote(uri)).read_bytes()
        except OSError as error:
            raise AssetError(f"its buffer {uri} is not there", where=str(self.path)) from error


def _triangles(order: Ints, mode: int) -> Ints:
    if mode == _TRIANGLES:
        return order[: len(order) // 3 * 3].reshape(-1, 3)
    if mode == _FAN:
        return np.column_stack([np.full(max(len(order) - 2, 0), order[0]), order[1:-1], order[2:]])
    strip = np.column_stack([order[:-2], order[1:-1], order[2:]])
    strip[1::2] = strip[1::2, ::-1]
    return strip


def _matrix(node: Any) -> Floats:
    """The transform (4, 4) of a node to its parent."""
    if "matrix" in node:
        return np.array(node["matrix"], dtype=np.float64).reshape(4, 4).T
    x, y, z, w = np.array(node.get("rotation", [0.0, 0.0, 0.0, 1.0]), dtype=np.float64)
    turn = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    matrix = np.eye(4)
    matrix[:3, :3] = turn * np.array(node.get("scale", [1.0, 1.0, 1.0]), dtype=np.float64)
    matrix[:3, 3] = node.get("translation", [0.0, 0.0, 0.0])
    return matrix
