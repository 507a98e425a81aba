"""`meshforge review`, `status --signed-off` and `apply --min-confidence`. Held assets are listed by reason: one line
for all that are held for the same."""

import json
from pathlib import Path
from typing import cast

import pytest

from meshforge.common import format_share
from meshforge.project import Project, ProjectReview, format_review
from meshforge.signoff import THRESHOLD, Assessment, Reason, ResultStatus
from tests.unit.cli.in_process import Run, runner
from tests.unit.project.racks import BLOCK, PLAIN, find_right, shown_racks
from tests.unit.project.tables import SECOND, THIRD, applied


@pytest.fixture
def run(run: Run, tmp_path: Path) -> Run:
    """Runs the command line beside a project of three edited tables, of which two are demonstrated."""
    applied(tmp_path)
    return run


def test_a_family_that_is_sure_is_signed_off(run: Run) -> None:
    told = run("review", "tables", "--min-confidence", "0.5")
    assert told.code == 0
    assert told.out.strip() == "3 of 3 are at least 50% sure, or were looked at."
    assert run("status", "tables", "--signed-off").code == 0


def test_what_is_held_is_named_with_a_question_and_a_picture(run: Run) -> None:
    told = run("review", "tables", "--min-confidence", "1")
    assert told.code == 1
    assert told.out.startswith("2 of 3 are at least 100% sure, or were looked at; look at this one:\n  " + THIRD)
    picture = next(line.split("picture: ")[1] for line in told.out.splitlines() if "picture: " in line)
    assert Path(picture).read_bytes()[:4] == b"\x89PNG"
    assert run("status", "tables", "--signed-off").code == 1


def test_json_has_the_contract_and_a_reply_signs_off(run: Run) -> None:
    found = json.loads(run("review", "tables", "--min-confidence", "1", "--json").out)
    assert found["signed_off"] == 2
    assert [one["asset"] for one in found["needs_review"]] == [THIRD]
    assert set(found["needs_review"][0]) == {"asset", "probability", "reasons"}
    question = found["question"]
    assert set(question) >= {"id", "kind", "seconds", "gain", "asset", "rule", "hulls", "choices", "pictures"}
    for _ in range(12):
        Path("said.json").write_text(json.dumps([{"id": question["id"], "choice": 0}]))
        told = run("review", "tables", "--min-confidence", "1", "--json", "--answers", "said.json")
        question = json.loads(told.out)["question"]
        if question is None:
            break
    assert told.code == 0
    assert json.loads(told.out)["needs_review"] == []


def test_a_reply_to_a_question_that_does_not_stand_is_named_and_skipped(run: Run) -> None:
    Path("said.json").write_text('[{"id": "group-of-old", "choice": 0}]')
    told = run("review", "tables", "--min-confidence", "0.5", "--answers", "said.json")
    assert told.code == 1
    assert "group-of-old: this question is not asked any more, so the reply is skipped" in told.err


def test_status_says_what_is_void_and_why(run: Run) -> None:
    run("review", "tables", "--min-confidence", "0.5")
    Project.open("tables").set_labels(THIRD, {"crumb": "leg"})
    told = run("status", "tables")
    assert f"{THIRD}: void, labels changed since it was signed off" in told.out
    found = json.loads(run("status", "tables", "--json").out)
    assert found["signed_off"] == 2
    assert [one["sign_off"] for one in found["assets"]] == ["signed off", "signed off", "void"]


def test_apply_writes_what_is_sure_and_names_what_is_held(run: Run) -> None:
    told = run("apply", "tables", "--min-confidence", "1", "--json")
    rows = [json.loads(line) for line in told.out.splitlines()]
    assert told.code == 1
    assert {row["asset"]: row["status"] for row in rows}[THIRD] == "needs review"
    held = next(row for row in rows if row["status"] == "needs review")
    assert 0 < held["probability"] < 1
    sure = {one.id: one.result_status.probability for one in Project.open("tables").status().assets}
    assert all(row["probability"] == pytest.approx(sure[row["asset"]], abs=1e-4) for row in rows)
    assert held["out"].endswith("model.obj")
    assert "needs review" in run("apply", "tables", "--min-confidence", "1").out
    assert run("apply", "tables", "--min-confidence", "0.5").code == 0


def test_a_program_alone_does_not_say_how_sure_it_is(run: Run) -> None:
    told = run("apply", "tables/program.mf", "assets", "--out", "out", "--min-confidence", "0.9")
    assert told.code == 2
    assert "--min-confidence needs a project" in told.err
    assert not Path("out").exists()


def test_a_wrong_result_is_held(run: Run) -> None:
    Project.open("tables").set_verdict(SECOND, "wrong")
    rows = [json.loads(line) for line in run("apply", "tables", "--min-confidence", "0.5", "--json").out.splitlines()]
    assert {row["asset"]: row["status"] for row in rows}[SECOND] == "needs review"


def test_outputs_in_another_folder_sign_nothing_off(run: Run) -> None:
    run("review", "tables", "--min-confidence", "0.5")
    Path("tables/signoffs.jsonl").unlink()
    assert run("apply", "tables", "--out", "elsewhere").code == 0
    assert not Path("tables/signoffs.jsonl").exists()
    assert run("apply", "tables").code == 0
    assert Path("tables/signoffs.jsonl").exists()


def test_info_says_how_sure_an_edit_is_while_that_holds(run: Run) -> None:
    run("review", "tables", "--min-confidence", "0.5")
    assert json.loads(run("info", THIRD, "--project", "tables", "--json").out)["probability"] > 0.5
    Project.open("tables").set_labels(THIRD, {"crumb": "leg"})
    assert json.loads(run("info", THIRD, "--project", "tables", "--json").out)["probability"] is None


def test_what_was_put_off_is_asked_again_on_request(run: Run) -> None:
    question = run("review", "tables", "--min-confidence", "1", "--json").json["question"]
    Path("said.json").write_text(json.dumps([{"id": question["id"], "later": True}]))
    told = run("review", "tables", "--min-confidence", "1", "--json", "--answers", "said.json")
    assert told.code == 1
    assert (told.json["question"] or {}).get("id") != question["id"]
    assert (
        run("review", "tables", "--min-confidence", "1", "--json", "--again").json["question"]["id"] == question["id"]
    )


@pytest.fixture
def racks(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> Run:
    """Runs the command line beside a project of which one result becomes a solid block; nothing is written yet."""
    monkeypatch.chdir(tmp_path)
    shown_racks(tmp_path)
    return runner(monkeypatch, capsys)


@pytest.mark.slow
def test_a_result_that_would_be_a_block_is_held_though_nothing_was_written_before(racks: Run) -> None:
    find_right(Project.open("racks"), PLAIN[2])
    assert f"{BLOCK} (49%): nearly one solid block" in racks("review", "racks").out
    told = racks("apply", "racks", "--min-confidence", str(THRESHOLD), "--workers", "1")
    assert told.code == 1
    assert f"needs review {BLOCK}: 49% sure; nearly one solid block" in told.out
    project = Project.open("racks")
    assert not (project.layout.edited / BLOCK).exists()
    assert set(project.sign_offs()) == set(PLAIN)


@pytest.mark.slow
def test_a_result_that_stands_out_in_a_run_is_not_signed_off_by_it(racks: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    find_right(Project.open("racks"), PLAIN[2])
    with monkeypatch.context() as earlier:
        earlier.setattr("meshforge.project.review.measure_results", lambda *_: {})  # as a version before did
        assert racks("review", "racks").code == 0
    assert f"1 result stands out: {BLOCK}" in racks("apply", "racks", "--workers", "1").out
    assert set(Project.open("racks").sign_offs()) == set(PLAIN)
    told = racks("status", "racks", "--signed-off")
    (block,) = (one.result_status for one in Project.open("racks").status().assets if one.id == BLOCK)
    assert block.probability is not None and block.probability >= THRESHOLD, "that is how sure the review was"
    assert told.code == 1 and f"{BLOCK} ({format_share(block.probability)}): nearly one solid block" in told.out


@pytest.mark.slow
def test_a_result_that_stands_out_is_held_at_any_bar(racks: Run) -> None:
    assert racks("review", "racks", "--min-confidence", "0.5").code == 1
    assert f"1 result stands out: {BLOCK}" in racks("apply", "racks", "--workers", "1").out
    assert BLOCK not in Project.open("racks").sign_offs()


def text_of(reasons: dict[str, tuple[float, str]], held: int = 12) -> list[str]:
    assets = {name: ResultStatus(p, (Reason("candidate", why),) if why else ()) for name, (p, why) in reasons.items()}

    class Found:
        assessment = Assessment(assets)

    return format_review(cast(ProjectReview, Found()), held).splitlines()[1:-1]


def test_assets_of_one_reason_share_a_line_with_the_range_of_their_probabilities() -> None:
    reasons = {f"t{k}": (0.9 + 0.004 * k, "outlier") for k in range(9)} | {"odd": (0.5, "a solid block")}
    assert text_of(reasons) == ["  odd (50%): a solid block", "  t0, t1, t2, t3, t4 and 4 more (90% to 93%): outlier"]


def test_the_order_is_that_of_the_least_probable_of_each_reason_and_what_is_not_listed_is_counted() -> None:
    reasons = {"a": (0.3, "x"), "b": (0.2, "y"), "c": (0.6, "x"), "d": (0.7, "z"), "e": (0.8, "z"), "f": (0.9, "")}
    assert text_of(reasons, held=2) == ["  b (20%): y", "  a, c (30% to 60%): x", "  and 3 more (all with --json)"]
    assert text_of(reasons)[-1] == "  f (90%)"
