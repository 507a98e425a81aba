"""Layers as files: text, crate, or a package of them; and what is looked at before the library composes a stage, which
deals with all else that may be wrong with a layer in a process of its own."""

from __future__ import annotations

import io
import struct
import tempfile
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from meshforge.common import AssetError, is_beyond_reach
from meshforge.formats.libraries import pxr

PACKAGE_SUFFIX = ".usdz"
LAYER_SUFFIXES = (".usd", ".usda", ".usdc")
REMEDY = "Repair the file, or export it anew."
_CRATE_MARK = b"PXR-USDC"
_PACKAGE_MARK = b"PK\x03\x04"
_ALIGNMENT = 64
_HEADER = 30  # bytes of a local header before the name
_PADDING = 0x1986  # the id of the extra field that holds nothing


def is_crate(data: bytes) -> bool:
    """Return whether bytes are a layer in the binary form."""
    return data.startswith(_CRATE_MARK)


def is_crate_wanted(suffix: str, source: bytes | None) -> bool:
    """Return whether a file of a suffix is binary; `.usd` is what its source was, and binary where it is new."""
    return source is None or is_crate(source) if suffix == ".usd" else suffix != ".usda"


def export_layer(layer: Any, *, crate: bool) -> bytes:
    """Return a layer as a file of its own."""
    if not crate:
        text: str = layer.ExportToString()
        return text.encode()
    with tempfile.TemporaryDirectory(prefix="meshforge-") as folder:
        path = Path(folder) / "layer.usdc"
        layer.Export(str(path))
        return path.read_bytes()


def pack_usdz(files: Mapping[str, bytes]) -> bytes:
    """Return a package of files by their names, in that order, the data of each on a multiple of 64."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_STORED) as archive:
        for name, data in files.items():
            info = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            info.external_attr = 0o644 << 16
            missing = -(stream.tell() + _HEADER + len(name.encode())) % _ALIGNMENT
            missing += _ALIGNMENT * (0 < missing < 4)  # a field is four bytes at least
            info.extra = struct.pack("<HH", _PADDING, missing - 4) + bytes(missing - 4) if missing else b""
            archive.writestr(info, data)
    return stream.getvalue()


def unpack_usdz(data: bytes) -> dict[str, bytes]:
    """Return the files of a package by their names, in their order."""
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return {info.filename: archive.read(info) for info in archive.infolist() if not info.is_dir()}


def refuse_far_references(path: Path, data: bytes) -> None:
    """Raise AssetError where a file, or one that it refers to, leads to what may not be read or is no file.

    To be used within `usd`; data: the bytes of the file.
    """
    known, waiting = set[Path](), [(path, data)]
    while waiting:
        file, content = waiting.pop()
        if file.absolute() in known:
            continue
        known.add(file.absolute())
        if content.startswith(_PACKAGE_MARK):
            _refuse_package(content, str(file))
        layer = pxr.Sdf.Layer.FindOrOpen(str(file))
        for reference in sorted(filter(None, layer.GetCompositionAssetDependencies() if layer else ())):
            found = file.parent / reference.split(":SDF_FORMAT_ARGS:", 1)[0]
            if is_beyond_reach(found):
                raise AssetError(f"it refers to {reference}, which is not beside it", where=str(file))
            try:
                if found.is_file():
                    waiting.append((found, found.read_bytes()))
                elif found.exists():  # a pipe would be waited for, a device may never end
                    problem = f"it refers to {reference}, which is a pipe, a folder or a device"
                    raise AssetError(problem, where=str(file))
            except (OSError, ValueError):
                continue


def _refuse_package(data: bytes, where: str) -> None:
    """Raise AssetError where a package is no archive, is compressed, holds another, or has places outside of itself."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            entries = archive.infolist()
    except (zipfile.BadZipFile, NotImplementedError, OSError, ValueError, RuntimeError, EOFError) as error:
        raise AssetError(f"its archive is damaged: {error}", where=where, remedy=REMEDY) from error
    for entry in entries:
        if entry.compress_type != zipfile.ZIP_STORED or entry.flag_bits & 1:
            problem = f"{entry.filename} in it is compressed or encrypted, which USDZ does not allow"
            raise AssetError(problem, where=where, remedy="Pack it with usdzip.")
        parts = Path(entry.filename.replace("\\", "/")).parts
        if ".." in parts or entry.filename.startswith(("/", "\\")) or ":" in parts[:1]:
            raise AssetError(f"{entry.filename} in it leads out of the package", where=where, remedy=REMEDY)
        if entry.filename.lower().endswith(PACKAGE_SUFFIX):
            raise AssetError("a package in a package is not read", where=where, remedy="Unpack it first.")
    if sum(entry.file_size for entry in entries) > len(data):
        raise AssetError("its files do not fit into it", where=where, remedy=REMEDY)
