"""Copies and hard links that appear whole or not at all."""

from __future__ import annotations

import contextlib
import filecmp
import os
import shutil
import tempfile
from pathlib import Path

from meshforge.errors import AssetError


def same_content(target: Path, content: bytes | Path) -> bool:
    """Whether a file that exists holds just that already."""
    if isinstance(content, Path):
        if not content.is_file():
            raise AssetError("a file that the asset refers to is gone", where=str(content))
        return target.samefile(content) or filecmp.cmp(target, content, shallow=False)
    return target.stat().st_size == len(content) and target.read_bytes() == content


def copy_atomically(source: Path, target: Path, *, link: bool) -> None:
    """Put a copy of a file in place, or with `link` a hard link where the disk allows it. Folders are made."""
    target.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(prefix=f".{target.name[:80]}.", suffix=".tmp", dir=target.parent)
    draft = Path(name)
    try:
        with os.fdopen(handle, "wb") as stream:
            if not (link and _linked(source, draft)):
                with source.open("rb") as original:
                    shutil.copyfileobj(original, stream)
                stream.flush()
                os.fsync(stream.fileno())
                draft.chmod(source.stat().st_mode & 0o777)
        draft.replace(target)
    except BaseException:
        draft.unlink(missing_ok=True)
        raise


def _linked(source: Path, draft: Path) -> bool:
    """Whether the draft could be made a link to the source; another disk or file system may not allow it."""
    spare = draft.with_name(draft.name + "l")
    with contextlib.suppress(OSError):
        os.link(source.resolve(), spare)
        spare.replace(draft)
        return True
    return False
