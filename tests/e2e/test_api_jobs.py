"""Long work, as a page begins, watches and stops it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from meshforge.formats import load
from meshforge.project import Project
from tests.e2e.studio import Studio, ok, opened
from tests.mesh_files import ROOM
from tests.studio_project import FEW, demo_project
from tests.unit.batch.families import tree

FIRST, THIRD = "table_01.obj", "table_03.obj"


@pytest.fixture
def studio(tmp_path: Path) -> Iterator[Studio]:
    """Demonstrated tables, learned; exports may go to `given`."""
    project = demo_project(tmp_path, tables=FEW)
    with opened(tmp_path, project.folder, "--export", str(tmp_path / "given")) as found:
        found.settled()
        yield found


def test_apply_review_and_export_and_what_is_told_of_it(studio: Studio) -> None:
    job = studio.run_job(kind="apply", assets=[FIRST, THIRD])
    assert (job["state"], job["done"], job["total"]) == ("done", 2, 2)
    assert {line["status"] for line in job["lines"]} == {"edited"}
    cards = studio.cards(lambda cards: cards[FIRST]["output"] == cards[THIRD]["output"] == "edited")
    assert cards["table_02.obj"]["output"] == "none"
    written = load(studio.folder / "edited" / FIRST)
    words = [word["name"] for word in studio.settled()["project"]["vocabulary"]]
    assert [words[k] for k in cards[FIRST]["after_labels"]] == [hull.label for hull in written.hulls]
    assert cards["table_02.obj"]["after_labels"] == []
    picture = studio.get("/api/thumbnail", asset=FIRST, of="output", v=cards[FIRST]["edited_picture"])
    assert picture.content.startswith(b"\x89PNG")
    assert studio.get("/api/result", asset=FIRST, of="output").status_code == 200
    studio.edit("review", ids=[FIRST], verdict="wrong")
    studio.edit("review", ids=[THIRD], verdict="accepted")
    studio.cards(lambda cards: cards[THIRD]["review"] == "accepted" and cards[FIRST]["review"] == "wrong")
    job = studio.run_job(kind="export", folder="out/first")
    assert job["message"] == "1 asset exported, with meshforge-report.html."
    exported = studio.folder / "out" / "first"
    assert job["out"] == str(exported)
    outputs = tree(studio.folder / "edited")
    own = {name: data for name, data in tree(exported).items() if not name.startswith(".")}
    report = own.pop("meshforge-report.html").decode()
    assert all(asset in report for asset in (FIRST, THIRD)), "those that are wrong, too"
    assert own and own == {name: outputs[name] for name in own}
    assert load(exported / THIRD).hulls
    assert studio.run_job(kind="export", folder="out/first", signed_only=False)["message"].startswith("2 assets ")
    assert (exported / FIRST).is_file()
    assert studio.run_job(kind="export", folder="out/first")["message"].startswith("1 asset ")
    assert not (exported / FIRST).exists()


def test_exports_go_where_they_may_and_harm_nobody(studio: Studio, tmp_path: Path) -> None:
    studio.run_job(kind="apply", assets=[FIRST])
    studio.cards(lambda cards: cards[FIRST]["output"] == "edited")
    given = tmp_path / "given"
    request = {"kind": "export", "signed_only": False}
    for folder in ("..", str(tmp_path / "elsewhere"), ".", "edited", "labels/x", ".meshforge/x", "../assets"):
        answer = studio.post("/api/jobs", request | {"folder": folder})
        assert answer.status_code == 400, folder
    (studio.folder / "link").symlink_to(tmp_path / "assets")
    assert studio.post("/api/jobs", request | {"folder": "link"}).status_code == 400
    assert studio.run_job(**request, folder=str(given))["state"] == "done"
    assert load(given / FIRST).hulls
    (studio.folder / "mine").mkdir()
    (studio.folder / "mine" / "thesis.txt").write_text("do not lose me")
    refused = studio.post("/api/jobs", request | {"folder": "mine"})
    assert "holds something else" in refused.json()["message"]
    (given / "table_03.obj").write_text("mine")
    studio.run_job(kind="apply", assets=[THIRD])
    job = studio.run_job(**request, folder=str(given))
    assert [line["status"] for line in job["lines"]] == ["failed", "done"] + ["skipped"] * (len(FEW) - 2)
    assert (given / "table_03.obj").read_text() == "mine"


def test_a_job_that_is_cancelled_stops_and_leaves_whole_outputs(studio: Studio) -> None:
    with studio.page() as page:
        assert page.hello
        job = ok(studio.post("/api/jobs", {"kind": "apply"}))["id"]
        assert studio.post("/api/jobs", {"kind": "apply"}).status_code == 400
        page.until(lambda e: e["kind"] == "job" and (e["job"]["done"] or e["job"]["state"] != "running"))
        cancelled = studio.post("/api/jobs/cancel", {"id": job})
        if cancelled.status_code == 200:
            assert page.job(job)["state"] in ("cancelled", "done")
    assert studio.post("/api/jobs/cancel", {"id": job}).status_code == 404
    names = {name for name in tree(studio.folder / "edited") if name.endswith(".obj")}
    studio.cards(lambda cards: names == {asset for asset, card in cards.items() if card["output"] == "edited"})
    assert all(load(studio.folder / "edited" / name).hulls for name in names)
    assert studio.run_job(kind="apply")["state"] == "done"


def test_what_is_sure_is_signed_off_once_written_and_undo_of_a_question_put_off_keeps_that(studio: Studio) -> None:
    hello = studio.until(lambda hello: hello["assessment"] is not None and not hello["assessing"])
    question = hello["assessment"]["question"]
    project = Project.open(studio.folder)
    waits = [one.id for one in project.status().assets if one.result_status.state == "sure"]
    assert waits and not project.sign_offs()
    studio.edit("reply", question=question, later=True)
    assert studio.run_job(kind="apply")["state"] == "done"
    assert set(waits) <= set(project.sign_offs())
    ok(studio.post("/api/undo"))
    assert project.feedback().snoozed == () and set(waits) <= set(project.sign_offs())
    studio.until(lambda hello: hello["assessment"] is not None and not hello["assessing"])
    assert {one.result_status.state for one in project.status().assets if one.id in waits} == {"signed off"}


def test_what_was_decomposed_is_undone_with_one_step(studio: Studio, tmp_path: Path) -> None:
    for name in ("room_a.obj", "room_b.obj"):
        studio.put("/api/assets", ROOM.encode(), path=name)
    added = ok(studio.post("/api/assets"))["names"]
    assert added == ["added/room_a.obj", "added/room_b.obj"]
    studio.cards(lambda cards: [cards[name]["hulls"] for name in added] == [0, 0])
    before = tree(studio.folder / "prepared")
    job = studio.run_job(kind="decompose", assets=added, method="vhacd")
    assert job["state"] == "done", job
    assert {line["status"] for line in job["lines"]} == {"done"}
    studio.cards(lambda cards: all(cards[name]["hulls"] and cards[name]["prepared"] for name in added))
    ok(studio.post("/api/undo"))
    assert tree(studio.folder / "prepared") == before
    ok(studio.post("/api/undo"))
    assert not [card for card in studio.settled()["cards"] if card["asset"].startswith("added/")]
    assert not (studio.folder / "added" / "room_b.obj").exists()
    ok(studio.post("/api/redo"))
    assert (studio.folder / "added" / "room_b.obj").read_text() == ROOM
    assert not (tmp_path / "assets" / "added").exists()
