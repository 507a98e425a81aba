"""Where the output of an asset of a batch goes, so that all its files stay in the output folder."""

from __future__ import annotations

import os
from pathlib import Path

from meshforge.asset import Asset
from meshforge.files import plain_path


def placed(asset: Asset, base: Path, out_dir: Path) -> Path:
    """The path of an asset's output: below `out_dir` as the asset is below `base`.

    Where the asset has files outside of `base`, it counts from the deepest folder that holds it and them all, so that
    references which climb above it still end within `out_dir`.
    """
    path, base = plain_path(asset.path), plain_path(base)
    files = [plain_path(file) for file in asset.files]
    if not all(p.is_relative_to(base) for p in (path, *files)):
        base = Path(os.path.commonpath([path.parent, *(file.parent for file in files)]))
    return out_dir / path.relative_to(base)
