"""How many times as long a contestant took: who was stopped never flatters us, and like is compared with like."""

import pytest

from benchmark.learning.contest import ALONE, CVC5, LIMIT, PAPER, PAPER_REPAIR, READINGS, REPAIR
from benchmark.learning.ratios import Quantity, Row, geometric_mean, median_of, most_of
from benchmark.learning.search_tables import contest_goals, contest_tables
from benchmark.report import Table

OURS = (ALONE, READINGS, REPAIR)
NAMES = (*OURS, PAPER, PAPER_REPAIR, CVC5)


def row(size: int, ours: float = 0.01, paper: float = 1.0, repair: float = 2.0, stopped: tuple[str, ...] = ()) -> Row:
    """A problem on which our three take as long as each other, in proportion 1, 2, 4."""
    seconds = dict(zip(NAMES, (ours, 2 * ours, 4 * ours, paper, repair, 0.5), strict=True))
    return Row("all", seconds, {name: None if name in stopped else size for name in NAMES})


def cells(tables: tuple[Table, ...], title: str, nodes: object) -> dict[str, object]:
    (table,) = (table for table in tables if title in table.title)
    (line,) = (line for line in table.rows if line[0] == nodes)
    return dict(zip(table.columns, line, strict=True))


def goals(rows: list[Row]) -> dict[str, float]:
    return {goal.what: goal.measured for goal in reversed(list(contest_goals(rows)))}  # of equal names the first


def test_a_time_out_never_enters_a_geometric_mean() -> None:
    assert geometric_mean([Quantity(2.0), Quantity(8.0), Quantity(1000.0, stopped=True)]) == pytest.approx(4.0)
    assert geometric_mean([Quantity(1000.0, stopped=True)]) is None
    finished, stopped = row(5), row(5, paper=LIMIT, repair=LIMIT, stopped=(PAPER, PAPER_REPAIR))
    title, pair = "geometric mean", f"{PAPER} / {ALONE}"
    alone = cells(contest_tables([finished]), title, "all")[pair]
    assert alone == pytest.approx(100.0)
    assert cells(contest_tables([finished, stopped]), title, "all")[pair] == "100 (1 left out)"
    assert cells(contest_tables([stopped]), title, "all")[pair] == "– (all 1 left out)"


def test_a_median_with_a_time_out_is_marked_where_the_true_one_may_be_larger() -> None:
    few = [Quantity(1.0), Quantity(2.0)]
    assert median_of([*few, Quantity(9.0, stopped=True)]) == Quantity(2.0)
    assert median_of([*few, Quantity(1.5, stopped=True)]) == Quantity(1.5, stopped=True)
    assert median_of([Quantity(1.0), Quantity(3.0, stopped=True)]) == Quantity(2.0, stopped=True)
    assert median_of([Quantity(0.5, stopped=True), *few]).stopped
    assert most_of([*few, Quantity(1.5, stopped=True)]) == Quantity(2.0, stopped=True)
    assert Quantity(0.25, stopped=True).cell(1e3) == "at least 250"


def test_goals_are_by_size_and_no_slow_problem_makes_up_for_others() -> None:
    small, large = [row(1, paper=0.001)] * 9, [row(5, paper=0.2), row(5, paper=0.2), row(9, paper=50.0)]
    found = goals([*small, *large])
    assert found["search and readings of a rule, slowest, ms"] == pytest.approx(20.0)
    what = "times as fast from 5 nodes on, median: search and readings, against the paper's without repair"
    assert found[what] == pytest.approx(10.0)
    assert found["the same, at the size where this median is least"] == pytest.approx(10.0)
    assert not any("together" in name for name in found)
