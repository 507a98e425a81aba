"""The speed benchmark runs, and the answers that it compares agree; no time is asserted. The learning benchmark runs,
its draws are the same every time, and what it says is so; no time is asserted."""

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
from benchmark.report import Goal, Result, Table, as_text
from benchmark.speed.assets import multi_hull
from benchmark.speed.contact import one_mesh
from meshforge.language import size_of


def silent(_: str) -> None:
    """Takes no notice of progress."""


def test_all_contestants_find_the_same_contacts_on_the_bundled_tables() -> None:
    found = multi_hull(silent, 2, bundled_only=True)
    assert len(found) == 2
    for name, mesh in found.items():
        row = one_mesh(name, mesh, 1)
        assert row["contacts"] == len(mesh.contacts) > 10
        assert row["near"] >= row["contacts"]
        assert {who: differ for who, differ in row["differ"].items() if differ} == {}
        assert all(seconds > 0 for seconds in row["seconds"].values())


def test_apply_is_run_and_watched(tmp_path: Path) -> None:
    assert bench.main(["apply", "--quick", "--out", str(tmp_path)]) == 0
    data = json.loads((tmp_path / "speed-apply.json").read_text("utf-8"))
    (row,) = data["details"]
    assert row["outcomes"] == {"edited": 2}
    assert row["main"] > 10 * 2**20
    assert data["quick"] is True
    page = (tmp_path / "speed.md").read_text("utf-8")
    assert "A quick run" in page
    assert "OBJ, bundled tables" in page
    assert str(tmp_path.anchor + "tmp") not in page


@pytest.mark.long
def test_commands_run_beside_the_script_by_hand(tmp_path: Path) -> None:
    assert bench.main(["commands", "--quick", "--out", str(tmp_path)]) == 0
    data = json.loads((tmp_path / "speed-commands.json").read_text("utf-8"))
    names = [row[0].split(",")[0] for row in data["tables"][0]["rows"]]
    assert names[0] == "the script by hand"
    assert {"apply", "check", "status", "synthesize", "label", "info", "render", "mf.load"} == set(names[1:])
    assert len(data["goals"]) == len(names) - 1


def test_a_part_that_is_not_there_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stopped:
        bench.main(["contacts"])
    assert stopped.value.code == 2
    assert "there is no part 'contacts'" in capsys.readouterr().err


def test_a_page_says_what_was_reached_and_what_not() -> None:
    goals = (Goal("quick", "at least", 10.0, 12.5), Goal("small", "at most", 2.0, 2.5))
    text = as_text(
        Result("x", "A part", (Table("Times", ("", "ms"), (("a|b", 1234.5), ("c", 0.01234))),), goals, ("so",))
    )
    assert "| quick  | at least 10 | 12.5     | reached         |" in text
    assert "| small  | at most 2   | 2.5      | **not reached** |" in text
    assert "| a/b | 1,234  |" in text or "| a/b | 1,234" in text
    assert "0.0123" in text
    assert text.endswith("- so\n")


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
