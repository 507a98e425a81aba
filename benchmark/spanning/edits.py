"""Whether the reference program does on meshes with hulls that span parts, as they are and rebuilt; and how many hulls
there are then."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import asdict

from benchmark.assets import SEPARATE, samples
from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.spanning.course import Edit, FamilyOutcome, HullChance, judge_families
from benchmark.spanning.detection import ABOUT_LABELS, categories_of, hulls_of, sets_of
from benchmark.spanning.family import BY_PIECES, LABELLED

TO_REACH = {"union": 0.9, "welded": 0.8}
"""Share of edits that meet the criterion."""
SHARES = (
    "set",
    "labels",
    "category",
    "edits",
    "meet the criterion before",
    "rebuilt",
)
FAILURES = ("set", "labels", "task", "what fails on rebuilt meshes", "edits")
SIZES = ("set", "category", "hulls", "rebuilt", "next finer", "its hulls", "ratio")

CountHulls = Callable[[str, str, Collection[str]], int]
"""How many hulls some assets of a category have where each solid is decomposed by itself, in a setting."""


def measure(tell: Tell, quick: bool) -> Result:
    """Edit all meshes that have hulls which span parts that the task is about."""
    families = judge_families(tell, quick)
    return Result(
        "edits",
        "Hulls that span parts: edits",
        (
            Table("Edits of the reference, labels by the surface", SHARES, tuple(list_shares(families))),
            Table("What fails on rebuilt meshes", FAILURES, tuple(list_failures(families))),
            Table("Hulls in all, all assets that nobody labelled", SIZES, tuple(list_sizes(families, count_generated))),
        ),
        tuple(
            Goal(f"{name}: edits that meet the criterion on rebuilt meshes", "at least", wanted, share_right(found))
            for name, wanted in TO_REACH.items()
            if (found := edits_of(families, name, BY_PIECES))
        ),
        _NOTES,
        tuple({"set": one.setting, "labels": one.labelled, **asdict(row)} for one in families for row in one.edits),
    )


def edits_of(families: Sequence[FamilyOutcome], setting: str, labelled: str, category: str | None = None) -> list[Edit]:
    """The edits of a set, by default of all categories."""
    return [
        edit
        for one in families
        if (one.setting, one.labelled) == (setting, labelled) and category in (None, one.category)
        for edit in one.edits
    ]


def share_right(rows: Sequence[Edit]) -> float:
    """The share of edits that meet the criterion on rebuilt meshes."""
    return sum(row.rebuilt is None for row in rows) / len(rows)


def list_shares(families: Sequence[FamilyOutcome]) -> Iterator[tuple[Cell, ...]]:
    """Rows of `SHARES`."""
    for setting in sets_of(families):
        for labelled in LABELLED:
            for category in (*categories_of(families), None):
                rows = edits_of(families, setting, labelled, category)
                if rows:
                    before = sum(row.before is None for row in rows) / len(rows)
                    yield setting, labelled, category or "all", len(rows), before, share_right(rows)


def list_failures(families: Sequence[FamilyOutcome]) -> Iterator[tuple[Cell, ...]]:
    """Rows of `FAILURES`."""
    for setting in sets_of(families):
        rows = edits_of(families, setting, BY_PIECES)
        rebuilt = Counter((row.task, row.rebuilt.split(":")[0]) for row in rows if row.rebuilt)
        for (task, what), count in sorted(rebuilt.items()):
            yield setting, BY_PIECES, task, what, count


def list_sizes(families: Sequence[FamilyOutcome], count: CountHulls) -> Iterator[tuple[Cell, ...]]:
    """Rows of `SIZES`, by the labels of pieces."""
    for setting in sets_of(families):
        total = [0, 0, 0]
        for category in categories_of(families):
            rows = hulls_of(families, setting, BY_PIECES, category)
            name, finer = next_finer(category, len(rows), {row.asset for row in rows}, count)
            rebuilt = _count_rebuilt(families, setting, category, rows)
            total = [a + b for a, b in zip(total, (len(rows), rebuilt, finer), strict=True)]
            yield setting, category, len(rows), rebuilt, name, finer, rebuilt / finer
        yield setting, "all", *total[:2], "–", total[2], total[1] / max(total[2], 1)


def _count_rebuilt(families: Sequence[FamilyOutcome], setting: str, category: str, rows: Sequence[HullChance]) -> int:
    """The hulls of a set where assets are rebuilt of which a hull likely spans parts."""
    made: dict[str, int] = {}
    for one in families:
        if (one.setting, one.category, one.labelled) == (setting, category, BY_PIECES):
            made |= one.rebuilt
    return sum(made.values()) + sum(row.asset not in made for row in rows)


def next_finer(category: str, hulls: int, assets: set[str], count: CountHulls) -> tuple[str, int]:
    """The coarsest separate decomposition that has more hulls than there are, else the finest; and its hulls."""
    for setting in SEPARATE:
        finer = count(category, setting, assets)
        if finer > hulls:
            break
    return setting, finer


def count_generated(category: str, setting: str, assets: Collection[str]) -> int:
    """The hulls of some generated assets where each solid is decomposed by itself."""
    return sum(len(row.mesh.hulls) for row in samples(category, False, (setting,)) if row.asset.name in assets)


_NOTES = (
    "Counted is each task with each mesh that nobody labelled and that has a hull which spans parts that the rules of "
    "the task are about. Each hull has the label that has most of it in true parts; so what is tried is the geometry. "
    "*Rebuilt*: all hulls of an asset are made anew, part by part, by the labels that were inferred for its fine "
    "pieces, where a hull of it likely spans parts, as `prepare --rebuild-spanning` does.",
    "*Next finer*: of the three decompositions of the same assets solid by solid (coarse, medium, fine) the first that "
    "has more hulls than the set, category by category.",
    *(f"Labels, *{name}*: {told}." for name, told in ABOUT_LABELS.items()),
)
