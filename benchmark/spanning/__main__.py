"""Fits the weights of the probability that a hull spans parts (`fit`), or says which hulls of some categories are
missed or falsely found (`look CATEGORY ...`), on the calibration assets unless `--test` is given; real
families have none."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator

from benchmark.assets import CATEGORIES, MERGED
from benchmark.real.family import families
from benchmark.real.whole import REAL
from benchmark.spanning.course import SURE, SplitFamily, SplitHull, split_some
from benchmark.spanning.detection import Detection
from benchmark.spanning.fit import fit
from benchmark.spanning.splits import Purity


def main() -> None:
    """Do what is asked for."""
    known = (*CATEGORIES, *families())
    parser = argparse.ArgumentParser(prog="python -m benchmark.spanning", description=__doc__)
    parser.add_argument("what", choices=("fit", "look"))
    parser.add_argument(
        "categories", nargs="*", metavar="CATEGORY", help=f"of {', '.join(known)}; default: the first {len(CATEGORIES)}"
    )
    parser.add_argument("--test", action="store_true", help="look at the test assets, not at those to tune on")
    given = parser.parse_args()
    if unknown := [name for name in given.categories if name not in known]:
        parser.error(f"there is no category {unknown[0]}, only {', '.join(known)}")
    if not given.test and (real := [name for name in given.categories if name not in CATEGORIES]):
        parser.error(f"{real[0]} has no assets to tune on: give --test to look at it")
    if given.what == "fit":
        fit(_tell)
        return
    for name in given.categories or CATEGORIES:
        sets = MERGED if name in CATEGORIES else (REAL,)
        for family in split_some([name], _tell, not given.test, sets):
            for line in describe_family(family):
                print(line)


def describe_family(family: SplitFamily) -> Iterator[str]:
    """How many hulls are found and how pure they are then, the hulls that are missed or falsely found, and the edits
    that fail."""
    found, purity = Detection.of(family.hulls), Purity.of([row for row in family.hulls if row.spans])
    yield (
        f"{family.category}, {family.setting}, labels of {family.labelled}: {found.spanning} of {found.hulls} span, "
        f"precision {found.precision:.2f}, recall {found.recall:.2f}, purity {purity.before:.2f} to {purity.after:.2f}"
    )
    for row in family.hulls:
        if row.spans != (row.chance >= SURE[0]):
            yield f"    {'missed' if row.spans else 'falsely found'}: {_describe_hull(row)}"
    before, split, truly, rebuilt = (
        sum(getattr(row, what) is None for row in family.edits) for what in ("before", "split", "truly", "rebuilt")
    )
    told = f"{split} after the split, {truly} with true labels of pieces, {rebuilt} on rebuilt meshes"
    yield f"    of {len(family.edits)} edits {before} do before, {told} ({sum(family.rebuilt.values())} hulls)"
    for edit in family.edits:
        for what, why in (("split", edit.split), ("rebuilt", edit.rebuilt)):
            if why:
                yield f"    {edit.task} {edit.mesh} {what}: {why.splitlines()[0]}"


def _describe_hull(row: SplitHull) -> str:
    total = sum(row.volumes.values()) or 1.0
    ordered = sorted(row.volumes.items(), key=lambda pair: -pair[1])
    told = ", ".join(f"{label} {volume / total:.0%}" for label, volume in ordered if volume > 0.005 * total)
    return f"{row.asset} hull {row.number}, {row.chance:.0%}: {told or 'in no part'}"


def _tell(line: str) -> None:
    print(line, file=sys.stderr)


if __name__ == "__main__":
    main()
