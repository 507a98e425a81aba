"""Which assets belong to the family of a project: some are left out and kept, some are removed."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from pathlib import Path

from meshforge.batch import SETTINGS, AssetSet, expand
from meshforge.common import ProjectError, plain_path, write_atomically
from meshforge.store.settings import edit_settings, read_settings, take_back


def leave_out(folder: Path, found: AssetSet, assets: Collection[str]) -> None:
    """Leave assets out of the family, under the lock that the caller holds; all that is kept for them stays.

    Raises ProjectError where none of the family would be left.
    """
    _check_rest(folder, found, assets)
    settings = read_settings(folder)
    names = tuple(dict.fromkeys((*settings.left_out, *assets)))
    write_atomically(folder / SETTINGS, edit_settings(folder, {"left_out": names}))


def include_again(folder: Path, assets: Iterable[str]) -> None:
    """Let assets be part of the family again, under the lock that the caller holds."""
    take_back(folder, assets)


def remove_from_settings(folder: Path, found: AssetSet, assets: Collection[str]) -> None:
    """Let assets belong to the project no more, under the lock that the caller holds.

    What names one of them outright goes; where a folder or a glob means it, its id is noted as removed. Raises
    ProjectError where none of the family would be left.
    """
    _check_rest(folder, found, assets)
    settings = read_settings(folder)
    paths = {found.ids[asset] for asset in assets if asset in found.ids}
    named = tuple(entry for entry in settings.assets if plain_path(folder / entry) not in paths)
    meant = set(expand(named, folder).paths) if named else set()
    still = [asset for asset in assets if asset not in found.ids or found.ids[asset] in meant]
    values = {
        "assets": named,
        "removed": tuple(dict.fromkeys((*settings.removed, *still))),
        "left_out": tuple(one for one in settings.left_out if one not in set(assets)),
    }
    changed = {key: value for key, value in values.items() if value != getattr(settings, key)}
    write_atomically(folder / SETTINGS, edit_settings(folder, changed))


def _check_rest(folder: Path, found: AssetSet, assets: Collection[str]) -> None:
    known = {*found.ids, *found.left_out}
    for asset in assets:
        if asset not in known:
            raise ProjectError(f"there is no asset {asset!r}", where=str(folder))
    if found.ids.keys() <= set(assets):
        raise ProjectError("no asset of the family would be left", where=str(folder), remedy="Add other assets first.")
