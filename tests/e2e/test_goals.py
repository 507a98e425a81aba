"""Goals in the studio: made by a form, tried, kept, seen to fail with a picture, accepted all the same, signed off."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser

from meshforge.batch import IN_PROCESS
from meshforge.project import Project
from tests.e2e.studio import ok, opened
from tests.e2e.walk import go_to, visiting
from tests.studio_project import demo_project
from tests.unit.project.tables import FIRST, SECOND, THIRD, applied

KEPT, FAILS = "supports(Is(top))", "graspable(Is(top), width = 0.001)"
TABLE = "table_01.obj"


def _goal(card: dict[str, Any]) -> dict[str, Any]:
    (found,) = card["goals"]
    return dict(found)


def _kept(project: Project) -> dict[str, str]:
    return dict(tomllib.loads(project.layout.settings.read_text()).get("goals", {}))


def test_a_form_comes_to_a_goal_or_to_the_reason_why_not(tmp_path: Path) -> None:
    project = applied(tmp_path)
    with opened(tmp_path, project.folder) as studio:
        forms = {form["name"]: form for form in studio.settled()["language"]["goals"]}
        assert [one["omitted"] for one in forms["supports"]["arguments"]] == ["", "10%", "nowhere"]

        def check(name: str, **arguments: str) -> dict[str, Any]:
            return ok(studio.post("/api/goal/check", {"name": name, "arguments": arguments}))

        found = check("graspable", handle="Is(top)", width="1 mm")
        assert (found["text"], found["error"], found["name"]) == (FAILS, None, "graspable_top")
        assert found["sentence"].startswith("Some grip of a parallel gripper on each part of the top hulls is free")
        assert check("graspable", handle="Is(tap)")["error"].splitlines()[1:3] == [
            "    graspable(Is(tap))",
            "                 ^^^",
        ]
        assert "flies" in check("flies")["error"]
        rows = studio.post("/api/goal/extractors", {"asset": FIRST, "select": ["left_low"]}).json()
        assert "Is(leg)" in [row["text"] for row in rows]
        assert studio.post("/api/goal/extractors", {"asset": FIRST, "select": ["none"]}).status_code == 400


def test_goals_are_edits_that_are_undone_and_bad_ones_change_nothing(tmp_path: Path) -> None:
    project = applied(tmp_path)
    with opened(tmp_path, project.folder) as studio:
        studio.settled()
        studio.edit("goal", name="carries", text=KEPT)
        studio.edit("goal", name="holds", text=KEPT, was="carries")
        for name, text in (("grip", "graspable(Is(tap))"), (" ", KEPT), ("gone", None)):
            assert studio.post("/api/edit", {"kind": "goal", "name": name, "text": text}).status_code == 400
        assert studio.post("/api/edit", {"kind": "goal", "name": "holds", "text": "stands"}).status_code == 400
        assert _kept(project) == {"holds": KEPT}
        hello = studio.until(lambda hello: len(hello["project"]["goals"]) == 1)
        assert hello["project"]["goals"][0]["call"] == {"name": "supports", "arguments": {"surface": "Is(top)"}}
        ok(studio.post("/api/undo"))
        assert _kept(project) == {"carries": KEPT}
        studio.edit("goal", name="carries", text=None)
        studio.cards(lambda cards: not any(card["goals"] for card in cards.values()))
        text = project.layout.settings.read_text().replace("[goals]", '[goals]\nbad = "flies("')
        project.layout.settings.write_text(text)
        hello = studio.until(lambda hello: bool(hello["project"]["goals"] and hello["project"]["problem"]))
        assert hello["project"]["goals"][0]["error"].startswith("unknown goal")
        studio.edit("goal", name="bad", text=None)
        studio.until(lambda hello: not hello["project"]["problem"])


def test_what_fails_has_a_picture_and_stays_open_until_it_is_accepted(tmp_path: Path) -> None:
    project = applied(tmp_path)
    with opened(tmp_path, project.folder) as studio:
        studio.settled()
        job = studio.run_job(kind="check", goal=FAILS)
        assert job["message"] == "graspable holds on 0 of 3 assets, 0 before the edit."
        assert [(line["asset"], line["status"]) for line in job["lines"]] == [
            (one, "failed") for one in (FIRST, SECOND, THIRD)
        ]
        picture = studio.get("/api/goal/picture", asset=FIRST, v=job["lines"][0]["picture"])
        assert picture.content.startswith(b"\x89PNG")
        for asset, key in ((FIRST, "../../x"), (FIRST, "0" * 12), ("../" + FIRST, job["lines"][0]["picture"])):
            assert studio.get("/api/goal/picture", asset=asset, v=key).status_code == 404
        assert studio.post("/api/jobs", {"kind": "check", "goal": "flies("}).status_code == 400
        studio.edit("goal", name="grip", text=FAILS)
        studio.cards(lambda cards: all(_goal(card)["outcome"] == "failed" for card in cards.values() if card["goals"]))
        studio.edit("review", ids=[FIRST], verdict="accepted")
        cards = studio.cards(lambda cards: cards[FIRST]["review"] == "accepted" and bool(cards[FIRST]["goals"]))
        assert not _goal(cards[FIRST])["accepted"]
        studio.edit("review", ids=[FIRST], verdict="accepted", goals=[FAILS])
        studio.cards(lambda cards: _goal(cards[FIRST])["accepted"])
        assert studio.run_job(kind="apply")["message"].endswith("Goals fail on 3 results.")
        studio.edit("goal", name="grip", text=KEPT, was="grip")
        studio.cards(lambda cards: all(_goal(card)["outcome"] is None for card in cards.values()))
        studio.run_job(kind="apply")
        studio.cards(lambda cards: all(_goal(card)["outcome"] == "passed" for card in cards.values()))


@pytest.mark.parametrize("keys", [False, True], ids=["mouse", "keyboard"])
def test_a_goal_is_made_seen_to_fail_accepted_and_signed_off(tmp_path: Path, browser: Browser, keys: bool) -> None:
    project = demo_project(tmp_path, tables=(1, 3, 8))
    project.synthesize()
    list(project.apply(execution=IN_PROCESS))
    with visiting(tmp_path, project, browser, 1280, 800) as (studio, person):
        page = person.page

        def act(target: Any) -> None:
            place = person.button(target) if isinstance(target, str) else target
            if keys:
                person.reach(place)
                person.press("Enter")
            else:
                person.click(place)

        person.press("Alt+4")
        go_to(person, TABLE)
        person.click(page.get_by_role("radio", name="Goals"))
        act("New goal")
        act("clear")
        if keys:
            person.reach(page.get_by_role("textbox", name="What keeps its distance"))
            person.type("Is(drawr)")
            page.get_by_text("Did you mean 'drawer'?").wait_for()
            assert person.button("Keep").is_disabled()
            person.press("Backspace", "Backspace")
            person.type("er)")
        else:
            person.hull("convex_18")
            act(page.get_by_role("group", name="For the selected hulls").get_by_role("button").first)
        act("Try it")
        person.sees("clear holds on 2 of 3 assets, 3 before the edit.")
        act("Keep")
        act("fails on 1")
        assert _kept(project) == {"clear_drawer": "clear(Is(drawer))"}
        shown = page.get_by_role("region", name="Goals").get_by_role("img")
        shown.wait_for()
        page.wait_for_function("image => image.naturalWidth === 640", arg=shown.element_handle())
        act(page.get_by_title("Select 2 hulls at fault"))
        assert page.get_by_test_id("selection").inner_text().startswith("2 selected")
        person.sees("goals fail on 1 result")
        act(page.get_by_role("region", name="Goals").get_by_role("button", name="Accept it all the same"))
        person.sees("Signed off 3 of 3")
        person.sees("accepted all the same")
        studio.until(lambda hello: (hello["assessment"] or {}).get("signed_off") == 3)
        assert not page.get_by_text(re.compile("goals fail")).count()
