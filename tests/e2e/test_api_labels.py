"""Labels propagated in the studio: a job that blocks nothing, is one step of the history, and loses no label."""

from __future__ import annotations

import json
import signal
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from meshforge.project import GIVEN, Project
from meshforge.symbolic import Label
from tests.e2e.legs import HULLS, LABELS, four_legged
from tests.e2e.studio import PATIENCE, Page, Studio, ok, opened
from tests.studio_project import demo_project
from tests.unit.batch.families import tree

FIRST, SECOND, THIRD = "t0.obj", "t1.obj", "t2.obj"


@pytest.fixture(scope="module")
def running(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    """Tables, the first of which is labelled by a person."""
    folder = tmp_path_factory.mktemp("labels")
    project = four_legged(folder)
    for name, label in LABELS.items():
        project.set_labels(FIRST, {name: label})
    with opened(folder, project.folder) as found:
        yield found


@pytest.fixture
def studio(running: Studio) -> Iterator[Studio]:
    yield running
    running.undo_all()


def labels(studio: Studio) -> dict[str, bytes]:
    return tree(studio.folder / "labels")


def kept(project: Project) -> dict[str, bytes]:
    return {name: text for name, text in tree(project.folder).items() if not name.startswith(".meshforge")}


def carry(studio: Studio, page: Page) -> dict[str, Any]:
    """Propagate labels; the job when it is over."""
    return page.job(ok(studio.post("/api/jobs", {"kind": "label"}))["id"])


def test_labels_are_carried_over_with_one_step(studio: Studio) -> None:
    before = labels(studio)
    assert "label all hulls" in studio.settled()["project"]["next"]["text"]
    with studio.page() as page:
        assert page.hello["project"]["propagation"] is None
        job = carry(studio, page)
        assert (job["state"], job["done"], job["total"]) == ("done", 4, 4)
        assert job["message"].startswith("15 labels on 3 assets; ")
        cards = studio.cards(lambda cards: all(-1 not in card["confidence"] for card in cards.values()))
        assert cards[FIRST]["confidence"] == [GIVEN] * 5
        others = [card["confidence"] for card in cards.values()][1:]
        assert all(top == GIVEN and min(legs) < 50 for top, *legs in others), "only tops have a name that says a label"
        hello = studio.until(lambda hello: hello["project"]["propagation"] is not None)
        assert hello["project"]["propagation"] == {"unused": 0, "next": hello["project"]["propagation"]["next"]}
        assert hello["project"]["propagation"]["next"] in (SECOND, THIRD, "t3.obj")
        after = labels(studio)
        assert ok(studio.post("/api/undo"))["message"] == "hulls labelled"
        assert labels(studio) == before
        ok(studio.post("/api/redo"))
        assert labels(studio) == after
        studio.edit("label", hulls={SECOND: ["leg_a"]}, label="first")
        assert studio.until(lambda hello: (hello["project"]["propagation"] or {}).get("unused") == 1)


def test_what_a_person_says_meanwhile_stays_and_is_not_blocked(studio: Studio) -> None:
    with studio.page() as page:
        assert page.hello
        job = ok(studio.post("/api/jobs", {"kind": "label"}))["id"]
        assert studio.post("/api/jobs", {"kind": "label"}).status_code == 400
        for name in HULLS:
            studio.edit("label", hulls={SECOND: [name]}, label="fourth")
        assert page.job(job)["state"] == "done"
    said = dict.fromkeys(HULLS, Label("fourth"))
    project = Project.open(studio.folder)
    assert dict(project.labels(SECOND).labels) == said
    assert _given(studio, SECOND) == len(HULLS)
    after = 0  # labels that came when all was carried over already
    while ok(studio.post("/api/undo"))["message"] != "hulls labelled":
        after += 1
    assert dict(project.labels(SECOND).labels) == dict(list(said.items())[: len(said) - after])
    assert not project.labels(THIRD).labels
    for _ in range(after + 1):
        ok(studio.post("/api/redo"))
    assert dict(project.labels(SECOND).labels) == said
    assert studio.until(lambda hello: (hello["project"]["propagation"] or {}).get("unused") == 5)


def _given(studio: Studio, asset: str) -> int:
    """How many labels of an asset are a person's, once that is shown."""
    cards = studio.cards(lambda cards: all(place >= 0 for place in cards[asset]["labels"]))
    confidence: list[int] = cards[asset]["confidence"]
    return confidence.count(GIVEN)


def test_one_that_is_stopped_changes_nothing(studio: Studio) -> None:
    before = labels(studio)
    with studio.page() as page:
        assert page.hello
        job = ok(studio.post("/api/jobs", {"kind": "label"}))["id"]
        ok(studio.post("/api/jobs/cancel", {"id": job}))
        over = page.job(job)
        assert (over["state"], over["message"]) == ("cancelled", "Cancelled: no label was changed.")
        assert labels(studio) == before
        assert studio.settled()["history"]["undoable"] == 0
        assert carry(studio, page)["state"] == "done"


def test_hulls_that_were_cut_meanwhile_are_told_and_nothing_is_written(studio: Studio) -> None:
    with studio.page() as page:
        assert page.hello
        job = ok(studio.post("/api/jobs", {"kind": "label"}))["id"]
        studio.edit("cut", asset=THIRD, hull="top", at=[1, 1, 1.45], across=[1, 0, 0])
        over = page.job(job)
        assert over["state"] == "failed"
        assert "changed meanwhile" in over["message"]
        assert set(labels(studio)) == {f"{FIRST}.json"}
        assert ok(studio.post("/api/undo"))["message"] == f"top of {THIRD} cut in two"


def test_a_file_beside_one_asset_gives_the_vocabulary_and_all_labels_with_one_step(tmp_path: Path) -> None:
    project = four_legged(tmp_path, words=())
    text = json.dumps({"hulls": {name: "plate" if name == "top" else "post" for name in HULLS}})
    (tmp_path / "assets" / FIRST.replace(".obj", ".labels.json")).write_text(text)
    with opened(tmp_path, project.folder) as studio, studio.page() as page:
        before = kept(project)
        studio.settled()
        assert ok(studio.get("/api/labels/sources"))["files"] == 1
        job = carry(studio, page)
        assert "All labels by source: propagation 15, files 5." in job["message"], job
        assert {one.name for one in Project.open(project.folder).labels(THIRD).labels.values()} == {"plate", "post"}
        assert ok(studio.post("/api/undo"))["message"] == "hulls labelled"
        assert kept(project) == before


@pytest.mark.parametrize("seconds", [0.0, 0.6, 1.2])
def test_one_that_is_killed_leaves_labels_whole(tmp_path: Path, seconds: float) -> None:
    project = demo_project(tmp_path, demonstrated=False, tables=range(1, 8))
    for asset in project.assets()[1:]:
        project.layout.labels(asset).unlink()
    said = {"convex_00": Label("drawer")}
    with opened(tmp_path, project.folder) as studio:
        studio.settled()
        studio.edit("label", hulls={"table_02.obj": ["convex_00"]}, label="drawer")
        before = labels(studio)
        ok(studio.post("/api/jobs", {"kind": "label"}))
        time.sleep(seconds)
        studio.process.send_signal(signal.SIGKILL)
        studio.process.wait(PATIENCE)
    with opened(tmp_path, project.folder) as studio:
        hello = studio.settled()
        assert not any(card["error"] for card in hello["cards"])
        assert said.items() <= dict(project.labels("table_02.obj").labels).items()
        if hello["history"]["undo"] == "hulls labelled":
            ok(studio.post("/api/undo"))
        assert {name: text for name, text in labels(studio).items() if not name.endswith(".tmp")} == before
