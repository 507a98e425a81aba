"""The learning benchmark runs, its draws are the same every time, and what it says is so; no time is asserted."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from benchmark import __main__ as bench
from benchmark.learning.boxes import boxes
from benchmark.learning.cases import cases, learn
from benchmark.learning.contest import HAS_CVC5
from benchmark.learning.larger import SHOWN, LargerCases
from benchmark.learning.program_courses import teach_program
from benchmark.learning.programs import target_programs
from benchmark.learning.tables import read_tables, stretch_tables
from meshforge.language import size_of


@pytest.mark.long
def test_the_contest_runs_and_all_find_what_is_smallest(tmp_path: Path) -> None:
    assert bench.main(["search", "--quick", "--out", str(tmp_path)]) == 0
    data = json.loads((tmp_path / "learning-search.json").read_text("utf-8"))
    reached = {goal["what"]: goal["reached"] for goal in data["goals"]}
    assert reached["same smallest size as the paper's, where it finished, %"]
    assert {"cvc5" in row["seconds"] for row in data["details"]} == {HAS_CVC5}
    assert any("cvc5 is not installed" in note for note in data["notes"]) is not HAS_CVC5
    page = (tmp_path / "learning.md").read_text("utf-8")
    assert page.startswith("# Learning\n")
    assert "A quick run" in page
    assert "cvc5 " in page.split("Machine: ")[1].splitlines()[0]


def test_draws_are_the_same_every_time_and_longer_rows_begin_with_shorter_ones() -> None:
    one, other = (next(cases([100], 2, ("cup",))) for _ in range(2))
    assert one.shown == other.shown
    assert all(one.masks[k] for k in one.shown)
    assert boxes(1)[0].labels == boxes(2)[0].labels
    assert list(stretch_tables(16))[:14] == list(read_tables())


def test_larger_problems_need_all_their_nodes_and_are_the_same_every_time() -> None:
    first, again = (list(LargerCases(1, (5, 7), ("lamp",))) for _ in range(2))
    assert [problem.hidden for problem in first] == [problem.hidden for problem in again]
    assert [size_of(problem.hidden) for problem in first] == [5, 7]
    assert all(len(problem.shown) == SHOWN for problem in first)
    assert [learn(problem.search()).consistent.terms[0].size for problem in first] == [5, 7]


def test_a_program_is_taught_by_answers() -> None:
    (row,) = teach_program(target_programs(100, ("lamp",))[0], 100, 2)
    assert row.status == "found"
    assert (row.rules, row.refused) == (3, 0)
    assert row.wrong == 0.0
