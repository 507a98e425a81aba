"""What splitting the hulls that span gives: how pure their parts are, which pure hulls are split, how many hulls there
are then."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass

from benchmark.assets import MERGED, SEPARATE, samples
from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.spanning.course import SURE, SplitFamily, SplitHull, split_families
from benchmark.spanning.detection import ABOUT_LABELS, categories_of, hulls_of, sets_of
from benchmark.spanning.family import BY_PIECES, NO_SURFACE, WAYS

TO_REACH = {"union": 0.97, "welded": 0.9}
"""Purity to reach, by the surface."""
TO_REACH_WITHOUT = 0.85
"""The same of hulls that stand for no surface."""
MOST_SPLIT, _MOST_SPLIT_WITHOUT = 0.01, 0.02
"""The share of the pure hulls that may be split, with a surface and without."""
PURITIES = (
    "set",
    "labels",
    "category",
    "spanning",
    "purity before",
    "after",
    "after, mean of hulls",
    "labels right",
    "volume kept",
    "pure hulls split",
)
SIZES = ("set", "category", "hulls", "rebuilt", "after the split", "next finer", "its hulls", "ratio")

CountHulls = Callable[[str, str, Collection[str]], int]
"""How many hulls some assets of a category have where each solid is decomposed by itself, in a setting."""


@dataclass(frozen=True, slots=True)
class Purity:
    """Of some hulls, weighted by their volume in parts. before, after: the share in the label that a hull, or a part of
    it, has most of; mean: that after as a mean over hulls; right: the share of what is in parts of split hulls that
    has its own label; kept: of what of the hulls was in parts, what still is."""

    before: float
    after: float
    mean: float
    right: float
    kept: float

    @staticmethod
    def of(rows: Sequence[SplitHull], sure: float = SURE[0]) -> Purity:
        """The purity where hulls are split from a probability on; hulls that are not split count as they are."""
        rows = [row for row in rows if sum(row.volumes.values()) > 0]
        parts = [row.parts_at(sure) for row in rows]
        before = [(max(row.volumes.values()), sum(row.volumes.values())) for row in rows]
        after = [(sum(_most(one) for one in some), sum(sum(one.values()) for one in some)) for some in parts]
        split = [part for row in rows if row.is_split(sure) for part in row.parts]
        right = sum(part.volumes.get(part.label, 0.0) for part in split)
        told = sum(sum(part.volumes.values()) for part in split)
        return Purity(
            _ratio(before),
            _ratio(after),
            sum(most / total for most, total in after if total) / len(after) if after else 1.0,
            _ratio([(right, told)]),
            _ratio([(b, a) for (_, b), (_, a) in zip(after, before, strict=True)]),
        )


def measure(tell: Tell, quick: bool) -> Result:
    """Split the hulls that span in all families."""
    families = split_families(tell, quick)
    counts = tuple(list_sizes(families, count_generated))
    return Result(
        "splits",
        "Hulls that span parts: split",
        (
            *(
                Table(f"Split from a probability of {sure} on", PURITIES, tuple(list_purities(families, sure)))
                for sure in SURE
            ),
            Table("Hulls in all, all assets that nobody labelled", SIZES, counts),
        ),
        tuple(_list_goals(families, counts)),
        _NOTES,
        tuple(list_gains(families)),
    )


def _most(volumes: dict[str, float]) -> float:
    return max(volumes.values(), default=0.0)


def _ratio(pairs: Sequence[tuple[float, float]]) -> float:
    total = sum(whole for _, whole in pairs)
    return sum(part for part, _ in pairs) / total if total else 1.0


def purity_of(
    families: Sequence[SplitFamily], setting: str, labelled: str, category: str | None = None, sure: float = SURE[0]
) -> Purity:
    """The purity of the spanning hulls of a set; of all categories that have such hulls the mean, since some are much
    larger than others."""
    names = [category] if category else categories_of(families)
    spanning = [[row for row in hulls_of(families, setting, labelled, name) if row.spans] for name in names]
    found = [Purity.of(rows, sure) for rows in spanning if rows] or [Purity.of([])]

    def mean(values: Iterator[float]) -> float:
        return sum(values) / len(found)

    return Purity(
        mean(one.before for one in found),
        mean(one.after for one in found),
        mean(one.mean for one in found),
        mean(one.right for one in found),
        mean(one.kept for one in found),
    )


def share_of_pure_split(
    families: Sequence[SplitFamily], setting: str, labelled: str, category: str | None = None, sure: float = SURE[0]
) -> float:
    """The share of the hulls that do not span which are split."""
    pure = [row for row in hulls_of(families, setting, labelled, category) if not row.spans]
    return sum(row.is_split(sure) for row in pure) / max(len(pure), 1)


def list_purities(families: Sequence[SplitFamily], sure: float) -> Iterator[tuple[Cell, ...]]:
    """Rows of `PURITIES`: hulls are split from a probability on."""
    for setting in sets_of(families):
        for labelled in WAYS:
            for category in (*categories_of(families), None):
                spanning = sum(row.spans for row in hulls_of(families, setting, labelled, category))
                found = purity_of(families, setting, labelled, category, sure)
                cells = found.before, found.after, found.mean, found.right, found.kept
                split = share_of_pure_split(families, setting, labelled, category, sure)
                yield setting, labelled, category or "all", spanning, *cells, split


def list_sizes(families: Sequence[SplitFamily], count: CountHulls) -> Iterator[tuple[Cell, ...]]:
    """Rows of `SIZES`, by the labels of pieces."""
    for setting in sets_of(families):
        total = [0, 0, 0, 0]
        for category in categories_of(families):
            rows = hulls_of(families, setting, BY_PIECES, category)
            after = sum(len(row.parts_at()) for row in rows)
            name, finer = next_finer(category, len(rows), {row.asset for row in rows}, count)
            rebuilt = _count_rebuilt(families, setting, category, rows)
            total = [a + b for a, b in zip(total, (len(rows), rebuilt, after, finer), strict=True)]
            yield setting, category, len(rows), rebuilt, after, name, finer, after / finer
        yield setting, "all", *total[:3], "–", total[3], total[2] / max(total[3], 1)


def _count_rebuilt(families: Sequence[SplitFamily], setting: str, category: str, rows: Sequence[SplitHull]) -> int:
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


def _list_goals(families: Sequence[SplitFamily], counts: Sequence[tuple[Cell, ...]]) -> Iterator[Goal]:
    for setting, wanted in TO_REACH.items():
        after = purity_of(families, setting, BY_PIECES).after
        split = share_of_pure_split(families, setting, BY_PIECES)
        ratio = next(float(row[-1]) for row in counts if row[:2] == (setting, "all"))
        yield Goal(f"{setting}: purity of spanning hulls after the split", "at least", wanted, after)
        yield Goal(f"{setting}: share of the pure hulls that is split", "at most", MOST_SPLIT, split)
        yield Goal(f"{setting}: hulls afterwards as a ratio to the next finer decomposition", "at most", 1.0, ratio)
    for setting in MERGED:
        after = purity_of(families, setting, NO_SURFACE).after
        split = share_of_pure_split(families, setting, NO_SURFACE, sure=SURE[1])
        name = f"{setting}, no surface"
        yield Goal(f"{name}: purity of spanning hulls after the split", "at least", TO_REACH_WITHOUT, after)
        yield Goal(f"{name}: share of the pure hulls split from {SURE[1]} on", "at most", _MOST_SPLIT_WITHOUT, split)


def list_gains(families: Sequence[SplitFamily]) -> Iterator[dict[str, Cell]]:
    """The assets that have spanning hulls, with the purity of these."""
    for one in families:
        for asset in dict.fromkeys(hull.asset for hull in one.hulls if hull.spans):
            found = Purity.of([hull for hull in one.hulls if hull.asset == asset and hull.spans])
            names = {"category": one.category, "set": one.setting, "labels": one.labelled, "asset": asset}
            yield {**names, "before": round(found.before, 4), "after": round(found.after, 4)}


_NOTES = (
    "*Purity*: the share of what of the hulls is in parts that is in the label which its hull, or its part of a hull, "
    "has most of, by volume; hulls that span and are not split count as they are. *All*: the mean of the categories, "
    "since some have far larger assets. *Labels right*: of what is in parts of split hulls, the share that has got its "
    "true label. *Volume kept*: of what of the hulls was in true parts, the share that still is after the split.",
    "*Next finer*: of the three decompositions of the same assets solid by solid (coarse, medium, fine) the first that "
    "has more hulls than the set, category by category.",
    *(f"Labels, *{name}*: {told}." for name, told in ABOUT_LABELS.items()),
)
