"""The evaluation runs for one category and one seed; what was interrupted goes on, and the same comes out again."""

import json
from pathlib import Path
from typing import Any

import pytest

from benchmark import __main__ as bench
from benchmark import journal
from benchmark.evaluation import contest, effectiveness
from benchmark.evaluation.figures import share_solved_at
from benchmark.journal import run_units
from benchmark.study import FLAT, TRUE, Round, Session
from benchmark.study.condition import KIND, PROPAGATED

PARTS = ["ceiling", "calibration", "effectiveness", "comparison", "contest"]


@pytest.fixture
def journals(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(journal, "JOURNALS", tmp_path / "journals")
    return tmp_path / "journals"


def run(parts: list[str], out: Path) -> dict[str, Any]:
    assert bench.main([*parts, "--quick", "--out", str(out)]) == 0
    return {part: json.loads((out / f"evaluation-{part}.json").read_text("utf-8")) for part in parts}


def without_times(data: Any) -> Any:
    if isinstance(data, dict):
        return {key: without_times(value) for key, value in data.items() if key != "seconds"}
    return [without_times(value) for value in data] if isinstance(data, list) else data


@pytest.mark.long
@pytest.mark.usefixtures("few_meshes")
def test_a_quick_run_writes_page_and_pictures(journals: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(effectiveness, "_QUICK", (TRUE, FLAT, PROPAGATED[0], KIND))
    monkeypatch.setattr(contest, "SHOWN", (1, 3))  # of the few meshes there are
    found = run(PARTS, tmp_path / "out")
    page = (tmp_path / "out" / "README.md").read_text("utf-8")
    assert "A quick run: one category, one seed" in page
    for part, data in found.items():
        assert f"## {data['title']}" in page
        assert f"`script/bench {part}`" in page
    changes = page.split("## What was changed since the first edition")[1].split("##")[0]
    for figure in (
        "unedited assets that fail",
        "SSR, true labels, the first edition",
        "FPR, propagated from 3",
        "nodes on",
    ):
        (line,) = [line for line in changes.splitlines() if figure in line]
        assert line.count("|") == 5
        assert ("not run" in line) == (figure == "FPR, propagated from 3"), line
    assert "**Not run yet: `script/bench mutation real ablation correction scaling gallery`.**" in page
    assert {name.name for name in (tmp_path / "out" / "pictures").iterdir()} >= {"tasks.png", "effectiveness.svg"}
    sessions = found["effectiveness"]["details"]
    assert {row["task"] for row in sessions} == {"cup-easy", "cup-medium", "cup-hard"}
    assert {row["seed"] for row in sessions} == {100}
    ceiling = {goal["what"]: goal["reached"] for goal in found["ceiling"]["goals"]}
    assert all(ceiling.values()), ceiling


@pytest.mark.long
@pytest.mark.usefixtures("few_meshes")
def test_a_run_is_the_same_again_and_takes_what_is_in_the_journal(journals: Path, tmp_path: Path) -> None:
    first = run(["comparison"], tmp_path / "one")
    (kept,) = journals.glob("*-sessions.jsonl")
    lines = kept.read_text("utf-8").splitlines()
    kept.write_text("\n".join([*lines[:-1], lines[-1][: len(lines[-1]) // 2]]), "utf-8")  # killed while it wrote
    again = run(["comparison"], tmp_path / "two")
    assert again["comparison"]["tables"] == first["comparison"]["tables"]
    after = [json.loads(line) for line in kept.read_text("utf-8").splitlines() if line.endswith("]")]
    assert without_times(after[-1][1]) == without_times(json.loads(lines[-1])[1])


def doubled(number: int) -> int:
    return 2 * number


def test_units_come_in_order_and_are_worked_out_once(journals: Path) -> None:
    told: list[str] = []
    assert run_units("numbers", doubled, [(3,), (1,)], told.append) == [6, 2]
    assert len(told) == 2
    assert run_units("numbers", doubled, [(1,), (2,), (3,)], told.append) == [2, 4, 6]
    assert len(told) == 3


def test_results_depend_on_the_code_that_their_work_imports_and_on_no_other() -> None:
    sources = journal.list_sources("benchmark.evaluation.sessions")
    assert "benchmark/study/person.py" in sources
    assert "src/meshforge/synthesis/learn.py" in sources
    assert not [path for path in sources if path.startswith(("src/meshforge/studio", "benchmark/speed"))]
    assert "benchmark/evaluation/effectiveness.py" not in sources
    assert "benchmark/evaluation/effectiveness.py" in journal.list_sources("benchmark.evaluation.effectiveness")


def session(seed: int, ks: list[tuple[int, int, int]]) -> Session:
    rounds = [Round(demos, answers, differs, program="x") for demos, answers, differs in ks]
    return Session("cup-easy", "", seed, rounds=rounds, right=not rounds[-1].differs)


def test_a_task_is_solved_once_all_demonstrators_have_had_it_right() -> None:
    groups = {"cup-easy": [session(0, [(1, 0, 0)]), session(1, [(1, 0, 4), (1, 1, 2), (2, 1, 0)])]}
    assert [share_solved_at(groups, k) for k in (1, 2, 3)] == [0.0, 0.0, 1.0]
    lost = {
        "cup-easy": [session(0, [(1, 0, 0), (1, 1, 2)])],
        "cup-hard": [session(0, [(1, 0, 0), (2, 0, 3), (3, 0, 0)])],
    }
    assert [share_solved_at(lost, k) for k in (1, 2, 3)] == [0.0, 0.0, 0.5]
    groups["cup-hard"] = [session(0, [(1, 0, 1)])]
    assert share_solved_at(groups, 9) == 0.5
