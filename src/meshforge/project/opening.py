"""Making and opening projects: which assets belong to them, and what these are called."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from meshforge.batch import SETTINGS, Found, expand
from meshforge.errors import ProjectError, UsageError, nearest
from meshforge.language import Orient
from meshforge.project.settings import (
    Settings,
    orientation_text,
    parse_orientation,
    read_settings,
    seen_from,
    write_settings,
)


def create(
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
        assets=tuple(seen_from(folder, str(pattern)) for pattern in assets),
        base=seen_from(folder, str(found.base)),
        vocabulary=tuple(vocabulary),
        orient=text,
    )
    write_settings(folder, settings)
    return folder


def found_assets(folder: Path) -> Found:
    """The assets that the settings of a project name. Raises ProjectError where one is gone or lies elsewhere."""
    settings = read_settings(folder)
    base = Path(os.path.normpath(folder / settings.base))
    try:
        found = Found(base, expand(settings.assets, folder).paths)
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


def path_of(folder: Path, found: Found, asset: str) -> Path:
    """The file of an asset. Raises ProjectError, naming the nearest id, where there is no such asset."""
    ids = found.ids
    if asset not in ids:
        like = nearest(asset, ids)
        remedy = f"Did you mean {like!r}?" if like else f"See them with: meshforge status {folder}"
        raise ProjectError(f"there is no asset {asset!r}", where=str(folder), remedy=remedy)
    return ids[asset]
