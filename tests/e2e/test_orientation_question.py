"""The question whether assets are to be turned, in the browser: two pictures of one of them, and a reply by a key."""

from __future__ import annotations

from pathlib import Path

from playwright.sync_api import Browser

from tests.e2e.walk import visiting
from tests.program_parts import parse_orient
from tests.unit.project.turned_racks import racks_on_their_side


def test_a_card_shows_an_asset_as_it_stands_and_turned_and_yes_turns_all(tmp_path: Path, browser: Browser) -> None:
    project = racks_on_their_side(tmp_path)
    with visiting(tmp_path, project, browser) as (studio, person):
        person.press("Alt+3", "u")
        card = person.page.locator("section[aria-labelledby=asked]")
        person.sees("stand like this?")
        card.locator("button [data-state=there]").nth(1).wait_for()
        now, then = card.locator("button canvas").all()
        assert now.screenshot() != then.screenshot()
        person.press("y")
        studio.until(lambda hello: "+Z points from the leg hulls" in hello["project"]["orient"]["sentence"])
        assert project.orientation == parse_orient("orient +Z: Is(leg) -> Is(panel)")
