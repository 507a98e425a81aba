"""Hulls that span parts of real assets, each decomposed as a whole: found, split, and edited."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from benchmark.assets import SEPARATE
from benchmark.journal import run_units
from benchmark.real.family import families as list_families
from benchmark.real.family import family
from benchmark.real.samples import make_sample
from benchmark.real.tasks import tasks_of
from benchmark.real.whole import REAL, THRESHOLD, list_hidden, list_whole
from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.spanning.course import SURE, SplitFamily, split_some
from benchmark.spanning.detection import (
    ABOUT_LABELS,
    CALIBRATIONS,
    COUNTS,
    Detection,
    hulls_of,
    list_calibrations,
    list_counts,
)
from benchmark.spanning.edits import FAILURES, SHARES, edits_of, list_failures, list_shares, share_right
from benchmark.spanning.family import BY_PIECES, KNOWN
from benchmark.spanning.splits import MOST_SPLIT, PURITIES, list_gains, list_purities, purity_of, share_of_pure_split
from benchmark.speed.assets import corpus
from meshforge.common import AssetError, join_names

PRECISION, RECALL, PURITY, RIGHT = 0.9, 0.8, 0.88, 0.8
"""To reach: of hulls that span found, purity of these after the split, and the share of edits that do then."""
_QUICK = "cups"
_FINE = SEPARATE[-1]
Reasons = Mapping[tuple[str, str], str | None]
"""Why the reference program fails with a task on an asset; None: it does not."""


def measure(tell: Tell, quick: bool) -> Result:
    """Find and split the hulls that span in all real families. Raises AssetError where the corpus is not here."""
    if corpus() is None:
        raise AssetError("not run: no corpus is here", where="real_assets", remedy="Set MESHFORGE_CORPUS to it.")
    names = [_QUICK] if quick else list_families()
    families = split_some(names, tell, sets=(REAL,))
    fine = judge_finely(names, tell)
    return Result(
        "real_assets",
        "Real assets: hulls that span parts",
        (
            Table(f"Real assets: found at a probability of at least {SURE[0]}", COUNTS, tuple(list_counts(families))),
            Table("What the probabilities are worth", CALIBRATIONS, tuple(list_calibrations(families))),
            *(
                Table(
                    f"Real assets: split from a probability of {sure} on",
                    PURITIES,
                    tuple(list_purities(families, sure)),
                )
                for sure in SURE
            ),
            Table("Edits of the reference", (*SHARES, f"the {_FINE} set"), tuple(_list_shares(families, fine))),
            Table("What fails on rebuilt meshes", FAILURES, tuple(list_failures(families))),
        ),
        tuple(_list_goals(families)),
        (*_NOTES, *_list_absent(names)),
        tuple(list_gains(families)),
    )


def judge_finely(names: Sequence[str], tell: Tell) -> Reasons:
    """How the reference program fares on the assets of some families where each solid is decomposed by itself."""
    units = [(name, asset) for name in names for asset in list_whole(name)]
    found = run_units("spanning-fine", judge_fine_asset, units, tell)
    return {(task, asset): why for (_, asset), rows in zip(units, found, strict=True) for task, why in rows}


def judge_fine_asset(name: str, asset: str) -> list[tuple[str, str | None]]:
    """Each task of a family, and why the reference program fails with it on an asset."""
    sample = make_sample(family(name), asset, _FINE)
    assert sample
    return [(task.name, task.failure(sample, task.run(task.program, sample.mesh))) for task in tasks_of(name)]


def _list_shares(families: Sequence[SplitFamily], fine: Reasons) -> Iterator[tuple[Cell, ...]]:
    for row in list_shares(families):
        category = None if row[2] == "all" else str(row[2])
        edits = edits_of(families, str(row[0]), str(row[1]), category)
        right = sum(fine[edit.task, edit.mesh.removesuffix(f"_{REAL}")] is None for edit in edits)
        yield *row, right / len(edits)


def _list_goals(families: Sequence[SplitFamily]) -> Iterator[Goal]:
    found = Detection.of(hulls_of(families, REAL, BY_PIECES))
    yield Goal("real: hulls that span found, precision", "at least", PRECISION, found.precision)
    yield Goal("real: hulls that span found, recall", "at least", RECALL, found.recall)
    after = purity_of(families, REAL, BY_PIECES).after
    yield Goal("real: purity of spanning hulls after the split", "at least", PURITY, after)
    split = share_of_pure_split(families, REAL, BY_PIECES)
    yield Goal("real: share of the pure hulls that is split", "at most", MOST_SPLIT, split)
    if edits := edits_of(families, REAL, BY_PIECES):
        for what, told in (("split", "after the split"), ("rebuilt", "on rebuilt meshes")):
            yield Goal(f"real: edits that meet the criterion {told}", "at least", RIGHT, share_right(edits, what))


def _list_absent(names: Sequence[str]) -> Iterator[str]:
    absent = [f"{asset} of {name}" for name in names for asset in list_hidden(name)]
    if absent:
        yield f"Left out, as the corpus has its collision geometry alone: {join_names(absent)}."


_NOTES = (
    f"The families of `benchmark/real`. Each asset is decomposed by one call of CoACD at a threshold of {THRESHOLD}, "
    "on all that its file shows, whatever the body: on the union of its solids, or, where a piece of the surface is "
    "not watertight, on all of it remeshed by voxels. The hulls are of one body. The surface by which hulls are found "
    "and split is what the file shows, as it comes, with its open, doubled and overlapping pieces.",
    "True parts are solids made of the regions of the surface that were labelled by hand from pictures; purity is by "
    "volume in these. *All*: the mean of the families that have spanning hulls.",
    f"{KNOWN} assets of a family are labelled, one of each third, drawn with a fixed seed; families have 8 to 14. "
    "Nothing is tuned on these assets.",
    f"*The {_FINE} set*: the same tasks on the same assets where each solid is decomposed by itself, finely. The "
    "reference fails there too where the file merges parts.",
    *(f"Labels, *{name}*: {told}." for name, told in ABOUT_LABELS.items()),
)
