"""Copies and hard links that appear whole or not at all."""

from __future__ import annotations

import contextlib
import filecmp
import os
import shutil
from pathlib import Path

from meshforge.errors import AssetError
from meshforge.files import replacing


def same_content(target: Path, content: bytes | Path) -> bool:
    """Whether a file that exists holds just that already."""
    if isinstance(content, Path):
        if not content.is_file():
            raise AssetError("a file that the asset refers to is gone", where=str(content))
        return target.samefile(content) or filecmp.cmp(target, content, shallow=False)
    return target.stat().st_size == len(content) and target.read_bytes() == content


def copy_atomically(source: Path, target: Path, *, link: bool) -> None:
    """Put a copy of a file in place, or with `link` a hard link where the disk allows it. Folders are made."""
    with replacing(target) as draft:
        if link and _linked(source, draft):
            return
        with draft.open("wb") as stream, source.open("rb") as original:
            shutil.copyfileobj(original, stream)
            stream.flush()
            os.fsync(stream.fileno())
        draft.chmod(source.stat().st_mode & 0o777)


def _linked(source: Path, draft: Path) -> bool:
    """Whether the draft could be made a link to the source; another disk or file system may not allow it."""
    spare = draft.with_name(draft.name + "l")
    with contextlib.suppress(OSError):
        os.link(source.resolve(), spare)
        spare.replace(draft)
        return True
    return False
