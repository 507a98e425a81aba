"""The files of a written scene: new geometry in buffers, and the container that the name of the output asks for."""

import base64
import codecs
import copy
from collections.abc import Collection
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from typing import Any
from urllib.parse import quote

import numpy as np
import numpy.typing as npt

from meshforge.formats.base import Output
from meshforge.formats.gltf.document import rewrite_json
from meshforge.formats.kinematic_tree import claim_name
from meshforge.formats.meshfile.gltf_document import Container, Json, entries
from meshforge.formats.meshfile.gltf_meshes import TYPES
from meshforge.formats.meshfile.gltf_scene import GltfScene
from meshforge.formats.references import find_companions
from meshforge.geometry import Ints

_VERTICES, _INDICES = 34962, 34963  # targets of buffer views
_NUMBERS = {kind.lstrip("<"): number for number, kind in TYPES.items()}
_WIDTHS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}


@dataclass(frozen=True, eq=False, slots=True)
class EditBase:
    """What an edit starts from: a file in the container that is to be written.

    container: as it was read; tree: what its JSON has to be in the other container, or is; made: files for that.
    """

    container: Container
    is_binary: bool
    tree: Json
    chunk: bytes | None
    made: dict[str, bytes] = field(default_factory=dict)

    @property
    def before(self) -> bytes | None:
        """The chunk that new geometry follows; None where the file has none, and may get none."""
        buffers = entries(self.tree, "buffers")
        return None if not self.is_binary or (buffers and "uri" in buffers[0]) else self.chunk or b""


def prepare_base(source: bytes, scene: GltfScene, name: str) -> EditBase:
    """Return the file to edit, which becomes `name`: its first buffer is inside of a GLB, and beside a text.

    A file whose suffix stays keeps its container, whatever the suffix says.
    """
    container, suffix = Container.of(source), PurePosixPath(name).suffix.lower()
    is_binary = container.is_binary if suffix == scene.path.suffix.lower() else suffix == ".glb"
    tree, buffers = copy.deepcopy(scene.tree), entries(scene.tree, "buffers")
    chunk, made = container.binary, dict[str, bytes]()
    if is_binary and not container.is_binary and buffers:
        chunk = scene.buffers.buffer(0)
        tree["buffers"][0].pop("uri", None)
    if container.is_binary and not is_binary and buffers and "uri" not in buffers[0]:
        own = free_buffer_name(f"{PurePosixPath(name).stem}", find_companions(scene.path))
        tree["buffers"][0]["uri"] = quote(own)
        made[own] = scene.buffers.buffer(0)
        chunk = None
    return EditBase(container, is_binary, tree, chunk, made)


def pack_scene(base: EditBase, scene: GltfScene, geometry: "GeometryBuffer | None", name: str) -> Output:
    """Return the files of an edited scene; geometry: what was added to it, the tree edited with it."""
    tree = base.tree if geometry is None else geometry.tree
    copies, made = find_companions(scene.path), dict(base.made)
    if base.container.is_binary != base.is_binary and scene.tree != base.tree:
        copies = {key: path for key, path in copies.items() if key not in _list_embedded(scene, base)}
    chunk = base.chunk
    if geometry is not None and geometry.added:
        own = free_buffer_name(f"{PurePosixPath(name).stem}--hulls", {*copies, *made})
        uris = [buffer.get("uri", "") for buffer in entries(tree, "buffers")]
        embedded = bool(uris) and all(uri.startswith("data:") for uri in uris)  # then one more should be, too
        geometry.finish(embed=embedded, uri=quote(own))
        if geometry.before is not None:
            chunk = geometry.chunk
        elif not embedded:
            made[own] = bytes(geometry.added)
    source = base.container.text
    text = rewrite_json(source.decode("utf-8-sig").rstrip("\0"), tree).encode()
    if not base.is_binary:
        return Output((codecs.BOM_UTF8 if source.startswith(codecs.BOM_UTF8) else b"") + text, made, copies)
    text = text.rstrip(b" ")
    container = Container(text, True, base.container.chunks, base.container.rest)
    return Output(container.with_text(text, chunk).as_bytes(), made, copies)


def free_buffer_name(stem: str, taken: Collection[str]) -> str:
    """Return a name of a buffer file that is not taken."""
    return claim_name(stem, {name.lower() for name in taken}, "{}.bin".format, str.lower)


def _list_embedded(scene: GltfScene, base: EditBase) -> set[str]:
    there = {buffer.get("uri") for buffer in entries(base.tree, "buffers")}
    uris = [uri for b in entries(scene.tree, "buffers") if isinstance(uri := b.get("uri"), str)]
    files = zip(scene.buffers.files(), [uri for uri in uris if not uri.startswith("data:")], strict=True)
    return {Path(file).relative_to(scene.path.parent).as_posix() for file, uri in files if uri not in there}


class GeometryBuffer:
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
        return 0 if self.before is not None else len(entries(self.tree, "buffers"))

    @property
    def chunk(self) -> bytes:
        """The binary chunk, new bytes included."""
        before = self.before or b""
        return before + b"\0" * (self._start - len(before)) + bytes(self.added)

    def add_triangles(self, faces: Ints) -> int:
        """Return the accessor of triangles (m, 3)."""
        kind = "<u2" if faces.max(initial=0) < 65535 else "<u4"
        return self._add_accessor(faces.ravel().astype(kind)[:, None], _INDICES)

    def add_vertex_data(self, rows: npt.NDArray[Any], *, bounds: bool = False) -> int:
        """Return the accessor of a vertex attribute (n, k); bounds: with the least and the largest of each column."""
        index = self._add_accessor(rows, _VERTICES)
        accessor = self.tree["accessors"][index]
        if bounds:
            accessor |= {"min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()}
        return index

    def add_bytes(self, data: bytes) -> int:
        """Return the buffer view of some bytes, such as a picture."""
        view = {"buffer": self.buffer, "byteOffset": self._start + len(self.added), "byteLength": len(data)}
        self.added += data + b"\0" * (-len(data) % 4)
        return self._append("bufferViews", view)

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
        view = self.add_bytes(padded.tobytes())
        self.tree["bufferViews"][view] |= {**({"byteStride": stride} if stride != row else {}), "target": target}
        kind = _NUMBERS[rows.dtype.str[1:]]
        shape = {"componentType": kind, "count": len(rows), "type": _WIDTHS[rows.shape[1]]}
        return self._append("accessors", {"bufferView": view, **shape})

    def _append(self, key: str, value: Json) -> int:
        found: list[Any] = self.tree.setdefault(key, [])
        found.append(value)
        return len(found) - 1
