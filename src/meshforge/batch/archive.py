"""Outputs as one zip file."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from meshforge.batch.workers import EXECUTION_DEFAULTS, ExecutionOptions, raise_if_stopped

_NO_DATE = (1980, 1, 1, 0, 0, 0)  # the first that a zip can hold
_CHUNK = 1 << 20
_UNIX, _PLAIN_FILE = 3, 0o100644


def write_archive(
    path: Path,
    folder: Path,
    names: Iterable[str],
    comment: str = "",
    execution: ExecutionOptions = EXECUTION_DEFAULTS,
) -> None:
    """Write files of a folder into a zip file, in order of their names, and never a whole one in memory.

    The same files make the same bytes: dates and rights are left out. names: paths in the folder, with `/`; comment: of
    the zip file; execution: its `progress` is called for each file. Raises StoppedError where its `stop` says so.
    """
    with ZipFile(path, "w", ZIP_DEFLATED) as archive:
        archive.comment = comment.encode()[:65535]
        for name in sorted(set(names)):
            entry = ZipInfo(name, _NO_DATE)
            entry.compress_type, entry.create_system, entry.external_attr = ZIP_DEFLATED, _UNIX, _PLAIN_FILE << 16
            entry.file_size = (folder / name).stat().st_size  # decides how large a file can become
            with (folder / name).open("rb") as source, archive.open(entry, "w") as target:
                while chunk := source.read(_CHUNK):
                    target.write(chunk)
                    raise_if_stopped(execution.stop)
            if execution.progress:
                execution.progress()
