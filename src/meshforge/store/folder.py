"""Making a project folder, finding its assets, and adding more of them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from pathlib import Path

from meshforge.batch import SETTINGS, AssetSet, expand
from meshforge.common import ProjectError, UsageError, nearest_name, plain_path
from meshforge.formats import SUFFIXES, is_asset
from meshforge.language import Orient
from meshforge.store.settings import (
    Settings,
    change_setting,
    orientation_text,
    parse_orientation,
    path_seen_from,
    read_settings,
    write_settings,
)


def create_folder(
    folder: str | Path,
    assets: Sequence[str | Path],
    name: str | None,
    vocabulary: Sequence[str],
    orient: Orient | str | None,
) -> Path:
    """Make a project folder, and give its absolute path. Raises as `Project.create` does."""
    if not str(folder):
        raise UsageError("the folder to make has no name", remedy="Name it; . is the one you are in.")
    folder = Path(folder).absolute()
    if (folder / SETTINGS).exists():
        raise ProjectError("there is a project here already", where=str(folder), remedy="Choose another folder.")
    found = expand(assets)
    text = orient if isinstance(orient, str) else orientation_text(orient)
    parse_orientation(text)
    settings = Settings(
        name=name or folder.name,
        assets=tuple(path_seen_from(folder, str(pattern)) for pattern in assets),
        base=path_seen_from(folder, str(found.base)),
        vocabulary=tuple(vocabulary),
        orient=text,
    )
    write_settings(folder, settings)
    return folder


def find_assets(folder: Path) -> AssetSet:
    """The assets that the settings of a project name. Raises ProjectError where one is gone or lies elsewhere."""
    settings = read_settings(folder)
    base = Path(os.path.normpath(folder / settings.base))
    try:
        found = AssetSet(base, expand(settings.assets, folder).paths)
    except UsageError as error:
        raise ProjectError(f"assets: {error.message}", where=str(folder / SETTINGS)) from None
    for key in found.ids:
        if key.startswith("../"):
            raise ProjectError(
                f"the asset {key} lies outside of {base}, the folder that ids count from",
                where=str(folder / SETTINGS),
                remedy="Make another project for it, or move it there.",
            )
    return found


def path_of(folder: Path, found: AssetSet, asset: str) -> Path:
    """The file of an asset. Raises ProjectError, naming the nearest id, where there is no such asset."""
    ids = found.ids
    if asset not in ids:
        like = nearest_name(asset, ids)
        remedy = f"Did you mean {like!r}?" if like else f"See them with: meshforge status {folder}"
        raise ProjectError(f"there is no asset {asset!r}", where=str(folder), remedy=remedy)
    return ids[asset]


def add_assets(folder: Path, found: AssetSet, paths: Iterable[str | Path]) -> None:
    """Name files among the assets of the settings, as far as these do not mean them already; the caller holds the lock.

    Assets that a pattern would pass over because of the new files, such as mesh files in a folder that gets a URDF,
    are named as well. Raises ProjectError for a file that is no asset, or lies outside of the folder of the ids.
    """
    wanted = [_check_path(found.base, plain_path(Path(path))) for path in paths]
    present = set(find_assets(folder).paths)
    had = (path for path in found if path.exists())
    more = [path for path in dict.fromkeys([*had, *wanted]) if path not in present]
    if more:
        names = (path_seen_from(folder, str(path)) for path in more)
        change_setting(folder, "assets", (*read_settings(folder).assets, *names))


def _check_path(base: Path, path: Path) -> Path:
    if not path.is_relative_to(base):
        remedy = "Put it there, or make another project for it."
        raise ProjectError(f"it lies outside of {base}, the folder that ids count from", where=str(path), remedy=remedy)
    if not is_asset(path):
        remedy = f"Known suffixes: {', '.join(SUFFIXES)}."
        raise ProjectError("this is no asset that can be read", where=str(path), remedy=remedy)
    return path
