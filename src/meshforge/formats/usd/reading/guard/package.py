"""Packages: archives that are stored as they are, with nothing that leads out of them."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path

from meshforge.errors import AssetError
from meshforge.formats.usd.reading.guard.remedy import REMEDY

PACKAGE = b"PK\x03\x04"


def layers_of(data: bytes, where: str) -> list[bytes]:
    """The first file of a package and all its other layers.

    Raises AssetError where it is no archive, is compressed, or has places outside of itself.
    """
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
            others = (entry for entry in entries[1:] if entry.filename.lower().endswith((".usd", ".usda", ".usdc")))
            return [archive.read(entry) for entry in (entries[0], *others)]
    except (zipfile.BadZipFile, NotImplementedError, OSError, ValueError, RuntimeError, EOFError) as error:
        raise AssetError(f"its archive is damaged: {error}", where=where, remedy=REMEDY) from error
