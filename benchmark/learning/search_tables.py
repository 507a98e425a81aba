"""What the contest comes to by the size of the extractor: how long each took, and how many times as long as we did."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence

from benchmark.learning.contest import ALONE, CVC5, HAS_CVC5, PAPER, PAPER_REPAIR, READINGS, REPAIR
from benchmark.learning.ratios import Quantity, Row, geometric_mean, median_of, most_of
from benchmark.report import Cell, Goal, Table, format_cell

PAIRS = ((PAPER, ALONE), (PAPER, READINGS), (PAPER_REPAIR, REPAIR), (CVC5, ALONE), (CVC5, READINGS))
"""Who is compared with whom: without label repair with without it, with it with it.

*Search alone* does what the paper's and cvc5 do; *search and readings* does more than they.
"""
LARGE = 5
"""From so many nodes on, speed is promised."""
_SLOWEST, _FASTER = 25.0, 20.0  # ms a rule; times as fast as the paper's


def contest_tables(rows: Sequence[Row]) -> tuple[Table, ...]:
    """Who finished; times and ratios by the size of the smallest extractor; and which kind of problem has which."""
    pairs = PAIRS if HAS_CVC5 else PAIRS[:-2]
    return (
        _contestants(rows),
        _times(rows),
        _ratios("median of the ratios", rows, pairs, lambda found: median_of(found).cell()),
        _ratios("geometric mean of the ratios, without problems at the limit", rows, pairs, _mean_cell),
        _kinds(rows),
    )


def _contestants(rows: Sequence[Row]) -> Table:
    columns = ("", "finished", "as small", "median, ms", "slowest, ms")
    lines = tuple(_contestant(name, rows) for name in rows[0].seconds)
    return Table(f"{len(rows)} problems", columns, lines)


def _contestant(name: str, rows: Sequence[Row]) -> tuple[Cell, ...]:
    done = [row for row in rows if row.sizes[name]]
    small = sum(row.sizes[name] == row.sizes[READINGS] for row in done)
    times = [row.time(name) for row in rows]
    return (name, len(done), small, median_of(times).cell(1e3), most_of(times).cell(1e3))


def _times(rows: Sequence[Row]) -> Table:
    names = tuple(rows[0].seconds)
    lines = tuple(
        (nodes, len(few), *(median_of(row.time(name) for row in few).cell(1e3) for name in names))
        for nodes, few in _by_size(rows).items()
    )
    return Table("By the nodes of the smallest extractor: median, ms", ("nodes", "problems", *names), lines)


def _ratios(
    title: str,
    rows: Sequence[Row],
    pairs: Sequence[tuple[str, str]],
    summarize: Callable[[Sequence[Quantity]], Cell],
) -> Table:
    parts: list[tuple[Cell, Sequence[Row]]] = [*_by_size(rows).items(), ("all", rows)]
    if large := _large(rows):
        parts.insert(-1, (f"{LARGE} and more", large))
    lines = tuple(
        (name, len(few), *(summarize([row.ratio(*pair) for row in few]) for pair in pairs)) for name, few in parts
    )
    return Table(f"Times as long: {title}", ("nodes", "problems", *(f"{a} / {b}" for a, b in pairs)), lines)


def _mean_cell(ratios: Sequence[Quantity]) -> Cell:
    value, stopped = geometric_mean(ratios), sum(ratio.stopped for ratio in ratios)
    if value is None:
        return f"– (all {stopped} left out)"
    return f"{format_cell(value)} ({stopped} left out)" if stopped else value


def _kinds(rows: Sequence[Row]) -> Table:
    sizes = tuple(_by_size(rows))
    counts = Counter((row.group, row.sizes[READINGS]) for row in rows)
    groups = dict.fromkeys(row.group for row in rows)
    lines: list[tuple[Cell, ...]] = [(group, *(counts[group, size] for size in sizes)) for group in groups]
    return Table("Problems by the nodes of the smallest extractor", ("", *map(str, sizes)), tuple(lines))


def _by_size(rows: Sequence[Row]) -> dict[int, list[Row]]:
    found: dict[int, list[Row]] = {}
    for row in sorted(rows, key=_size):
        found.setdefault(_size(row), []).append(row)
    return found


def _size(row: Row) -> int:
    size = row.sizes[READINGS]
    assert size, "search and readings are never stopped"
    return size


def _large(rows: Sequence[Row]) -> list[Row]:
    return [row for row in rows if _size(row) >= LARGE]


def contest_goals(rows: Sequence[Row]) -> Iterator[Goal]:
    """How slow a rule may be, whatever its size; and against the paper's strategy and cvc5."""
    slowest = 1e3 * max(row.seconds[READINGS] for row in rows)
    yield Goal("search and readings of a rule, slowest, ms", "at most", _SLOWEST, slowest)
    large = _large(rows)
    for them, us, what in (
        (PAPER, READINGS, "search and readings, against the paper's without repair"),
        (PAPER_REPAIR, REPAIR, "everything with repair, against the paper's with repair"),
    ):
        if large:
            ratio = median_of(row.ratio(them, us) for row in large)
            yield _faster(f"times as fast from {LARGE} nodes on, median: {what}", ratio)
            medians = [median_of(row.ratio(them, us) for row in few) for few in _by_size(large).values()]
            yield _faster("the same, at the size where this median is least", min(medians, key=lambda one: one.value))
    done = [(row.sizes[READINGS], row.sizes[who]) for row in rows for who in (PAPER, PAPER_REPAIR) if row.sizes[who]]
    if done:
        same = 100 * sum(ours == theirs for ours, theirs in done) / len(done)
        yield Goal("same smallest size as the paper's, where it finished, %", "at least", 100.0, same)
    if HAS_CVC5:
        slower = sum(row.ratio(CVC5, READINGS).value <= 1 for row in rows)
        yield Goal("problems on which search and readings is slower than cvc5", "at most", 0.0, slower)


def _faster(what: str, ratio: Quantity) -> Goal:
    return Goal(what + " (a lower bound)" * ratio.stopped, "at least", _FASTER, ratio.value)


def describe_contest(limit: float) -> Iterator[str]:
    """Notes: what each contestant does, who is compared with whom, and how a contestant that was stopped counts."""
    yield (
        "*Search alone*: the smallest extractor on the demonstrated meshes, which is all that the paper's strategy and "
        "cvc5 look for. *Search and readings*: every extractor up to four nodes larger, told apart on all meshes, with "
        "beliefs; the paper's strategy and cvc5 have nothing like it, so its ratios compare more work of ours with "
        "less of theirs. *Repair on*: wrong labels are looked for too, by ours and by the paper's; where the paper's "
        "asks about a label, the answer is no, since all are right."
    )
    yield (
        "A ratio is what the other took, divided by what MeshForge took on the same problem: without repair against "
        "without, with repair against with. No times of different problems are added up, as the first edition of this "
        "page did: a single problem at the limit decided its ratios."
    )
    yield (
        f"Who takes longer than {limit:g} s is stopped; MeshForge never is. What the paper's strategy does not finish "
        "without repair, it does not finish with it, so that is not tried. A stopped contestant counts as having taken "
        f"{limit:g} s in medians, which stay right as lower bounds: *at least* marks them. A geometric mean leaves "
        "such problems out, and their number stands beside it; as these are the ones on which the other is slowest, "
        "the mean is too low rather than too high."
    )
    if HAS_CVC5:
        yield "cvc5 runs in a process of its own, started and told the problem beforehand; its times are of one run."
    else:
        yield "cvc5 is not installed, so it is left out."
