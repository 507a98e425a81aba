"""Which assets a list of files, folders and globs means, and the id of each."""

import glob
import os
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from meshforge.common import MeshForgeError, UsageError, expand_glob, is_link_cycle, plain_path, relative_name, to_text
from meshforge.common.messages import nearest_name, suggest_name
from meshforge.formats import MESH_SUFFIXES, all_suffixes, is_asset, is_description, read

STATE = ".meshforge"
"""The folder in an output of `apply` or in a project that holds what MeshForge needs to know about it."""
SETTINGS = "meshforge.toml"
"""The file that makes a folder a project."""
OWN_FOLDERS = ("templates", "labels", "demonstrations", "corrections", "prepared", "edited")
"""The folders of a project that hold no assets of the user."""


ADDED = "added"
"""The folder for assets that are added to a project, below its own folder or below the one that ids count from."""


@dataclass(frozen=True)
class AssetSet:
    """Assets in sorted order without repetition; base: the common folder of the arguments, from which ids count.

    home: the folder of a project whose assets lie elsewhere; the ids of those in its `added/` count from it.
    """

    base: Path
    paths: tuple[Path, ...]
    home: Path | None = None

    def __iter__(self) -> Iterator[Path]:
        return iter(self.paths)

    def __len__(self) -> int:
        return len(self.paths)

    @cached_property
    def ids(self) -> Mapping[str, Path]:
        """The assets by id: the path below the common folder, with forward slashes."""
        return {asset_id(path, self.base_of(path)): path for path in self.paths}

    def choose(self, only: Collection[str] | None) -> Mapping[str, Path]:
        """Return the assets of some ids, in order; None for all."""
        if only is None:
            return self.ids
        some = frozenset(only)
        return {key: path for key, path in self.ids.items() if key in some}

    def without(self, away: Collection[str]) -> "AssetSet":
        """Return these but for those of some ids."""
        gone = frozenset(self.ids.keys() & away)
        if not gone:
            return self
        found = self._rest.get(gone)
        if found is None:
            found = replace(self, paths=tuple(path for key, path in self.ids.items() if key not in gone))
            self._rest.clear()  # asked for again and again: of the last ones the answer is kept
            self._rest[gone] = found
        return found

    @cached_property
    def _rest(self) -> "dict[frozenset[str], AssetSet]":
        return {}

    @cached_property
    def suffixes(self) -> frozenset[str]:
        """Those of the assets, as they are written."""
        return frozenset(path.suffix for path in self.paths)

    def base_of(self, path: Path) -> Path:
        """Return the folder that the id of an asset counts from."""
        is_own = self.home is not None and path.is_relative_to(self.added) and not path.is_relative_to(self.base)
        return self.home if self.home is not None and is_own else self.base

    @cached_property
    def added(self) -> Path:
        """The folder that assets come to which are added: never one of somebody's sources, in a project."""
        return (self.home or self.base) / ADDED


def expand(patterns: Iterable[str | Path], root: Path | None = None) -> AssetSet:
    """Return the assets that files, folders and globs (`**` too) name; relative ones count from `root`, or from here.

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
    paths = {path for pattern in given for path in _match_pattern(pattern, root)}
    base = common_folder(_base_folder(pattern, root) for pattern in given)
    return AssetSet(base.parent if base in paths else base, tuple(sorted(paths)))


def asset_id(path: Path, base: Path) -> str:
    """Return the id of an asset: its path below the common folder, with forward slashes."""
    return to_text(relative_name(path, base))


def common_folder(folders: Iterable[Path]) -> Path:
    """Return the deepest folder that holds all of them. Raises UsageError where there is none (several drives)."""
    folders = list(folders)
    try:
        return Path(os.path.commonpath(folders))
    except ValueError as error:
        names = ", ".join(map(str, folders))
        raise UsageError(f"the assets have no common folder: {names}", remedy="Give them in two calls.") from error


def _match_pattern(pattern: str, root: Path) -> list[Path]:
    path = plain_path(root / pattern)
    if path.is_dir():
        found = find_assets_in(path)
    elif path.is_file():
        found = [path]
    elif glob.has_magic(pattern):
        found = _match_glob(pattern, root)
    else:
        alike = (one.name for one in path.parent.glob("*") if nearest_name(path.stem, [one.stem]))
        near = suggest_name(path.name, alike)
        raise UsageError("there is no such file or folder", where=pattern, remedy=near)
    if not found:
        raise UsageError("no assets here", where=pattern, remedy=f"Known suffixes: {', '.join(all_suffixes())}.")
    return found


def _match_glob(pattern: str, root: Path) -> list[Path]:
    """What a glob matches: files of known formats, and the assets of folders; under `**`, files only."""
    start = _base_folder(pattern, root)
    hits = [plain_path(root / name) for name in expand_glob(pattern, root)]
    own = {folder for folder in {hit.parent for hit in hits} if is_own(folder, start)}
    hits = [hit for hit in hits if hit.parent not in own and not (hit.is_dir() and is_own(hit, start))]
    found = [hit for hit in hits if is_asset(hit)]
    if "**" not in pattern:
        found += [asset for hit in hits if hit.is_dir() for asset in find_assets_in(hit)]
    return found


def _base_folder(pattern: str, root: Path) -> Path:
    """The folder that ids count from, for one argument: a folder itself, else that of the file or of the glob."""
    path = plain_path(root / pattern)
    if path.is_dir():
        return path
    if path.exists() or not glob.has_magic(pattern):
        return path.parent
    parts = Path(pattern).parts
    fixed = next(k for k, part in enumerate(parts) if glob.has_magic(part))
    return plain_path(root.joinpath(*parts[:fixed]))


def find_assets_in(folder: Path) -> list[Path]:
    """Return the assets in a folder, at any depth, sorted.

    A tree with descriptions (URDF, MJCF, SDF) has these as its assets, its mesh files being their parts.
    Otherwise every file is an asset, except that a folder of several mesh files of one hull each is one asset of
    pieces. Folders that MeshForge wrote are passed over.
    """
    files = sorted(_walk_assets(folder, folder))
    described = [path for path in files if is_description(path)]
    if described:
        return described
    found = [path for path in files if path.suffix.lower() not in MESH_SUFFIXES]
    by_folder: dict[Path, list[Path]] = {}
    for path in files:
        if path.suffix.lower() in MESH_SUFFIXES:
            by_folder.setdefault(path.parent, []).append(path)
    for parent, own in by_folder.items():
        found += [parent] if len(own) > 1 and all(map(_is_one_hull, own)) else own
    return sorted(found)


def is_own(path: Path, root: Path) -> bool:
    """Return whether MeshForge wrote it: below `root`, in an output of `apply` or a folder that a project keeps."""
    inside = path.relative_to(root).parts if path.is_relative_to(root) else ()
    above = [root.joinpath(*inside[:depth]) for depth in range(len(inside) + 1)]
    kept = (step in OWN_FOLDERS and (folder / SETTINGS).is_file() for folder, step in zip(above, inside, strict=False))
    return any(kept) or any(_is_written(folder, root) for folder in above)


def _walk_assets(folder: Path, root: Path) -> Iterator[Path]:
    for entry in folder.iterdir():
        if entry.name.startswith("."):
            continue
        if is_link_cycle(entry):
            continue
        if entry.is_dir():
            is_own = entry.name in OWN_FOLDERS and (folder / SETTINGS).is_file()
            if not is_own and not _is_written(entry, root):
                yield from _walk_assets(entry, root)
        elif is_asset(entry):
            yield entry


def _is_written(folder: Path, root: Path) -> bool:
    """Whether a folder is an output or a project of its own; one that was named outright is neither."""
    return folder != root and ((folder / STATE).is_dir() or (folder / SETTINGS).is_file())


def _is_one_hull(path: Path) -> bool:
    try:
        asset = read(path)
    except MeshForgeError:
        return False
    return len(asset.geoms) == 1 and not asset.non_convex
