"""Whether the reference program does on meshes with hulls that span parts, before and after these are split, and on
rebuilt meshes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import asdict

from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.spanning.course import Edit, SplitFamily, split_families
from benchmark.spanning.detection import ABOUT_LABELS, categories_of, sets_of
from benchmark.spanning.family import BY_PIECES, LABELLED

TO_REACH = {"union": 0.9, "welded": 0.8}
"""Share of edits that meet the criterion."""
SHARES = (
    "set",
    "labels",
    "category",
    "edits",
    "meet the criterion before",
    "after the split",
    "after it by true labels of pieces",
    "rebuilt",
)
FAILURES = ("set", "labels", "task", "what fails on rebuilt meshes", "edits", "of these after the split")


def measure(tell: Tell, quick: bool) -> Result:
    """Edit all meshes that have hulls which span parts that the task is about."""
    families = split_families(tell, quick)
    return Result(
        "edits",
        "Hulls that span parts: edits",
        (
            Table("Edits of the reference, labels by the surface", SHARES, tuple(list_shares(families))),
            Table("What fails on rebuilt meshes", FAILURES, tuple(list_failures(families))),
        ),
        tuple(
            Goal(f"{name}: edits that meet the criterion {told}", "at least", wanted, share_right(found, what))
            for name, wanted in TO_REACH.items()
            if (found := edits_of(families, name, BY_PIECES))
            for what, told in (("split", "after the split"), ("rebuilt", "on rebuilt meshes"))
        ),
        _NOTES,
        tuple({"set": one.setting, "labels": one.labelled, **asdict(row)} for one in families for row in one.edits),
    )


def edits_of(families: Sequence[SplitFamily], setting: str, labelled: str, category: str | None = None) -> list[Edit]:
    """The edits of a set, by default of all categories."""
    return [
        edit
        for one in families
        if (one.setting, one.labelled) == (setting, labelled) and category in (None, one.category)
        for edit in one.edits
    ]


def share_right(rows: Sequence[Edit], what: str) -> float:
    """The share of edits that meet the criterion on meshes of a kind: a field of `Edit`."""
    return sum(getattr(row, what) is None for row in rows) / len(rows)


def list_shares(families: Sequence[SplitFamily]) -> Iterator[tuple[Cell, ...]]:
    """Rows of `SHARES`."""
    for setting in sets_of(families):
        for labelled in LABELLED:
            for category in (*categories_of(families), None):
                rows = edits_of(families, setting, labelled, category)
                if rows:
                    shares = (share_right(rows, what) for what in ("before", "split", "truly", "rebuilt"))
                    yield setting, labelled, category or "all", len(rows), *shares


def list_failures(families: Sequence[SplitFamily]) -> Iterator[tuple[Cell, ...]]:
    """Rows of `FAILURES`."""
    for setting in sets_of(families):
        rows = edits_of(families, setting, BY_PIECES)
        rebuilt = Counter((row.task, row.rebuilt.split(":")[0]) for row in rows if row.rebuilt)
        both = Counter((row.task, row.rebuilt.split(":")[0]) for row in rows if row.rebuilt and row.split)
        for (task, what), count in sorted(rebuilt.items()):
            yield setting, BY_PIECES, task, what, count, both[task, what]


_NOTES = (
    "Counted is each task with each mesh that nobody labelled and that has a hull which spans parts that the rules of "
    "the task are about. Each hull, and each part of one that is split, has the label that has most of it in true "
    "parts; so what is tried is the geometry of the split, and what was found to be split. *True labels of pieces*: "
    "all hulls that span, and no other, are split by the true labels of the fine pieces. *Rebuilt*: all hulls of an "
    "asset are made anew, part by part, by the labels that were inferred for its fine pieces, where a hull of it "
    "likely spans parts, as `prepare --rebuild-spanning` does.",
    *(f"Labels, *{name}*: {told}." for name, told in ABOUT_LABELS.items()),
)
