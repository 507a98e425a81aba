"""Every change that a page can make: on disk at once, seen by all pages, undone to the byte."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from meshforge.batch import IN_PROCESS
from meshforge.project import Project
from meshforge.symbolic import Label
from tests.e2e.legs import four_legged
from tests.e2e.studio import Studio, ok, opened
from tests.loop.command import meshforge_here as meshforge
from tests.studio_project import FEW, demo_project
from tests.unit.batch.families import tree

FIRST, THIRD = "table_01.obj", "table_03.obj"
Fields = Callable[[Studio], dict[str, Any]]


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    """Demonstrated tables with outputs, and a hull without a label."""
    folder = tmp_path_factory.mktemp("edits")
    project = demo_project(folder, tables=FEW)
    project.synthesize()
    project.set_labels(THIRD, {"convex_05": None})
    list(project.apply([FIRST, THIRD], execution=IN_PROCESS))
    with opened(folder, project.folder) as found:
        found.settled()
        yield found


def kept(studio: Studio) -> dict[str, bytes]:
    """The files of the project when all is quiet; what the studio remembers for itself, and backups, aside."""
    files = tree(studio.folder)
    return {name: data for name, data in files.items() if not name.startswith(".meshforge/") and "previous" not in name}


def without_events(files: dict[str, bytes]) -> dict[str, bytes]:
    return {name: data for name, data in files.items() if name != "events.jsonl"}


def _step(studio: Studio) -> dict[str, Any]:
    steps = studio.steps(THIRD)
    return steps | {"steps": [{"select": ["convex_30"], "action": {"name": "Delete"}}]}


def _program(studio: Studio) -> dict[str, Any]:
    version = studio.settled()["program"]["version"]
    return {"text": "labels panel, leg, handle, drawer, misc\nIs(misc) => Delete\n", "version": version}


REPAIR = {
    "id": "repair-1", "kind": "repair", "text": "?", "seconds": 3, "gain": 1, "asset": FIRST, "rule": 1,
    "hulls": [{"asset": FIRST, "hull": "convex_00", "place": 0}],
    "choices": [{"id": label, "text": label, "label": label} for label in ("leg", "panel")],
}  # fmt: skip

EDITS: dict[str, Fields] = {
    "label": lambda _: {"hulls": {FIRST: ["convex_00", "convex_01"]}, "label": "drawer"},
    "vocabulary": lambda _: {"labels": ["panel", "leg", "handle", "drawer", "misc", "knob"]},
    "rename-label": lambda _: {"old": "leg", "new": "foot"},
    "steps": _step,
    "move-rule": lambda _: {"rule": 1, "to": 2},
    "delete-rule": lambda _: {"rule": 5},
    "orient": lambda _: {"text": ""},
    "answer": lambda _: {"rule": 1, "asset": THIRD, "select": ["convex_30"]},
    "reply": lambda _: {"question": REPAIR, "choice": "leg"},
    "exclude": lambda _: {"ids": [THIRD], "reason": "not solved"},
    "program": _program,
    "cut": lambda _: {"asset": FIRST, "hull": "convex_00", "at": [0, 0, 0], "across": [1, 0, 0]},
    "review": lambda _: {"ids": [FIRST, THIRD], "verdict": "accepted", "note": "fine"},
    "correct": lambda _: {"asset": THIRD, "select": ["convex_05"], "action": {"name": "Delete"}},
}
"""One edit of each kind; those that need another before them have tests of their own."""


@pytest.mark.parametrize("kind", EDITS)
def test_an_edit_is_on_disk_and_undone_and_redone_to_the_byte(studio: Studio, kind: str) -> None:
    before = kept(studio)
    done = studio.edit(kind, **EDITS[kind](studio))
    assert not done["nothing"]
    after = kept(studio)
    assert after != before
    assert ok(studio.post("/api/undo"))["message"] == done["message"]
    assert kept(studio) == before
    assert ok(studio.post("/api/redo"))["message"] == done["message"]
    assert kept(studio) == after
    ok(studio.post("/api/undo"))
    assert kept(studio) == before


FOLLOWING: dict[str, tuple[str, Fields]] = {
    "unprepare": ("cut", lambda _: {"asset": FIRST}),
    "drop-manual-edits": ("correct", lambda _: {"asset": THIRD}),
    "take-back": ("answer", lambda _: {"id": f"1:{THIRD}"}),
}


@pytest.mark.parametrize("kind", FOLLOWING)
def test_an_edit_that_takes_another_back_is_undone_as_well(studio: Studio, kind: str) -> None:
    first, fields = FOLLOWING[kind]
    begin = kept(studio)
    studio.edit(first, **EDITS[first](studio))
    before = kept(studio)
    studio.edit(kind, **fields(studio))
    assert without_events(kept(studio)) == without_events(begin), "events are taken back by further events"
    ok(studio.post("/api/undo"))
    assert kept(studio) == before
    ok(studio.post("/api/undo"))
    assert kept(studio) == begin


def test_twenty_acts_are_undone_at_once_and_redone_to_the_byte(studio: Studio) -> None:
    studio.undo_all()
    states = [kept(studio)]
    for k in range(20):
        studio.edit("vocabulary", labels=["panel", "leg", "handle", "drawer", "misc", f"knob {k}"])
    states.append(kept(studio))
    acts = ok(studio.get("/api/history"))["acts"]
    assert [act["done"] for act in acts] == list(range(1, 21))
    with studio.page() as page:
        assert page.hello
        for way, to, state in (("undo", 0, 0), ("redo", 20, 1), ("undo", 7, None), ("redo", 20, 1)):
            assert not ok(studio.post(f"/api/{way}", {"to": to}))["nothing"]
            told = page.kind("history")
            assert told["history"]["undoable"] == to, "it is one act for the pages"
            if state is not None:
                assert kept(studio) == states[state]
            assert ok(studio.get("/api/history"))["acts"] == acts, "what was undone keeps its place"
    studio.undo_all()


def test_nothing_to_undo_is_no_error(studio: Studio) -> None:
    assert ok(studio.post("/api/undo")) == {"message": "there is nothing to undo", "nothing": True}


@pytest.mark.parametrize(
    ("kind", "fields", "about"),
    [
        ("label", {"hulls": {FIRST: ["convex_00"]}, "label": "knob"}, "not in the vocabulary"),
        ("label", {"hulls": {FIRST: ["nothing"]}, "label": "leg"}, "there is no hull"),
        ("label", {"hulls": {"no.obj": ["a"]}, "label": "leg"}, "there is no asset"),
        ("orient", {"text": "+Z: Is("}, "does not parse"),
        ("program", {"text": "Is(", "version": ""}, "changed elsewhere"),
        ("cut", {"asset": FIRST, "hull": "convex_00", "at": [99, 0, 0], "across": [1, 0, 0]}, "convex_00"),
        ("review", {"ids": ["table_02.obj"], "verdict": "accepted"}, "no output"),
        ("review", {"ids": [FIRST], "verdict": "splendid"}, "verdict"),
        ("dance", {}, "dance"),
    ],
)
def test_a_wrong_edit_is_a_message_and_no_write(studio: Studio, kind: str, fields: dict[str, Any], about: str) -> None:
    before = kept(studio)
    answer = studio.post("/api/edit", {"kind": kind, **fields})
    assert answer.status_code in (400, 404, 409)
    assert about in str(answer.json())
    assert kept(studio) == before


def test_two_pages_are_told_the_same_in_the_same_order(studio: Studio) -> None:
    studio.settled()
    studio.until(lambda hello: "review" in hello["project"]["next"]["text"])  # the last that becomes known by itself
    with studio.page() as one, studio.page() as two:
        assert one.hello == two.hello
        studio.edit("label", page="one", hulls={FIRST: ["convex_00"]}, label="leg")
        for page in (one, two):
            assert page.kind("assets")["assets"] == [FIRST]
            event = page.kind("history")
            assert event["by"] == "one"
            assert event["history"]["undo"] == f"1 hull of {FIRST} labelled leg"
            (card,) = page.kind("cards")["cards"]
            assert card["labels"][0] == 1
            page.until(lambda e: e["kind"] == "outcome" and not e["learning"])
        ok(studio.post("/api/undo", page="two"))
        for page in (one, two):
            assert page.kind("history")["by"] == "two"
            page.until(lambda e: e["kind"] == "cards" and e["cards"][0]["labels"][0] == 0)
        ending = [[e for e in page.events if e["kind"] in ("history", "assets", "project")] for page in (one, two)]
        assert ending[0] == ending[1]


def test_an_edit_of_the_vocabulary_is_told_before_the_edit_is(studio: Studio) -> None:
    labels = [row["name"] for row in studio.settled()["project"]["vocabulary"]]
    with studio.page() as page:
        studio.edit("vocabulary", page="one", labels=[*labels, "new"])
        page.kind("history")
        told = [event for event in page.events if event["kind"] == "project"]
        assert [row["name"] for row in told[0]["project"]["vocabulary"]] == [*labels, "new"]
    ok(studio.post("/api/undo"))


def test_steps_that_were_changed_elsewhere_are_a_conflict_and_stay(studio: Studio) -> None:
    stale = studio.steps(THIRD)
    studio.edit("steps", **_step(studio))
    before = kept(studio)
    answer = studio.post("/api/edit", {"kind": "steps", **stale})
    assert answer.status_code == 409
    assert answer.json()["conflict"]
    assert kept(studio) == before
    ok(studio.post("/api/undo"))


def test_the_program_is_learned_again_after_each_step_and_shown(studio: Studio) -> None:
    before = studio.settled()["program"]["text"]
    with studio.page() as page:
        assert page.hello["program"]["text"] == before
        studio.edit("delete-rule", rule=5)
        outcome = page.until(lambda e: e["kind"] == "outcome" and not e["learning"])["outcome"]
        assert len(outcome["rules"]) == 4
        (told,) = [event for event in page.events if event["kind"] == "program"]
        assert told["program"]["text"] == outcome["program"]
        assert all(len(row["rules"]) == 4 for row in page.kind("reach")["reach"])
    ok(studio.post("/api/undo"))
    assert studio.settled()["program"]["text"] == before


def test_a_program_by_hand_stays_until_the_learned_one_is_asked_for(studio: Studio) -> None:
    learned = studio.settled()["program"]["text"]
    studio.edit("program", **_program(studio))
    by_hand = studio.settled()["program"]
    assert by_hand["by_hand"] and len(by_hand["rules"]) == 1
    studio.edit("label", hulls={FIRST: ["convex_00"]}, label=None)
    assert studio.settled()["program"] == by_hand
    ok(studio.post("/api/undo"))
    with studio.page() as page:
        assert page.hello["program"]["by_hand"]
        ok(studio.post("/api/learn"))
        page.until(lambda e: e["kind"] == "program" and e["program"]["text"] == learned)
    assert not studio.settled()["program"]["by_hand"]
    ok(studio.post("/api/undo"))
    assert studio.settled()["program"]["text"] == by_hand["text"]
    ok(studio.post("/api/undo"))
    assert studio.settled()["program"]["text"] == learned


def test_what_a_command_in_a_terminal_changes_is_shown(studio: Studio, tmp_path: Path) -> None:
    folder = studio.folder
    with studio.page() as page:
        assert page.hello
        project = Project.open(folder)
        project.set_labels(FIRST, {"convex_00": "misc"}, source="user")
        assert FIRST in page.kind("assets")["assets"]
        page.until(lambda e: e["kind"] == "cards" and e["cards"][0]["labels"][0] == 4)
        project.set_labels(FIRST, {"convex_00": None})
        file = project.labels(FIRST).labels
        assert "convex_00" not in file
        page.until(lambda e: e["kind"] == "cards" and e["cards"][0]["labels"][0] == -1)
    assert meshforge("status", folder, cwd=tmp_path).out
    project.set_labels(FIRST, {"convex_00": "panel"}, source="file")
    assert project.labels(FIRST).labels["convex_00"] == Label("panel", 1.0, "file")


def test_nothing_is_left_of_a_step_that_was_undone_and_a_redo_learns_it_again(tmp_path: Path) -> None:
    project = four_legged(tmp_path)
    with opened(tmp_path, project.folder) as studio:
        before = kept(studio)
        fields = studio.steps("t0.obj") | {"steps": [{"select": ["leg_a"], "action": {"name": "Delete"}}]}
        studio.edit("steps", **fields)
        assert "Is(part_a) => Delete" in studio.settled()["program"]["text"] and project.layout.classes.ids
        ok(studio.post("/api/undo"))
        hello = studio.until(lambda found: found["program"]["text"] == "" and not found["reach"])
        assert kept(studio) == before
        assert not any(label >= 0 for card in hello["cards"] for label in card["labels"])
        ok(studio.post("/api/redo"))
        assert "Is(part_a) => Delete" in studio.settled()["program"]["text"]


def test_a_program_by_hand_reaches_the_family_where_nothing_was_demonstrated(tmp_path: Path) -> None:
    project = demo_project(tmp_path, demonstrated=False, tables=FEW)
    with opened(tmp_path, project.folder) as studio:
        text = "labels panel, leg, handle, drawer, misc\n"
        for rule in ("Is(misc) => Delete\n", "Is(leg) => Each(Merge)\n"):
            text += rule
            studio.edit("program", text=text, version=studio.settled()["program"]["version"])
            hello = studio.until(partial(_all_reached, text.count("=>")))
            assert any(row["rules"][-1] for row in hello["reach"])


def _all_reached(rules: int, hello: dict[str, Any]) -> bool:
    return [len(row["rules"]) for row in hello["reach"]] == [rules] * len(FEW)
