"""RQ2 on loopback: the rows of the baselines are filled in, with cost; what was interrupted goes on."""

import json
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

from benchmark import __main__ as bench
from benchmark import journal
from benchmark.evaluation import comparison
from benchmark.evaluation.figures import fpr
from benchmark.study import FLAT, TRUE, Condition, Session
from benchmark.tasks import Task, task
from tests.loopback import Asked, Fault, serving, status
from tests.unit.benchmark.conftest import few
from tests.unit.benchmark.model_asking import block, cost, key, settings_file, tokens_in, tokens_out

__all__ = ["key"]
pytestmark = pytest.mark.usefixtures("key", "few_meshes", "small_pictures")
CUPS = [task("cup-easy"), task("cup-medium")]
FIELDS = Session("", "", 0).to_json().keys()


@pytest.fixture(autouse=True)
def few_sessions(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Sessions in which nobody was taught, since only what was shown counts here."""
    monkeypatch.setattr(journal, "JOURNALS", tmp_path / "journals")
    monkeypatch.setattr("benchmark.baselines.run.JOURNALS", tmp_path / "journals")
    monkeypatch.setattr(comparison, "find_python", lambda: None)

    def sessions(conditions: list[Condition], tell: object, quick: bool) -> list[Session]:
        return [session(one, condition) for one in CUPS for condition in conditions]

    monkeypatch.setattr(comparison, "sessions", sessions)


def session(one: Task, condition: Condition) -> Session:
    able = [name for name, selected in few(one.name).truth.reference.items() if selected is not None]
    begin = (TRUE, FLAT).index(condition) * 4
    return Session(
        one.name, condition.name, 100, "medium", shown=able[begin : begin + 2], judged=len(few(one.name).samples) - 2
    )


def asked_about(asked: Asked) -> Task:
    """The task whose steps are shown."""
    told = [one for one in CUPS if all(f"\n{k}. {r.action}:" in asked.text for k, r in enumerate(one.program.rules, 1))]
    return max(told, key=lambda one: len(one.program.rules))


def right(asked: Asked) -> str:
    return block(str(asked_about(asked).program))


def run(out: Path, *more: object) -> dict[str, Any]:
    assert bench.main(["comparison", "--quick", "--out", str(out), *map(str, more)]) == 0
    return dict(json.loads((out / "evaluation-comparison.json").read_text("utf-8")))


def functional(found: dict[str, Any]) -> dict[str, list[Any]]:
    """The rates of each row."""
    return {row[0]: row[2:] for row in found["tables"][0]["rows"]}


def judged(found: dict[str, Any]) -> list[Session]:
    return [Session.of_json({name: row[name] for name in FIELDS}) for row in found["details"]]


def test_without_a_model_nothing_is_run_and_said_so(tmp_path: Path) -> None:
    found = run(tmp_path)
    assert functional(found)["VLM Agent"] == functional(found)["VLM Blender"] == ["not run", "not run"]
    assert len(found["tables"]) == 1
    assert "VLM Agent was not run: no model was named." in found["notes"]
    assert any("--vlm FILE" in note for note in found["notes"])


def test_an_agent_that_is_right_passes_as_the_references_do_and_its_cost_is_told(tmp_path: Path) -> None:
    with serving(right) as server:
        settings = settings_file(server, tmp_path / "vlm.toml")
        found = run(tmp_path / "out", "--vlm", settings)
        asked = list(server.answered)
        again = run(tmp_path / "again", "--vlm", settings)
        assert server.answered == asked
    assert {part: again[part] for part in ("tables", "details")} == {
        part: found[part] for part in ("tables", "details")
    }
    filled, true = functional(found), [row for row in judged(found) if row.condition == TRUE.name]
    assert filled["VLM Blender"] == ["not run", "not run"]
    assert Counter((row.task, row.condition) for row in judged(found)) == Counter(
        (one.name, condition.name) for one in CUPS for condition in (TRUE, FLAT)
    )
    assert all(row.right for row in true)
    assert min(map(fpr, true)) > 0.8
    assert filled["VLM Agent"][0].startswith(f"{sum(map(fpr, true)) / len(true):.2f} ± ")
    asking = [row["asking"] for row in found["details"]]
    assert sum(row["rounds"] for row in asking) == len(asked)
    assert [row["rounds"] for row, log in zip(asking, judged(found), strict=True) if log in true] == [1, 1]
    made = tokens_out(*map(right, asked))
    assert (sum(row["input"] for row in asking), sum(row["output"] for row in asking)) == (tokens_in(server), made)
    assert sum(row["cost"] for row in asking) == pytest.approx(cost(tokens_in(server), made))
    table = found["tables"][1]
    cells = [dict(zip(table["columns"], row, strict=True)) for row in table["rows"]]
    assert [(row[""], row["condition"], row["SSR"]) for row in cells] == [
        ("VLM Agent", TRUE.name, "2/2"),
        ("VLM Agent", FLAT.name, cells[1]["SSR"]),
    ]
    assert (cells[0]["sessions"], cells[0]["do as was shown, %"], cells[0]["rounds"]) == (2, 100, 1)
    assert sum(row["$ in all"] for row in cells) == pytest.approx(cost(tokens_in(server), made))


def test_what_is_not_finished_is_said_to_be_and_goes_on_where_it_was(tmp_path: Path) -> None:
    def fault(asked: Asked) -> Fault | None:
        return None if asked.is_probe or asked_about(asked).name == "cup-easy" else status(500)

    with serving(right, fault=fault) as server:
        settings = settings_file(server, tmp_path / "vlm.toml", "concurrency = 1\n")
        found = run(tmp_path / "out", "--vlm", settings)
        assert functional(found)["VLM Agent"] == ["not finished"] * 2
        assert any("VLM Agent is not finished: 2 sessions are missing. " in note for note in found["notes"])
        assert found["details"] == []
        before = len(server.answered)
        server.fault = lambda asked: None
        found = run(tmp_path / "out", "--vlm", settings)
        assert functional(found)["VLM Agent"][0] > "0.8"
        assert all(asked_about(asked).name != "cup-easy" for asked in server.answered[before:])
