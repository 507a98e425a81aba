"""Makes the frozen assets, or looks at some of them: `script/make-benchmark [CATEGORY ...]`."""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from time import perf_counter

from benchmark.assets.asset import Asset
from benchmark.assets.decomposition import SETTINGS, Decomposition, decompose_asset
from benchmark.assets.generation import CALIBRATION, CATEGORIES, COUNT, SEED, assets
from benchmark.assets.pictures import look
from benchmark.assets.storage import DATA, read, write
from meshforge.geometry.decomposition.run import cache_folder

_CALIBRATING = {name: 9 if k < 3 else 8 for k, name in enumerate(CATEGORIES)}
"""Assets of each category in the calibration set: 67, of three meshes each, one less than 202."""


def main() -> None:
    """Make what is asked for."""
    parser = argparse.ArgumentParser(prog="script/make-benchmark", description=__doc__)
    parser.add_argument("categories", nargs="*", metavar="CATEGORY", help=f"of {', '.join(CATEGORIES)}; default: all")
    parser.add_argument("--calibration", action="store_true", help="the calibration set instead of the 600")
    parser.add_argument("--count", type=int, help="only so many assets a category (then --out must be given)")
    parser.add_argument("--only", type=int, nargs="+", metavar="NUMBER", help="only these assets (likewise)")
    parser.add_argument("--out", type=Path, default=DATA, help="the folder to write to")
    parser.add_argument("--cache", action="store_true", help="use and keep decompositions in the usual cache")
    parser.add_argument("--picture", type=Path, help="a folder for a picture of each category")
    given = parser.parse_args()
    if (given.count or given.only) and given.out == DATA:
        parser.error("with --count or --only say --out FOLDER: the frozen data are whole")
    for name in given.categories or CATEGORIES:
        count = given.count or (_CALIBRATING[name] if given.calibration else COUNT)
        stem = f"{name}-calibration" if given.calibration else name
        made = assets(name, count, CALIBRATION if given.calibration else SEED)
        made = [asset for k, asset in enumerate(made, 1) if not given.only or k in given.only]
        given.out.mkdir(parents=True, exist_ok=True)
        write(given.out, stem, _decompose_all(made, cache_folder() if given.cache else None))
        if given.picture:
            look(read(given.out, stem), given.picture / f"{stem}.png")


def _decompose_all(made: list[Asset], cache: Path | None) -> Iterator[tuple[Asset, Mapping[str, Decomposition]]]:
    """All at all settings, two at a time, in order; told as they come."""

    def work(asset: Asset) -> tuple[dict[str, Decomposition], float]:
        start = perf_counter()
        return {setting: decompose_asset(asset, setting, cache) for setting in SETTINGS}, perf_counter() - start

    with ThreadPoolExecutor(2) as pool:
        for asset, (found, seconds) in zip(made, pool.map(work, made), strict=True):
            print(_describe(asset, found, seconds), flush=True)
            yield asset, found


def _describe(asset: Asset, found: Mapping[str, Decomposition], seconds: float) -> str:
    parts = Counter(part.label for part in asset.parts)
    hulls = " ".join(f"{len(mesh.hulls):3}" for mesh in found.values())
    impure = " ".join(f"{sum(max(s.values()) < 0.9 for s in mesh.shares):2}" for mesh in found.values())
    told = ", ".join(f"{n} {label}" for label, n in parts.items())
    return f"{asset.name} {asset.kind:14} hulls {hulls}  impure {impure}  {seconds:4.1f} s  {asset.about} ({told})"


if __name__ == "__main__":
    main()
