"""What the contest comes to: how many finished, how long they took, and how many times as long as we did."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import exp, log
from statistics import mean, median

from benchmark.learning.contest import ALONE, CVC5, HAS_CVC5, PAPER, PAPER_REPAIR, READINGS, REPAIR
from benchmark.report import Cell, Goal, Table

_WANTED = 50.0  # times as fast as the paper's
_LIKE = ((PAPER, ALONE), (PAPER, READINGS), (PAPER_REPAIR, REPAIR), (CVC5, ALONE), (CVC5, READINGS))


@dataclass(frozen=True, slots=True)
class Row:
    """One problem: its group, what each contestant took [s] and the size of what it found."""

    group: str
    seconds: Mapping[str, float]
    sizes: Mapping[str, int | None]
    alarms: int

    def times(self, other: str, ours: str) -> float:
        """How many times as long as we another contestant took."""
        return self.seconds[other] / self.seconds[ours]


def contestants(rows: Sequence[Row]) -> Table:
    """Who finished, how often with as small an extractor, and how long it took."""
    columns = ("", "finished", "as small", "median, ms", "mean, ms", "slowest, ms")
    ratios = ("ratio, median", "geometric mean", "of the sums", "slower on")
    return Table(
        f"{len(rows)} problems; the ratio is to MeshForge's search and readings",
        columns + ratios,
        tuple(_contestant(name, rows) for name in rows[0].seconds),
    )


def _contestant(name: str, rows: Sequence[Row]) -> tuple[Cell, ...]:
    times = [1e3 * row.seconds[name] for row in rows]
    done = [row for row in rows if row.sizes[name]]
    small = sum(row.sizes[name] == row.sizes[READINGS] for row in done)
    ratios = [row.times(name, READINGS) for row in rows]
    sums = mean(times) / mean(1e3 * row.seconds[READINGS] for row in rows)
    slower = sum(ratio > 1 for ratio in ratios) if name not in (ALONE, READINGS, REPAIR) else ""
    spread = (median(times), mean(times), max(times))
    return (name, len(done), small, *spread, median(ratios), geometric(ratios), sums, slower)


def geometric(ratios: Sequence[float]) -> float:
    """The geometric mean."""
    return exp(mean(map(log, ratios)))


def by_size(rows: Sequence[Row]) -> Table:
    """How long it takes with the size of what is to be found."""
    found = sorted({size for row in rows if (size := row.sizes[READINGS])})
    few = {nodes: [row for row in rows if row.sizes[READINGS] == nodes] for nodes in found}
    lines = tuple(
        (n, len(some), *(1e3 * median(r.seconds[who] for r in some) for who in some[0].seconds))
        for n, some in few.items()
    )
    return Table(
        "By the size of the smallest extractor: median, ms; the limit where the time was out",
        ("nodes", "problems", *rows[0].seconds),
        lines,
    )


def by_group(rows: Sequence[Row]) -> Table:
    """The same ratios, like work against like work, for each kind of problem."""
    groups = [*Counter(row.group for row in rows), ""]
    lines: list[tuple[Cell, ...]] = []
    for them, us in _LIKE if HAS_CVC5 else _LIKE[:-2]:
        cells = [geometric([row.times(them, us) for row in rows if group in (row.group, "")]) for group in groups]
        lines.append((f"{them} / {us}", *cells))
    return Table("Times as long, geometric mean", ("", *groups[:-1], "all"), tuple(lines))


def contest_goals(rows: Sequence[Row]) -> Iterator[Goal]:
    """Against the paper's strategy and cvc5."""
    for them, us, what in (
        (PAPER, ALONE, "search alone, against the paper's without repair"),
        (PAPER, READINGS, "search and readings, against the paper's without repair"),
        (PAPER_REPAIR, REPAIR, "everything, against the paper's with repair"),
    ):
        ratio = sum(row.seconds[them] for row in rows) / sum(row.seconds[us] for row in rows)
        yield Goal(f"times as fast on all problems together: {what}", "at least", _WANTED, ratio)
    done = [(row.sizes[READINGS], row.sizes[who]) for row in rows for who in (PAPER, PAPER_REPAIR) if row.sizes[who]]
    same = 100 * sum(ours == theirs for ours, theirs in done) / len(done)
    yield Goal("same smallest size as the paper's, where it finished, %", "at least", 100.0, same)
    if HAS_CVC5:
        slower = 100 * sum(row.times(CVC5, READINGS) > 1 for row in rows) / len(rows)
        yield Goal("problems on which cvc5 is slower than search and readings, %", "at least", 100.0, slower)
