"""How many of the hulls that span parts are found, and how far the probabilities can be believed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.signoff.calibration import calibrate
from benchmark.spanning.course import SURE, FamilyOutcome, HullChance, judge_families
from benchmark.spanning.family import BY_HULLS, BY_PIECES, KNOWN, LABELLED

TO_REACH = {"union": (0.95, 0.95), "welded": (0.95, 0.85)}
"""Precision and recall to reach, by the surface."""
ABOUT_LABELS = {
    BY_PIECES: f"a person labelled the fine pieces of {KNOWN} assets, and those of their hulls that are of one part",
    BY_HULLS: f"a person labelled the hulls of {KNOWN} assets alone, those that span by what they have most of",
}
"""What each kind of labels is."""
PROBABILITIES = (0.5, 0.6, 0.7, 0.8, 0.85, 0.9, 0.95)
"""From which on hulls are counted as found, in the table that compares these."""
COUNTS = ("set", "labels", "category", "hulls", "spanning", "found", "precision", "recall")
BY_PROBABILITY = ("set", "probability", "found", "precision", "recall", "share of the pure hulls")
CALIBRATIONS = ("set", "labels", "calibration error", "Brier score", "of the share alone", "area under the ROC curve")


@dataclass(frozen=True, slots=True)
class Detection:
    """Counts of hulls: all, those that span, those said to, and those rightly said to."""

    hulls: int
    spanning: int
    found: int
    right: int

    @staticmethod
    def of(rows: Sequence[HullChance], sure: float = SURE) -> Detection:
        """The counts where hulls are said to span from a probability on."""
        found = [row for row in rows if row.chance >= sure]
        return Detection(len(rows), sum(row.spans for row in rows), len(found), sum(row.spans for row in found))

    @property
    def precision(self) -> float:
        """The share of those said to span that do; 1 where none is."""
        return self.right / self.found if self.found else 1.0

    @property
    def recall(self) -> float:
        """The share of those that span that is found; 1 where none does."""
        return self.right / self.spanning if self.spanning else 1.0


def measure(tell: Tell, quick: bool) -> Result:
    """Find the hulls that span in all families."""
    families = judge_families(tell, quick)
    return Result(
        "detection",
        "Hulls that span parts: found",
        (
            Table(f"Found at a probability of at least {SURE}", COUNTS, tuple(list_counts(families))),
            Table(
                "Found from other probabilities on, labels of pieces",
                BY_PROBABILITY,
                tuple(list_by_probability(families)),
            ),
            Table("What the probabilities are worth", CALIBRATIONS, tuple(list_calibrations(families))),
        ),
        tuple(_list_goals(families)),
        NOTES,
        tuple(list_counted(families)),
    )


def list_by_probability(families: Sequence[FamilyOutcome]) -> Iterator[tuple[Cell, ...]]:
    """Rows of `BY_PROBABILITY`."""
    for setting in sets_of(families):
        rows = hulls_of(families, setting, BY_PIECES)
        for sure in PROBABILITIES if rows else ():
            one = Detection.of(rows, sure)
            pure = (one.found - one.right) / max(one.hulls - one.spanning, 1)
            yield setting, sure, one.found, one.precision, one.recall, pure


def hulls_of(
    families: Sequence[FamilyOutcome], setting: str, labelled: str, category: str | None = None
) -> list[HullChance]:
    """The hulls of a set, by default of all categories."""
    return [
        hull
        for one in families
        if (one.setting, one.labelled) == (setting, labelled) and category in (None, one.category)
        for hull in one.hulls
    ]


def categories_of(families: Sequence[FamilyOutcome]) -> list[str]:
    """The categories that there are families of, in order."""
    return list(dict.fromkeys(one.category for one in families))


def sets_of(families: Sequence[FamilyOutcome]) -> list[str]:
    """The sets that there are families of, in order."""
    return list(dict.fromkeys(one.setting for one in families))


def list_counts(families: Sequence[FamilyOutcome]) -> Iterator[tuple[Cell, ...]]:
    """Rows of `COUNTS`."""
    for setting in sets_of(families):
        for labelled in LABELLED:
            for category in (*categories_of(families), None):
                found = Detection.of(hulls_of(families, setting, labelled, category))
                counts = found.hulls, found.spanning, found.found
                yield setting, labelled, category or "all", *counts, found.precision, found.recall


def list_calibrations(families: Sequence[FamilyOutcome]) -> Iterator[tuple[Cell, ...]]:
    """Rows of `CALIBRATIONS`."""
    for setting in sets_of(families):
        for labelled in LABELLED:
            found = calibrate([(row.chance, row.spans) for row in hulls_of(families, setting, labelled)])
            yield setting, labelled, found.error, found.brier, found.constant, found.order


def _list_goals(families: Sequence[FamilyOutcome]) -> Iterator[Goal]:
    for setting, (precision, recall) in TO_REACH.items():
        found = Detection.of(hulls_of(families, setting, BY_PIECES))
        yield Goal(f"{setting}: hulls that span found, precision", "at least", precision, found.precision)
        yield Goal(f"{setting}: hulls that span found, recall", "at least", recall, found.recall)


def list_counted(families: Sequence[FamilyOutcome]) -> Iterator[dict[str, Cell]]:
    """What was found of each asset."""
    for one in families:
        for asset in dict.fromkeys(hull.asset for hull in one.hulls):
            found = Detection.of([hull for hull in one.hulls if hull.asset == asset])
            yield {
                "set": one.setting,
                "labels": one.labelled,
                "asset": asset,
                "hulls": found.hulls,
                "spanning": found.spanning,
                "found": found.found,
                "right": found.right,
            }


NOTES = (
    "*Union*: one call of CoACD on the union of an asset's parts; *welded*: likewise, its joints welded shut before. A "
    "family is all 25 assets of a category in one set; counted are the hulls of those that nobody labelled. A hull "
    "spans parts if no label has nine tenths of what of it is in parts. The surface is what CoACD was called on.",
    *(f"Labels, *{name}*: {told}. All else is propagated." for name, told in ABOUT_LABELS.items()),
    f"The {KNOWN} assets are one of each third of a family, drawn with a fixed seed. Goals are about *{BY_PIECES}*.",
    "Each other asset is compared with these alone. A hull is found, too, that alone stands for a whole solid of "
    "another label, as that of a seat and a leg; where that is less than a tenth, it counts as falsely found.",
)
