"""Hulls that span parts of real assets, each decomposed as a whole: found, rebuilt, and edited."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from benchmark.assets import SEPARATE
from benchmark.journal import run_units
from benchmark.real.family import families as list_families
from benchmark.real.family import family
from benchmark.real.samples import make_sample
from benchmark.real.tasks import tasks_of
from benchmark.real.whole import REAL, THRESHOLD, list_hidden, list_whole
from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.spanning.course import SURE, FamilyOutcome, judge_some
from benchmark.spanning.detection import (
    ABOUT_LABELS,
    BY_PROBABILITY,
    CALIBRATIONS,
    COUNTS,
    Detection,
    hulls_of,
    list_by_probability,
    list_calibrations,
    list_counted,
    list_counts,
)
from benchmark.spanning.edits import (
    FAILURES,
    SHARES,
    SIZES,
    edits_of,
    list_failures,
    list_shares,
    list_sizes,
    share_right,
)
from benchmark.spanning.family import BY_PIECES, KNOWN
from benchmark.speed.assets import corpus
from meshforge.common import AssetError, join_names

PRECISION, RECALL, RIGHT = 0.9, 0.8, 0.8
"""To reach: of hulls that span found, and the share of edits that do on rebuilt meshes."""
_QUICK = "cups"
_FINE = SEPARATE[-1]


def measure(tell: Tell, quick: bool) -> Result:
    """Find the hulls that span in all real families, and rebuild assets. Raises AssetError: no corpus is here."""
    if corpus() is None:
        raise AssetError("not run: no corpus is here", where="real_assets", remedy="Set MESHFORGE_CORPUS to it.")
    names = [_QUICK] if quick else list_families()
    families = judge_some(names, tell, sets=(REAL,))
    separate = open_separate(names, tell)
    sizes = tuple(list_sizes(families, separate.count))
    return Result(
        "real_assets",
        "Real assets: hulls that span parts",
        (
            Table(f"Real assets: found at a probability of at least {SURE}", COUNTS, tuple(list_counts(families))),
            Table(
                "Real assets: found from other probabilities on, labels of pieces",
                BY_PROBABILITY,
                tuple(list_by_probability(families)),
            ),
            Table("What the probabilities are worth", CALIBRATIONS, tuple(list_calibrations(families))),
            Table("Edits of the reference", (*SHARES, f"the {_FINE} set"), tuple(_list_shares(families, separate))),
            Table("What fails on rebuilt meshes", FAILURES, tuple(list_failures(families))),
            Table("Hulls in all, all assets that nobody labelled", SIZES, sizes),
        ),
        tuple(_list_goals(families)),
        (*_NOTES, *_list_absent(names)),
        tuple(list_counted(families)),
    )


@dataclass(frozen=True)
class SeparateMeshes:
    """The assets of some families where each connected solid is decomposed by itself.

    hulls: how many there are, by family, asset and setting; reasons: why the reference program fails on the fine ones,
    by task and asset, None where it does not.
    """

    hulls: Mapping[tuple[str, str, str], int]
    reasons: Mapping[tuple[str, str], str | None]

    def count(self, name: str, setting: str, assets: Collection[str]) -> int:
        """The hulls of some assets of a family in a setting."""
        return sum(self.hulls[name, asset, setting] for asset in assets)


def open_separate(names: Sequence[str], tell: Tell) -> SeparateMeshes:
    """The assets of some families, made where they are not in the cache."""
    units = [(name, asset) for name in names for asset in list_whole(name)]
    rows = [
        (*unit, row) for unit, row in zip(units, run_units("spanning-fine", judge_separate, units, tell), strict=True)
    ]
    hulls = {(name, asset, at): count for name, asset, row in rows for at, count in row["hulls"].items()}
    return SeparateMeshes(hulls, {(task, asset): why for _, asset, row in rows for task, why in row["fine"]})


def judge_separate(name: str, asset: str) -> dict[str, Any]:
    """The hulls of an asset by setting, and each task of its family with why the reference fails on the fine ones."""
    made = {setting: make_sample(family(name), asset, setting) for setting in SEPARATE}
    sample = made[_FINE]
    assert sample
    fine = [(task.name, task.failure(sample, task.run(task.program, sample.mesh))) for task in tasks_of(name)]
    return {"hulls": {setting: len(one.mesh.hulls) for setting, one in made.items() if one}, "fine": fine}


def _list_shares(families: Sequence[FamilyOutcome], separate: SeparateMeshes) -> Iterator[tuple[Cell, ...]]:
    for row in list_shares(families):
        category = None if row[2] == "all" else str(row[2])
        edits = edits_of(families, str(row[0]), str(row[1]), category)
        right = sum(separate.reasons[edit.task, edit.mesh.removesuffix(f"_{REAL}")] is None for edit in edits)
        yield *row, right / len(edits)


def _list_goals(families: Sequence[FamilyOutcome]) -> Iterator[Goal]:
    found = Detection.of(hulls_of(families, REAL, BY_PIECES))
    yield Goal("real: hulls that span found, precision", "at least", PRECISION, found.precision)
    yield Goal("real: hulls that span found, recall", "at least", RECALL, found.recall)
    if edits := edits_of(families, REAL, BY_PIECES):
        yield Goal("real: edits that meet the criterion on rebuilt meshes", "at least", RIGHT, share_right(edits))


def _list_absent(names: Sequence[str]) -> Iterator[str]:
    absent = [f"{asset} of {name}" for name in names for asset in list_hidden(name)]
    if absent:
        yield f"Left out, as the corpus has its collision geometry alone: {join_names(absent)}."


_NOTES = (
    f"The families of `benchmark/real`. Each asset is decomposed by one call of CoACD at a threshold of {THRESHOLD}, "
    "on all that its file shows, whatever the body: on the union of its solids, or, where a piece of the surface is "
    "not watertight, on all of it remeshed by voxels. The hulls are of one body. The surface by which hulls are found "
    "and rebuilt is what the file shows, as it comes, with its open, doubled and overlapping pieces.",
    "True parts are solids made of the regions of the surface that were labelled by hand from pictures.",
    f"{KNOWN} assets of a family are labelled, one of each third, drawn with a fixed seed; families have 8 to 14. "
    "Nothing is tuned on these assets.",
    f"*The {_FINE} set*: the same tasks on the same assets where each solid is decomposed by itself, finely. The "
    "reference fails there too where that merges parts. *Next finer*: of the three such sets (coarse, medium, "
    "fine) the first that has more hulls than the set, family by family.",
    *(f"Labels, *{name}*: {told}." for name, told in ABOUT_LABELS.items()),
)
