"""`model.config`: what a Gazebo model's folder holds, an SDF file for each version of the format."""

from __future__ import annotations

import os
from pathlib import Path

from meshforge.errors import AssetError
from meshforge.files import is_file
from meshforge.formats.sdf.files.version import NEWEST, version_of
from meshforge.formats.xml import Text, parsed

CONFIG = "model.config"
"""The file that makes a folder a Gazebo model."""
_USUAL = "model.sdf"


def main_file(folder: Path) -> Path | None:
    """The SDF file of a model's folder: that of the newest known version which `model.config` names, or `model.sdf`.

    None where there is none. Raises AssetError: `model.config` is no XML.
    """
    named = sorted(versions(folder).items(), reverse=True)
    names = [name for version, name in named if version <= NEWEST] or [name for _, name in named]
    found = (Path(os.path.normpath(folder / name)) for name in (*names, _USUAL))
    return next((path for path in found if is_file(path)), None)


def is_main(path: Path) -> bool:
    """Whether a file is the one of its folder's model, or none of those that `model.config` names."""
    try:
        named = versions(path.parent)
        return path.name not in named.values() or main_file(path.parent) == path
    except AssetError:
        return True


def versions(folder: Path) -> dict[tuple[int, int], str]:
    """The files that a folder's `model.config` names, by the version of SDF they are in; none where there is none."""
    path = folder / CONFIG
    if not is_file(path):
        return {}
    try:
        root = parsed(Text.of(path.read_bytes()).data, str(path))
    except OSError as error:
        raise AssetError(f"cannot be read: {error.strerror}", where=str(path)) from error
    return {version_of(e.attributes.get("version", "")) or (0, 0): e.text for e in root.each("sdf") if e.text}
