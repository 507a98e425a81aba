"""Which assets a list of files, folders and globs means, and the id of each."""

from __future__ import annotations

import glob
import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from meshforge.batch.assets.folder import assets_in, is_own
from meshforge.errors import UsageError
from meshforge.files import globbed, plain_path, relative_name
from meshforge.formats import SUFFIXES, is_asset


@dataclass(frozen=True)
class Found:
    """Assets in sorted order without repetition; base: the common folder of the arguments, from which ids count."""

    base: Path
    paths: tuple[Path, ...]

    def __iter__(self) -> Iterator[Path]:
        return iter(self.paths)

    def __len__(self) -> int:
        return len(self.paths)

    @cached_property
    def ids(self) -> Mapping[str, Path]:
        """The assets by id: the path below the common folder, with forward slashes."""
        return {asset_id(path, self.base): path for path in self.paths}


def expand(patterns: Iterable[str | Path], root: Path | None = None) -> Found:
    """The assets that files, folders and globs (`**` too) name; relative ones count from `root`, or from here.

    A folder stands for all assets in it, at any depth: its URDF, MJCF and SDF, or where there are none its glTF and
    mesh files. A folder of nothing but mesh files of one hull each is one asset of pieces.
    Neither a folder nor a glob means files that are no assets by themselves, such as included parts of an MJCF.
    What MeshForge itself wrote (projects, outputs of `apply`) is passed over, unless named outright.
    Raises UsageError naming the argument that matches nothing.
    """
    root = Path.cwd() if root is None else root.absolute()
    given = [str(pattern) for pattern in patterns]
    if not given:
        raise UsageError("no assets are given", remedy="Name files, folders or globs of assets.")
    paths = {path for pattern in given for path in _matches(pattern, root)}
    base = common_folder(_fixed_part(pattern, root) for pattern in given)
    return Found(base.parent if base in paths else base, tuple(sorted(paths)))


def asset_id(path: Path, base: Path) -> str:
    """The id of an asset: its path below the common folder, with forward slashes."""
    return relative_name(path, base)


def common_folder(folders: Iterable[Path]) -> Path:
    """The deepest folder that holds all of them. Raises UsageError where there is none (several drives)."""
    folders = list(folders)
    try:
        return Path(os.path.commonpath(folders))
    except ValueError as error:
        names = ", ".join(map(str, folders))
        raise UsageError(f"the assets have no common folder: {names}", remedy="Give them in two calls.") from error


def _matches(pattern: str, root: Path) -> list[Path]:
    path = plain_path(root / pattern)
    if path.is_dir():
        found = assets_in(path)
    elif path.is_file():
        found = [path]
    elif glob.has_magic(pattern):
        found = _globbed(pattern, root)
    else:
        raise UsageError("there is no such file or folder", where=pattern)
    if not found:
        raise UsageError("no assets here", where=pattern, remedy=f"Known suffixes: {', '.join(SUFFIXES)}.")
    return found


def _globbed(pattern: str, root: Path) -> list[Path]:
    """What a glob matches: files of known formats, and the assets of folders; under `**`, files only."""
    start = _fixed_part(pattern, root)
    hits = [plain_path(root / name) for name in globbed(pattern, root)]
    hits = [hit for hit in hits if not is_own(hit, start)]
    found = [hit for hit in hits if is_asset(hit)]
    if "**" not in pattern:
        found += [asset for hit in hits if hit.is_dir() for asset in assets_in(hit)]
    return found


def _fixed_part(pattern: str, root: Path) -> Path:
    """The folder that ids count from, for one argument: a folder itself, else that of the file or of the glob."""
    path = plain_path(root / pattern)
    if path.is_dir():
        return path
    if path.exists() or not glob.has_magic(pattern):
        return path.parent
    parts = Path(pattern).parts
    fixed = next(k for k, part in enumerate(parts) if glob.has_magic(part))
    return plain_path(root.joinpath(*parts[:fixed]))
