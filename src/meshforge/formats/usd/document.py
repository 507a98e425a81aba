"""What is kept of a USD stage to write it back, and layers as bytes: text, crate, or a package of them."""

from __future__ import annotations

import io
import struct
import tempfile
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from meshforge.formats.usd.crate import CRATE_MARK
from meshforge.symbolic import Document

BODY = "body"
"""The name of the body of all collision that is part of no rigid body."""

_ALIGNMENT = 64
_HEADER = 30  # bytes of a local header before the name
_PADDING = 0x1986  # the id of the extra field that holds nothing


@dataclass(frozen=True, slots=True)
class PrimRecord:
    """A prim with collision: its path, its body, and the names of its pieces in order, hulls and non-convex ones.

    fixed: why no edit can change it, empty where one can.
    """

    path: str
    body: str
    names: tuple[str, ...]
    fixed: str = ""


@dataclass(frozen=True, eq=False, slots=True)
class UsdDocument(Document):
    """The source of an asset read from a USD file.

    source: the bytes of the file; physics: whether prims say that they collide, else all meshes count;
    bodies: the prims that are bodies, with the names of those; digests: of the layers besides the root layer.
    """

    source: bytes
    physics: bool
    authored: tuple[PrimRecord, ...]
    bodies: tuple[tuple[str, str], ...] = ()
    digests: tuple[tuple[Path, str], ...] = ()


def is_crate(data: bytes) -> bool:
    """Whether bytes are a layer in the binary form."""
    return data.startswith(CRATE_MARK)


def export_layer(layer: Any, *, crate: bool) -> bytes:
    """A layer as a file of its own."""
    if not crate:
        text: str = layer.ExportToString()
        return text.encode()
    with tempfile.TemporaryDirectory(prefix="meshforge-") as folder:
        path = Path(folder) / "layer.usdc"
        layer.Export(str(path))
        return path.read_bytes()


def is_crate_wanted(suffix: str, source: bytes | None) -> bool:
    """Whether a file of a suffix is binary; `.usd` is what its source was, and binary where it is new."""
    if suffix == ".usd":
        return source is None or is_crate(source)
    return suffix != ".usda"


def pack_usdz(files: Mapping[str, bytes]) -> bytes:
    """A package of files by their names, in that order."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_STORED) as archive:
        for name, data in files.items():
            info = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            info.external_attr = 0o644 << 16
            info.extra = _padding(stream.tell() + _HEADER + len(name.encode()))
            archive.writestr(info, data)
    return stream.getvalue()


def unpack_usdz(data: bytes) -> dict[str, bytes]:
    """The files of a package by their names, in their order."""
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return {info.filename: archive.read(info) for info in archive.infolist() if not info.is_dir()}


def _padding(start: int) -> bytes:
    """The extra field after which the data begins on a multiple of 64; start: where that field begins."""
    missing = -start % _ALIGNMENT
    if missing == 0:
        return b""
    if missing < 4:  # a field is four bytes at least
        missing += _ALIGNMENT
    return struct.pack("<HH", _PADDING, missing - 4) + bytes(missing - 4)
