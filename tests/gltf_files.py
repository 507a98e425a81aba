"""Small glTF scenes for tests, built node by node."""

from __future__ import annotations

import base64
import json
import struct
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from tests.soups import Soup

Tree = dict[str, Any]
KHR, SHAPES = "KHR_physics_rigid_bodies", "KHR_implicit_shapes"
_TYPES = {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123, "u4": 5125, "f4": 5126}
_WIDTHS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


@dataclass
class SceneFile:
    """A scene with its buffer; nodes that no node was told to have as a child are roots."""

    tree: Tree = field(default_factory=lambda: {"asset": {"version": "2.0"}})
    data: bytes = b""

    @staticmethod
    def of(*nodes: tuple[str | None, Soup]) -> SceneFile:
        """A scene of nodes by their names, each with a mesh."""
        scene = SceneFile()
        for name, soup in nodes:
            scene.node(name, soup)
        return scene

    def view(self, content: bytes, **rest: object) -> int:
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(content), **rest}
        self.data += content + b"\0" * (-len(content) % 4)
        return self._add("bufferViews", view)

    def accessor(self, values: npt.NDArray[Any], **rest: object) -> int:
        """An accessor of values (n, k), of the type that they have."""
        values = np.ascontiguousarray(values)
        own = {"componentType": _TYPES[values.dtype.str[1:]], "count": len(values), "type": _WIDTHS[values.shape[1]]}
        if values.dtype == np.float32 and values.shape[1] == 3:
            own |= {"min": values.min(axis=0).tolist(), "max": values.max(axis=0).tolist()}
        return self._add("accessors", {"bufferView": self.view(values.tobytes()), **own, **rest})

    def primitive(self, soup: Soup, **rest: object) -> Tree:
        points, corners = soup[0].astype("<f4"), soup[1].astype("<u2").reshape(-1, 1)
        return {"attributes": {"POSITION": self.accessor(points)}, "indices": self.accessor(corners), **rest}

    def mesh(self, *soups: Soup | Tree, **rest: object) -> int:
        """A mesh of surfaces, or of primitives as they are to be."""
        parts = [soup if isinstance(soup, dict) else self.primitive(soup) for soup in soups]
        return self._add("meshes", {"primitives": parts, **rest})

    def node(self, name: str | None = None, soup: Soup | None = None, **rest: object) -> int:
        """A node; soup: of the mesh that it gets."""
        own: Tree = {} if name is None else {"name": name}
        if soup is not None:
            own["mesh"] = self.mesh(soup)
        return self._add("nodes", {**own, **rest})

    def collider(self, name: str, shape: Tree, **rest: Any) -> int:
        """A node with a shape of KHR_implicit_shapes."""
        self.uses(KHR, SHAPES)
        shapes = self.tree.setdefault("extensions", {}).setdefault(SHAPES, {}).setdefault("shapes", [])
        shapes.append(shape)
        geometry = {"geometry": {"shape": len(shapes) - 1}}
        return self.node(name, extensions={KHR: {"collider": geometry}}, **rest)

    def uses(self, *names: str) -> None:
        self.tree["extensionsUsed"] = sorted({*self.tree.get("extensionsUsed", []), *names})

    def whole(self) -> Tree:
        """The tree with its scene, unless it has scenes."""
        tree = dict(self.tree)
        children = {child for node in tree.get("nodes", []) for child in node.get("children", [])}
        roots = [k for k in range(len(tree.get("nodes", []))) if k not in children]
        return {"scene": 0, "scenes": [{"nodes": roots}], **tree}

    def glb(self) -> bytes:
        return glb_of({**self.whole(), "buffers": [{"byteLength": len(self.data)}]}, self.data)

    def gltf(self, uri: str | None = None) -> bytes:
        """The text, with its buffer inside, or at a URI."""
        uri = uri or "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        return json.dumps({**self.whole(), "buffers": [{"uri": uri, "byteLength": len(self.data)}]}, indent=2).encode()

    def write(self, path: Path) -> Path:
        """The file at a path, a buffer beside it where that is a text."""
        if path.suffix == ".glb":
            path.write_bytes(self.glb())
        else:
            path.with_suffix(".bin").write_bytes(self.data)
            path.write_bytes(self.gltf(path.with_suffix(".bin").name))
        return path

    def _add(self, key: str, value: Tree) -> int:
        found: list[Tree] = self.tree.setdefault(key, [])
        found.append(value)
        return len(found) - 1


def chunk(kind: bytes, content: bytes) -> bytes:
    return struct.pack("<I4s", len(content), kind) + content


def buffer_of(glb: Path) -> bytes:
    """The bytes of the buffer of a GLB, and what lies behind."""
    data = glb.read_bytes()
    return data[28 + int.from_bytes(data[12:16], "little") :]


def glb_of(tree: Tree, data: bytes, *more: bytes) -> bytes:
    """A GLB of a JSON and a buffer, and further chunks behind."""
    text = json.dumps(tree).encode()
    body = chunk(b"JSON", text + b" " * (-len(text) % 4))
    body += chunk(b"BIN\0", data + b"\0" * (-len(data) % 4)) if data else b""
    body += b"".join(more)
    return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body


def tree_of(data: bytes) -> Tree:
    """The JSON of a GLB or a text."""
    if data[:4] == b"glTF":
        data = data[20 : 20 + int.from_bytes(data[12:16], "little")]
    tree: Tree = json.loads(data)
    return tree
