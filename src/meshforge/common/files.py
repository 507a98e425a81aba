"""Writes files so that a killed process leaves the old state or the new one, never half; names and finds files, and
notices when they change."""

import errno
import glob
import hashlib
import os
import shlex
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import TypeVar

from meshforge.common.messages import escape_name

_DRAFT_SUFFIX = ".tmp"
DISK_ERRORS = (errno.ENOSPC, errno.EDQUOT, errno.EROFS)
"""What is wrong with the disk, not with a file: all writing to it would fail alike."""
_AT_ONCE = 32  # files that wait for the disk at the same time

Item = TypeVar("Item")
Result = TypeVar("Result")

FileState = tuple[int, int, int, int]
"""Size [bytes], when contents and anything else of a file were changed last [ns], and its inode: where these are the
same, it most likely holds the same, even where somebody set its time back."""
FileStates = dict[Path, FileState | None]


def write_atomically(path: Path, content: str | bytes) -> None:
    """Write a whole file, or nothing of it. Folders are made; a file that is replaced hands on its mode."""
    with replace_atomically(path) as draft:
        _fill(draft, content, path)


def write_all_atomically(contents: Mapping[Path, str | bytes | None]) -> None:
    """Write whole files as `write_atomically` does each; they wait for the disk together, which takes about as long as
    one. None removes a file. Where an error comes up before all are written, none is replaced."""
    written = {path: data for path, data in contents.items() if data is not None}
    with ExitStack() as stack:
        drafts = [(stack.enter_context(replace_atomically(path)), data, path) for path, data in written.items()]
        do_at_once(lambda row: _fill(*row), drafts)
    for path in contents.keys() - written.keys():
        path.unlink(missing_ok=True)


def do_at_once(work: Callable[[Item], Result], items: Iterable[Item]) -> list[Result]:
    """Do what waits for the disk for several items at once; the results in their order."""
    items = list(items)
    if len(items) < 2:
        return list(map(work, items))
    with ThreadPoolExecutor(_AT_ONCE) as pool:
        return list(pool.map(work, items))


def _fill(draft: Path, content: str | bytes, path: Path) -> None:
    data = content.encode("utf-8") if isinstance(content, str) else content
    with draft.open("wb") as stream:
        stream.write(data)
        stream.flush()
        os.fsync(stream.fileno())
    draft.chmod(_mode_of(path))


@contextmanager
def replace_atomically(path: Path) -> Iterator[Path]:
    """Open a new file beside `path`, to be filled and flushed; then it takes that name, or goes where an error came up.

    What the disk refuses is an OSError about `path`.
    """
    draft: Path | None = None
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(prefix=_draft_prefix(path), suffix=_DRAFT_SUFFIX, dir=path.parent)
        os.close(handle)
        draft = Path(name)
        yield draft
        draft.replace(path)
    except BaseException as error:
        if draft:
            draft.unlink(missing_ok=True)
        refused = (*DISK_ERRORS, errno.EACCES, errno.EPERM)
        if isinstance(error, OSError) and error.errno in refused:  # it names the draft, or no file at all
            raise OSError(error.errno, error.strerror, str(path)) from error
        raise


def find_drafts(path: Path) -> Iterator[Path]:
    """Return what writers of a file left half-written beside it when they were killed; or what one is writing now."""
    return path.parent.glob(f"{glob.escape(_draft_prefix(path))}????????{_DRAFT_SUFFIX}")


def _draft_prefix(path: Path) -> str:
    return f".{path.name[:80]}."


def file_state(path: Path) -> FileState | None:
    """Return the state of a file, None where it is not there."""
    try:
        stat = path.stat()
    except OSError:
        return None
    return stat.st_size, stat.st_mtime_ns, stat.st_ctime_ns, stat.st_ino


def file_states(paths: Iterable[Path]) -> FileStates:
    """Return the states of files."""
    return {path: file_state(path) for path in paths}


def file_digest(path: Path) -> str:
    """Return a digest of a file's bytes: 32 hexadecimal digits. Raises OSError where it cannot be read."""
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, lambda: hashlib.blake2b(digest_size=16)).hexdigest()


def is_file(path: Path) -> bool:
    """Return whether there is a file; of a name that no file can have (too long, with a zero byte), that there is none.

    Within `confine_reading`, there is none outside of that folder, whatever the disk holds.
    """
    try:
        return not is_beyond_reach(path) and path.is_file()
    except (OSError, ValueError):
        return False


_REACH: ContextVar[Path | None] = ContextVar("reach", default=None)


@contextmanager
def confine_reads(folder: Path) -> Iterator[None]:
    """Hide within the block what files refer to outside of a folder.

    For files of strangers: no message then tells whether a file of that name is on the disk.
    """
    before = _REACH.set(plain_path(folder))
    try:
        yield
    finally:
        _REACH.reset(before)


def reads_folder() -> Path | None:
    """Return the folder to which reading is confined, None where it is not."""
    return _REACH.get()


def is_beyond_reach(path: Path) -> bool:
    """Return whether a path leads out of the folder to which reading is confined, if it is."""
    folder = _REACH.get()
    return folder is not None and not plain_path(path).is_relative_to(folder)


def relative_name(path: Path, base: Path) -> str:
    """Return a path as seen from a folder, with forward slashes."""
    return os.path.relpath(path, base).replace(os.sep, "/")


def plain_path(path: Path) -> Path:
    """Return the absolute path without `..`; symbolic links stay as the user wrote them."""
    return Path(os.path.normpath(path.absolute()))


def quote_path(path: Path) -> str:
    """Return a path as one types it here."""
    here = Path.cwd()
    text = str(path.relative_to(here) if path.is_relative_to(here) else path)
    if escape_name(text) == text:
        return shlex.quote(text)
    return "$'" + escape_name(text.replace("\\", "\\\\").replace("'", "\\'")) + "'"


def _mode_of(path: Path) -> int:
    if path.exists():
        return path.stat().st_mode & 0o777
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask


def expand_glob(pattern: str, root: Path | None = None) -> list[str]:
    """Return what a glob matches, as names from `root`, sorted; under `**`, links are followed, never in a circle."""
    base, stars, rest = _split_at_stars(pattern)
    if not stars:
        return sorted(glob.glob(pattern, root_dir=root))  # noqa: PTH207 (Path.glob takes no ".." and no absolute path)
    found = set[str]()
    for start in expand_glob(base, root) if base else [""]:
        for folder in _walk_folders(start, root or Path()):
            found.update(_join(folder, name) for name in expand_glob(rest or "*", (root or Path()) / folder))
    return sorted(found)


def _split_at_stars(pattern: str) -> tuple[str, bool, str]:
    """What stands before the first `**` of a glob, whether there is one, and what stands behind it."""
    parts = Path(pattern).parts
    at = parts.index("**") if "**" in parts else len(parts)
    return _join(*parts[:at]), at < len(parts), _join(*parts[at + 1 :])


def _walk_folders(start: str, root: Path) -> Iterator[str]:
    waiting = [start]
    while waiting:
        folder = waiting.pop()
        if not (root / folder).is_dir() or is_link_cycle(root / folder):
            continue
        yield folder
        with os.scandir(root / folder) as entries:
            waiting += [_join(folder, entry.name) for entry in entries if not entry.name.startswith(".")]


def is_link_cycle(folder: Path) -> bool:
    """Return whether a folder is a link to one that it lies in, so that going into it would never end."""
    real = folder.resolve() if folder.is_symlink() else None
    return real is not None and any(above.resolve() == real for above in plain_path(folder.absolute()).parents)


def _join(*names: str) -> str:
    return os.path.join("", *names)  # noqa: PTH118 (a name stays as it was written, and may be none)
