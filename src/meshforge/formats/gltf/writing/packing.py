"""The files of a written scene: its JSON and buffers, in the container that the name of the output asks for."""

from __future__ import annotations

import codecs
import copy
from collections.abc import Collection
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from urllib.parse import quote

from meshforge.formats.base import Output
from meshforge.formats.companions import companions
from meshforge.formats.gltf.writing.geometry_out import NewGeometry
from meshforge.formats.gltf.writing.json_text import rewritten
from meshforge.formats.meshfile.gltf import Container, Json, Scene
from meshforge.formats.meshfile.gltf.items import entries


@dataclass(frozen=True, eq=False, slots=True)
class Base:
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


def based(source: bytes, scene: Scene, name: str) -> Base:
    """The file to be edited, which becomes `name`: a `.gltf` as GLB has its first buffer inside, a GLB as text beside.

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
        own = free_name(f"{PurePosixPath(name).stem}", companions(scene.path))
        tree["buffers"][0]["uri"] = quote(own)
        made[own] = scene.buffers.buffer(0)
        chunk = None
    return Base(container, is_binary, tree, chunk, made)


def packed(base: Base, scene: Scene, geometry: NewGeometry | None, name: str) -> Output:
    """The files of an edited scene; geometry: what was added to it, the tree edited with it."""
    tree = base.tree if geometry is None else geometry.tree
    copies, made = companions(scene.path), dict(base.made)
    if base.container.is_binary != base.is_binary and scene.tree != base.tree:
        copies = {key: path for key, path in copies.items() if key not in _gone(scene, base)}
    chunk = base.chunk
    if geometry is not None and geometry.added:
        own = free_name(f"{PurePosixPath(name).stem}--hulls", {*copies, *made})
        embedded = _is_embedded(tree)
        geometry.finish(embed=embedded, uri=quote(own))
        if geometry.before is not None:
            chunk = geometry.chunk
        elif not embedded:
            made[own] = bytes(geometry.added)
    text = _text(base.container.text, tree, base.is_binary)
    if not base.is_binary:
        return Output(text, made, copies)
    container = Container(text, True, base.container.chunks, base.container.rest)
    return Output(container.with_text(text, chunk).as_bytes(), made, copies)


def free_name(stem: str, taken: Collection[str]) -> str:
    """A name of a buffer file that is not taken."""
    used = {name.lower() for name in taken}
    name, number = f"{stem}.bin", 2
    while name.lower() in used:
        name, number = f"{stem}_{number}.bin", number + 1
    return name


def _gone(scene: Scene, base: Base) -> set[str]:
    """The files of buffers that are inside of the written file."""
    there = {buffer.get("uri") for buffer in entries(base.tree, "buffers")}
    files = zip(scene.buffers.files(), [b["uri"] for b in entries(scene.tree, "buffers") if _is_file(b)], strict=True)
    return {Path(file).relative_to(scene.path.parent).as_posix() for file, uri in files if uri not in there}


def _is_file(buffer: Json) -> bool:
    uri = buffer.get("uri")
    return isinstance(uri, str) and not uri.startswith("data:")


def _is_embedded(tree: Json) -> bool:
    """Whether all buffers are in the JSON itself, as one more should be then."""
    uris = [buffer.get("uri", "") for buffer in entries(tree, "buffers")]
    return bool(uris) and all(uri.startswith("data:") for uri in uris)


def _text(source: bytes, tree: Json, is_binary: bool) -> bytes:
    """The JSON of a tree, with the text of the source where that is the same."""
    mark = codecs.BOM_UTF8 if source.startswith(codecs.BOM_UTF8) and not is_binary else b""
    text = rewritten(source.decode("utf-8-sig").rstrip("\0"), tree).encode()
    return text.rstrip(b" ") if is_binary else mark + text
