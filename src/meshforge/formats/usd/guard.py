"""What is looked at before the library composes a stage: packages that lead out of themselves, and references to what
may not be read. All else that may be wrong with a layer is for the library, in a process of its own."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path

from meshforge.common import AssetError, is_beyond_reach
from meshforge.formats.libraries import pxr

PACKAGE_MARK = b"PK\x03\x04"
_REMEDY = "Repair the file, or export it anew."


def refuse_far_references(path: Path, data: bytes) -> None:
    """Raise AssetError where a file, or one that it refers to, leads to what may not be read or is no file.

    To be used within `usd`; data: the bytes of the file.
    """
    known, waiting = set[str](), [(path, data)]
    while waiting:
        file, content = waiting.pop()
        if str(file.absolute()) in known:
            continue
        known.add(str(file.absolute()))
        if content.startswith(PACKAGE_MARK):
            _refuse_package(content, str(file))
        layer = pxr.Sdf.Layer.FindOrOpen(str(file))
        for reference in sorted(filter(None, layer.GetCompositionAssetDependencies() if layer else ())):
            found = file.parent / reference.split(":SDF_FORMAT_ARGS:", 1)[0]
            if is_beyond_reach(found):
                raise AssetError(f"it refers to {reference}, which is not beside it", where=str(file))
            try:
                if found.exists() and not found.is_file():  # a pipe would be waited for, a device may never end
                    problem = f"it refers to {reference}, which is a pipe, a folder or a device"
                    raise AssetError(problem, where=str(file))
                if found.is_file():
                    waiting.append((found, found.read_bytes()))
            except (OSError, ValueError):
                continue


def _refuse_package(data: bytes, where: str) -> None:
    """Raise AssetError where a package is no archive, is compressed, holds another, or has places outside of itself."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            entries = archive.infolist()
    except (zipfile.BadZipFile, NotImplementedError, OSError, ValueError, RuntimeError, EOFError) as error:
        raise AssetError(f"its archive is damaged: {error}", where=where, remedy=_REMEDY) from error
    for entry in entries:
        if entry.compress_type != zipfile.ZIP_STORED or entry.flag_bits & 1:
            problem = f"{entry.filename} in it is compressed or encrypted, which USDZ does not allow"
            raise AssetError(problem, where=where, remedy="Pack it with usdzip.")
        parts = Path(entry.filename.replace("\\", "/")).parts
        if ".." in parts or entry.filename.startswith(("/", "\\")) or ":" in parts[:1]:
            raise AssetError(f"{entry.filename} in it leads out of the package", where=where, remedy=_REMEDY)
        if entry.filename.lower().endswith(".usdz"):
            raise AssetError("a package in a package is not read", where=where, remedy="Unpack it first.")
    if sum(entry.file_size for entry in entries) > len(data):
        raise AssetError("its files do not fit into it", where=where, remedy=_REMEDY)
