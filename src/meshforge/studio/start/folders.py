"""Paths that a person types or picks on the start page, the folders of this machine, that of a new project, and the
assets that it would have: which they are, and which of them have no hulls."""

import os
import shutil
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, TimeoutError
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from secrets import token_hex
from time import monotonic

from meshforge.batch import SETTINGS, expand, find_sources
from meshforge.common import MeshForgeError, StoppedError, UsageError, describe_error, is_file, plain_path, pluralize
from meshforge.formats import all_suffixes, read
from meshforge.studio.wire.start import AssetsFound, FolderEntry, FolderView
from meshforge.studio.workers import Workers, wait_for

MOST_ENTRIES = 500
"""Folders that are listed of one."""
LOOK_SECONDS = 8.0
"""Seconds that assets are read for before a project is made of them; the studio reads the rest when it is open."""
MOST_READ = 300
"""Assets that are read for that."""
MOST_PARTS = 4
"""Names of parts that are told."""
_ABSOLUTE = "Type the whole path, as /home/me/assets or ~/assets."


def parse_path(text: str, what: str = "the folder") -> Path:
    """Return the absolute path that a person typed; `~` is home. Raises UsageError: empty, relative, or no path."""
    text = text.strip()
    if not text:
        raise UsageError(f"{what} has no name", remedy=_ABSOLUTE)
    if not text.isprintable():
        raise UsageError(f"{what} has a character in its name that no name can have", remedy=_ABSOLUTE)
    try:
        path = Path(text).expanduser()
    except RuntimeError:
        raise UsageError("there is no such user", where=text, remedy=_ABSOLUTE) from None
    if not path.is_absolute():
        raise UsageError(f"{what} is not a whole path", where=text, remedy=_ABSOLUTE)
    return plain_path(path)


def check_folder(path: Path) -> None:
    """Raise UsageError where there is no folder that can be read."""
    try:
        if not path.exists():
            raise UsageError("there is no such folder", where=str(path), remedy="Check the spelling, or browse for it.")
        if not path.is_dir():
            raise UsageError("this is a file", where=str(path), remedy=f"Name its folder: {path.parent}")
        with os.scandir(path):
            pass
    except OSError as error:
        remedy = "Choose a folder that you may read."
        raise UsageError(f"this folder cannot be read: {error.strerror}", where=str(path), remedy=remedy) from None


def list_folder(path: Path) -> FolderView:
    """Return the folders in a folder, by name; hidden ones are left out. Raises UsageError where it cannot be read."""
    check_folder(path)
    folders, files, suffixes = list[str](), 0, set(all_suffixes())
    try:
        with os.scandir(path) as entries:
            for entry in entries:
                if entry.name.startswith("."):
                    continue
                if _is_folder(entry):
                    folders.append(entry.name)
                elif Path(entry.name).suffix.lower() in suffixes:
                    files += 1
    except OSError as error:
        raise UsageError(f"this folder cannot be read: {error.strerror}", where=str(path)) from None
    folders.sort(key=str.casefold)
    shown = folders[:MOST_ENTRIES]
    return FolderView(
        folder=str(path),
        parent=None if path.parent == path else str(path.parent),
        project=is_project(path),
        entries=tuple(FolderEntry(name=name, project=is_project(path / name)) for name in shown),
        more=len(folders) - len(shown),
        files=files,
    )


def is_project(folder: Path) -> bool:
    """Return whether a folder is a project."""
    return is_file(folder / SETTINGS)


def _is_folder(entry: os.DirEntry[str]) -> bool:
    try:
        return entry.is_dir()
    except OSError:
        return False


def suggest_project(name: str) -> Path:
    """Return a folder that is not there yet, for a new project of that name: where the studio was started, or else in
    the home folder where that cannot be written."""
    here, home = Path.cwd(), Path.home()
    parent = here if here != Path(here.anchor) and os.access(here, os.W_OK) else home / "meshforge"
    name = name.strip().strip(".") or "project"
    names = [name, f"{name}-project", *(f"{name}-project-{number}" for number in range(2, 1000))]
    return next((parent / one for one in names if not (parent / one).exists()), parent / name)


def check_place(folder: Path) -> None:
    """Raise UsageError where no new project can be made: something is there already, or it cannot be written."""
    try:
        if is_project(folder):
            remedy = "Open it, or name another folder."
            raise UsageError("there is a project here already", where=str(folder), remedy=remedy)
        if folder.is_symlink() or (folder.exists() and not folder.is_dir()):
            raise UsageError("there is a file or a link of this name", where=str(folder), remedy="Name another folder.")
        if other := next(folder.iterdir(), None) if folder.exists() else None:
            problem = f"this folder holds something already: {other.name}"
            raise UsageError(problem, where=str(folder), remedy="Name a new folder, or an empty one.")
        above = next(parent for parent in folder.parents if parent.exists())
    except OSError as error:
        raise _describe_refusal(folder, error) from None
    if not above.is_dir():
        raise UsageError("this is a file", where=str(above), remedy="Name a folder that lies in no file.")


@contextmanager
def build_project(folder: Path) -> Iterator[Path]:
    """Open a new folder to fill, beside the place that it takes then; where an error came up, it goes.

    After a kill there is no project, but maybe that hidden folder. Raises UsageError where no project can be made.
    """
    check_place(folder)
    parents = [parent for parent in folder.parents if not parent.exists()]
    draft = folder.parent / f".{folder.name[:80]}.{token_hex(4)}.new-project"
    try:
        draft.mkdir(parents=True)
        yield draft
        if folder.exists():
            folder.rmdir()  # it is empty
        draft.rename(folder)
    except BaseException as error:
        shutil.rmtree(draft, ignore_errors=True)
        for parent in parents:
            with suppress(OSError):  # something else is in it by now
                parent.rmdir()
        if isinstance(error, OSError):
            raise _describe_refusal(folder, error) from None
        raise


def _describe_refusal(folder: Path, error: OSError) -> UsageError:
    remedy = "Name a folder that you may write, on a disk with room."
    return UsageError(f"the project cannot be written here: {error.strerror}", where=str(folder), remedy=remedy)


@dataclass(frozen=True, slots=True)
class _Look:
    """What one asset holds. pieces: how many pieces and bodies can be decomposed; seen: how many of these are bodies
    that are only seen, while others of the asset collide; parts: names of the parts of those that have several;
    problem: why it cannot be read."""

    pieces: int = 0
    seen: int = 0
    parts: tuple[str, ...] = ()
    problem: str | None = None


def look_at_folder(workers: Workers, folder: Path) -> AssetsFound:
    """Return the assets in a folder. Raises UsageError where there is no such folder, or no asset in it."""
    check_folder(folder)
    return look_at_assets(workers, folder, expand([folder]).paths, folder.name)


def look_at_assets(workers: Workers, folder: Path, paths: Sequence[Path], name: str) -> AssetsFound:
    """Return what some assets hold, as far as they can be read in a few seconds. name: of the project."""
    looks = _look_at_some(workers, paths)
    problems = [look.problem for look in looks if look.problem]
    return AssetsFound(
        folder=str(folder),
        kinds=_describe_kinds(paths),
        assets=len(paths),
        read=len(looks),
        pieces=sum(look.pieces for look in looks),
        seen=sum(look.seen for look in looks),
        bare=sum(look.pieces > 0 for look in looks),
        divided=sum(bool(look.parts) for look in looks),
        parts=tuple(dict.fromkeys(name for look in looks for name in look.parts))[:MOST_PARTS],
        broken=len(problems),
        problem=problems[0] if problems else None,
        project=str(suggest_project(name)),
    )


def _look_at_some(workers: Workers, paths: Sequence[Path]) -> list[_Look]:
    """The first assets, in order, until the time is up; one at least."""
    futures: list[Future[_Look]] = [workers.start(_look, path) for path in paths[:MOST_READ]]
    looks, until = list[_Look](), None
    for future in futures:
        try:
            looks.append(_wait_until(future, until))
        except TimeoutError:
            break
        until = until or monotonic() + LOOK_SECONDS  # the process of the first one had to start
    for future in futures:
        future.cancel()
    return looks


def _wait_until(future: Future[_Look], until: float | None) -> _Look:
    """What came of one. Raises TimeoutError where it is not known in time, StoppedError where nobody waits any more."""
    if until is not None and not future.done():
        future.exception(timeout=max(until - monotonic(), 0.01))
    try:
        return wait_for(future)
    except StoppedError:
        raise
    except MeshForgeError as error:  # its process died
        return _Look(problem=error.message)


def _look(path: Path) -> _Look:
    try:
        asset = read(path)
        asset.refuse_missing()
        sources = [source for source in find_sources(asset) if not source.is_hopeless]
        known = [source.surface.parts for source in sources if source.surface.parts and source.surface.parts.is_divided]
        names = dict.fromkeys(parts.names[k] for parts in known for k in parts.numbers)
        seen = sum(source.kind == "body" for source in sources) if asset.geoms or asset.non_convex else 0
        return _Look(len(sources), seen, tuple(names)[:MOST_PARTS])
    except Exception as error:  # one asset never hides the others
        return _Look(problem=describe_error(error, str(path)).split("\n")[0])


def _describe_kinds(paths: Sequence[Path]) -> str:
    """How many there are of which format: `12 URDF, 1 folder of pieces`."""
    counts = Counter(path.suffix.lower().lstrip(".").upper() if path.is_file() else "" for path in paths)
    words = (
        f"{count:,} {kind}" if kind else pluralize(count, "folder of pieces", "folders of pieces")
        for kind, count in counts.most_common()
    )
    return ", ".join(words)
