"""USDZ packages: archives without compression, the root layer first, each file on a multiple of 64 bytes."""

from __future__ import annotations

import io
import struct
import zipfile
from collections.abc import Mapping

_ALIGNMENT = 64
_HEADER = 30  # bytes of a local header before the name
_PADDING = 0x1986  # the id of the extra field that holds nothing


def packed(files: Mapping[str, bytes]) -> bytes:
    """A package of files by their names, in that order."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_STORED) as archive:
        for name, data in files.items():
            info = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            info.external_attr = 0o644 << 16
            info.extra = _padding(stream.tell() + _HEADER + len(name.encode()))
            archive.writestr(info, data)
    return stream.getvalue()


def unpacked(data: bytes) -> dict[str, bytes]:
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
