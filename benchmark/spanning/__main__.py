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
from benchmark.spanning.course import SURE, FamilyOutcome, judge_some
from benchmark.spanning.detection import Detection
from benchmark.spanning.fit import fit


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
        for family in judge_some([name], _tell, not given.test, sets):
            for line in describe_family(family):
                print(line)


def describe_family(family: FamilyOutcome) -> Iterator[str]:
    """How many hulls are found, the hulls that are missed or falsely found, and the edits
    that fail."""
    found = Detection.of(family.hulls)
    yield (
        f"{family.category}, {family.setting}, labels of {family.labelled}: {found.spanning} of {found.hulls} span, "
        f"precision {found.precision:.2f}, recall {found.recall:.2f}"
    )
    for row in family.hulls:
        if row.spans != (row.chance >= SURE):
            yield f"    {'missed' if row.spans else 'falsely found'}: {row.asset} hull {row.number}, {row.chance:.0%}"
    before, rebuilt = (sum(getattr(row, what) is None for row in family.edits) for what in ("before", "rebuilt"))
    hulls = sum(family.rebuilt.values())
    yield f"    of {len(family.edits)} edits {before} do before, {rebuilt} on rebuilt meshes ({hulls} hulls)"
    for edit in family.edits:
        if edit.rebuilt:
            yield f"    {edit.task} {edit.mesh} rebuilt: {edit.rebuilt.splitlines()[0]}"


def _tell(line: str) -> None:
    print(line, file=sys.stderr)


if __name__ == "__main__":
    main()
