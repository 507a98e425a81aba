"""Where the output of an asset of a batch goes, so that all its files stay in the output folder."""

from __future__ import annotations

import os
from pathlib import Path

from meshforge.asset import Asset
from meshforge.files import plain_path
from meshforge.formats.registry import FORMATS


def placed(asset: Asset, base: Path, out_dir: Path) -> Path:
    """The path of an asset's output: below `out_dir` as the asset is below `base`.

    Where the asset has files outside of `base`, or references that pass through a folder above it (MJCF's
    `../cup/a.stl` from within `cup`), it counts from the deepest folder that holds it and them all, so that they still
    end within `out_dir`.
    """
    path, base = plain_path(asset.path), plain_path(base)
    folders = [path.parent, *(plain_path(file).parent for file in asset.files)]
    folders += [plain_path(known.top(asset)) for known in FORMATS if known.name == asset.format]
    if not all(folder.is_relative_to(base) for folder in folders):
        base = Path(os.path.commonpath(folders))
    return out_dir / path.relative_to(base)
