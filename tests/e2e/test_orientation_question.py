"""The question whether assets are to be turned, in the browser: two pictures of one of them, and a reply by a key."""

from __future__ import annotations

from pathlib import Path

from playwright.sync_api import Browser

from tests.e2e.walk import visiting
from tests.program_parts import parse_orient
from tests.unit.project.turned_racks import racks_on_their_side


def test_a_card_shows_an_asset_as_it_stands_and_turned_no_is_final_and_yes_turns_all(
    tmp_path: Path, browser: Browser
) -> None:
    project = racks_on_their_side(tmp_path)
    with visiting(tmp_path, project, browser) as (studio, person):
        person.press("Alt+3", "u")
        card = person.page.get_by_role("region", name="stand like this?")
        card.locator("button [data-state=there]").nth(1).wait_for()
        now, then = card.locator("button canvas").all()
        assert now.screenshot() != then.screenshot()
        person.press("Enter")  # the blue one: all stay
        card.wait_for(state="detached")
        person.page.reload()
        person.drawn()
        fields = studio.steps("rack4.obj")  # another rack is shown: it is learned anew
        studio.edit("steps", **fields | {"steps": [{"select": ["top_0", "top_1"], "action": {"name": "Delete"}}]})
        found = studio.until(lambda hello: hello["assessment"] and hello["assessment"]["assets"][4]["reviewed"])
        assert not found["project"]["orient"]["text"] and found["assessment"]["question"]["kind"] == "candidate"
        assert not card.count()
        person.press("Control+z", "Control+z")
        card.wait_for()
        person.press("u", "y")
        studio.until(lambda hello: "+Z points from the leg hulls" in hello["project"]["orient"]["sentence"])
        assert project.orientation == parse_orient("orient +Z: Is(leg) -> Is(panel)")
