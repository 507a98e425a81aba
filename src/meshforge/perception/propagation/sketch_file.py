"""Arrays that describe a mesh in a file, with the digest of all that they were made from."""

from __future__ import annotations

import zipfile
import zlib
from collections.abc import Mapping
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from meshforge.files import replacing

Arrays = Mapping[str, NDArray[Any]]
_KEY = "made_from"


def write_arrays(path: Path, key: str, arrays: Arrays) -> None:
    """Keep arrays that were made from what `key` is the digest of; not synced to disk, for they can be made again."""
    with replacing(path) as draft, draft.open("wb") as file:
        kept: dict[str, Any] = {_KEY: np.array(key), **arrays}
        np.savez(file, **kept)


def read_arrays(path: Path, key: str, *names: str) -> list[NDArray[Any]] | None:
    """The arrays of some names; None where none are kept, they were made from something else, or are damaged."""
    try:
        with np.load(BytesIO(path.read_bytes()), allow_pickle=False) as kept:
            return [kept[name] for name in names] if str(kept[_KEY]) == key else None
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile, zlib.error):
        return None
