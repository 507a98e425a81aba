"""What is looked at before the library opens a file: bytes that would crash it, or cost more than they are worth."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path

import numpy as np

from meshforge.errors import AssetError

TEXT = b"#usda"
_CRATE, _ZIP = b"PXR-USDC", b"PK\x03\x04"
_DEEPEST = 1000  # brackets within brackets; the library's parser overflows its stack at some ten thousands
_TOC_PLACE, _SECTION, _MOST_SECTIONS = 16, 32, 64
_NAME = 16  # bytes of a section's name
_DENSEST = 2048  # numbers that a byte can stand for where integers are coded twice over
_DENSEST_TEXT = 255  # bytes that one byte can stand for, by LZ4
_COUNTED = (b"TOKENS", b"FIELDS", b"FIELDSETS", b"PATHS", b"SPECS", b"STRINGS")
_QUIET = re.compile(rb'"""(?:[^\\]|\\.)*?"""|"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)*\'|@[^@\n]*@|#[^\n]*', re.S)
REMEDY = "Fetch or export it anew."


def refuse_harmful(data: bytes, where: str) -> None:
    """Raise AssetError where the bytes of a layer or package plainly are damaged, or made to do harm."""
    if data.startswith(_CRATE):
        _refuse_crate(data, where)
    elif data.startswith(_ZIP):
        _refuse_package(data, where)
    elif data.lstrip().startswith(TEXT):
        _refuse_deep(data, where)
    else:
        raise AssetError("this is no USD file, neither text nor crate nor package", where=where, remedy=REMEDY)


def _refuse_deep(data: bytes, where: str) -> None:
    plain = np.frombuffer(_QUIET.sub(b"", data), dtype=np.uint8)
    steps = np.isin(plain, list(b"([{")).astype(np.int64) - np.isin(plain, list(b")]}"))
    if len(steps) and steps.cumsum().max() > _DEEPEST:
        raise AssetError(f"it is nested more than {_DEEPEST} deep", where=where, remedy="No asset needs that.")


def _refuse_crate(data: bytes, where: str) -> None:
    """Raise AssetError where a table of a binary layer lies outside of it, or counts more than it can hold."""
    damaged = AssetError("it is damaged or cut off: its table of contents does not fit it", where=where, remedy=REMEDY)
    place = _number(data, _TOC_PLACE)
    count = _number(data, place) if place is not None else None
    if place is None or count is None or count > _MOST_SECTIONS or place + 8 + count * _SECTION > len(data):
        raise damaged
    for k in range(count):
        at = place + 8 + k * _SECTION
        start, size = _number(data, at + _NAME), _number(data, at + _NAME + 8)
        if start is None or size is None or start + size > len(data):
            raise damaged
        name, said = data[at : at + _NAME].rstrip(b"\0"), _number(data, start)
        if name in _COUNTED and (said is None or said > _DENSEST * (size + 1)):
            raise damaged
        long = _number(data, start + 8) if name == b"TOKENS" else 0
        if long is None or long > _DENSEST_TEXT * (size + 64):
            raise damaged


def _number(data: bytes, at: int) -> int | None:
    """The unsigned number of eight bytes at a place, None outside of the data."""
    return int.from_bytes(data[at : at + 8], "little") if 0 <= at <= len(data) - 8 else None


def _refuse_package(data: bytes, where: str) -> None:
    """Raise AssetError where a package is no archive, is compressed, or has places outside of itself."""
    import io

    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            entries = archive.infolist()
            if not entries or sum(entry.file_size for entry in entries) > len(data):
                raise AssetError("its files do not fit into it", where=where, remedy=REMEDY)
            for entry in entries:
                if entry.compress_type != zipfile.ZIP_STORED or entry.flag_bits & 1:
                    problem = f"{entry.filename} in it is compressed or encrypted, which USDZ does not allow"
                    raise AssetError(problem, where=where, remedy="Pack it with usdzip.")
                parts = Path(entry.filename.replace("\\", "/")).parts
                if ".." in parts or entry.filename.startswith(("/", "\\")) or ":" in parts[:1]:
                    raise AssetError(f"{entry.filename} in it leads out of the package", where=where, remedy=REMEDY)
            first = archive.read(entries[0])
            nested = [archive.read(e) for e in entries[1:] if e.filename.lower().endswith((".usd", ".usda", ".usdc"))]
    except (zipfile.BadZipFile, NotImplementedError, OSError, ValueError, RuntimeError, EOFError) as error:
        raise AssetError(f"its archive is damaged: {error}", where=where, remedy=REMEDY) from error
    for layer in (first, *nested):
        if layer.startswith(_ZIP):
            raise AssetError("a package in a package is not read", where=where, remedy="Unpack it first.")
        refuse_harmful(layer, where)
