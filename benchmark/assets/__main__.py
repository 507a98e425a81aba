"""Makes the frozen assets, or looks at some of them: `script/make-benchmark [CATEGORY ...]`."""

from __future__ import annotations

import argparse
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from time import perf_counter

from benchmark.assets.asset import Asset
from benchmark.assets.decomposition import SEPARATE, SETS, SETTINGS, Decomposition, decompose_asset, draw_decomposed
from benchmark.assets.generation import CALIBRATION, CATEGORIES, COUNT, SEED, Order, orders
from benchmark.assets.pictures import look
from benchmark.assets.storage import DATA, Sample, read, stem_of, write
from meshforge.geometry.decomposition.run import cache_folder

_CALIBRATING = {name: 9 if k < 3 else 8 for k, name in enumerate(CATEGORIES)}
"""Assets of each category in the calibration set: 67, of three separate meshes each, one less than 202."""


def main() -> None:
    """Make what is asked for."""
    parser = argparse.ArgumentParser(prog="script/make-benchmark", description=__doc__)
    parser.add_argument("categories", nargs="*", metavar="CATEGORY", help=f"of {', '.join(CATEGORIES)}; default: all")
    parser.add_argument("--calibration", action="store_true", help="the calibration set instead of the 1000 meshes")
    parser.add_argument(
        "--settings",
        nargs="+",
        choices=SETS,
        default=list(SETS),
        help="only these are made, the others kept as they are frozen; separate: coarse, medium and fine",
    )
    parser.add_argument("--count", type=int, help="only so many assets a category (then --out must be given)")
    parser.add_argument("--only", type=int, nargs="+", metavar="NUMBER", help="only these assets (likewise)")
    parser.add_argument("--out", type=Path, default=DATA, help="the folder to write to")
    parser.add_argument("--cache", action="store_true", help="use and keep decompositions in the usual cache")
    parser.add_argument("--picture", type=Path, help="a folder for a picture of each category and setting")
    given = parser.parse_args()
    if (given.count or given.only) and given.out == DATA:
        parser.error("with --count or --only say --out FOLDER: the frozen data are whole")
    settings = [setting for choice in given.settings for setting in SETS[choice]]
    if given.out == DATA and set(SEPARATE) <= set(settings):
        settings = list(SETTINGS)  # what is drawn anew is not what the other meshes are of
    for name in given.categories or CATEGORIES:
        count = given.count or (_CALIBRATING[name] if given.calibration else COUNT)
        stem = stem_of(name, given.calibration)
        made = orders(name, count, CALIBRATION if given.calibration else SEED)
        made = [order for order in made if not given.only or order.number in given.only]
        frozen = dict[str, list[Sample]]() if set(SEPARATE) <= set(settings) else read_frozen(stem)
        make = partial(make_asset, settings=settings, frozen=frozen, cache=cache_folder() if given.cache else None)
        given.out.mkdir(parents=True, exist_ok=True)
        write(given.out, stem, make_all(made, make))
        if given.picture:
            for setting in SETTINGS:
                rows = [row for row in read(given.out, stem) if row.setting == setting]
                look(rows, given.picture / f"{stem}-{setting}.png")


def make_asset(
    order: Order, settings: Sequence[str], frozen: Mapping[str, Sequence[Sample]], cache: Path | None
) -> tuple[Asset, dict[str, Decomposition]]:
    """An asset and its meshes by setting; frozen: meshes by asset, kept where no such setting is to be made."""
    kept = frozen.get(order.name, ())
    if not kept or set(SEPARATE) <= set(settings):
        asset, found = draw_decomposed(order, cache)
    else:
        asset, found = order.draw(kept[0].asset.attempt), {}
    if kept and kept[0].asset.attempt == asset.attempt:
        found |= {row.setting: row.decomposition for row in kept if row.setting not in settings}
    for setting in settings:
        if setting not in found:
            found[setting] = decompose_asset(asset, setting, cache)
    return asset, found


def read_frozen(stem: str) -> dict[str, list[Sample]]:
    """The frozen meshes of a category by asset; none where there is no file."""
    found = defaultdict[str, list[Sample]](list)
    for row in read(DATA, stem) if (DATA / f"{stem}.json").is_file() else ():
        found[row.asset.name].append(row)
    return found


def make_all(
    made: Sequence[Order], make: Callable[[Order], tuple[Asset, dict[str, Decomposition]]]
) -> Iterator[tuple[Asset, Mapping[str, Decomposition]]]:
    """All assets, two at a time, in order; told as they come."""

    def work(order: Order) -> tuple[Asset, dict[str, Decomposition], float]:
        start = perf_counter()
        return *make(order), perf_counter() - start

    with ThreadPoolExecutor(2) as pool:
        for asset, found, seconds in pool.map(work, made):
            print(_describe(asset, found, seconds), flush=True)
            yield asset, found


def _describe(asset: Asset, found: Mapping[str, Decomposition], seconds: float) -> str:
    parts = Counter(part.label for part in asset.parts)
    hulls = " ".join(f"{len(mesh.hulls):3}" for mesh in found.values())
    impure = " ".join(f"{sum(max(s.values()) < 0.9 for s in mesh.shares):2}" for mesh in found.values())
    again = f"  drawn again {asset.attempt} times" if asset.attempt else ""
    told = ", ".join(f"{n} {label}" for label, n in parts.items())
    return (
        f"{asset.name} {asset.kind:14} hulls {hulls}  impure {impure}  {seconds:4.1f} s  {asset.about} ({told}){again}"
    )


if __name__ == "__main__":
    main()
