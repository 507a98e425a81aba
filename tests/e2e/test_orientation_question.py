"""The question whether assets are to be turned, in the browser: two pictures of one of them, and a reply by a key."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from playwright.sync_api import Browser

from tests.e2e.expert import open_question
from tests.e2e.walk import visiting
from tests.program_parts import parse_orient
from tests.unit.project.turned_racks import racks_on_their_side


def _is_asked(hello: dict[str, Any]) -> bool:
    return bool(hello["assessment"]) and (open_question(hello) or {}).get("kind") == "orientation"


def test_a_card_shows_an_asset_as_it_stands_and_turned_no_is_kept_yes_turns_all(
    tmp_path: Path, browser: Browser
) -> None:
    project = racks_on_their_side(tmp_path)
    with visiting(tmp_path, project, browser) as (studio, person):
        person.press("Alt+3", "u")
        card = person.page.locator("[aria-label='What MeshForge asks'] section")
        person.sees("stand like this?")
        card.locator("button [data-state=there]").nth(1).wait_for()
        now, then = card.locator("button canvas").all()
        assert now.screenshot() != then.screenshot()
        person.press("n")
        studio.until(lambda hello: not _is_asked(hello))
        person.page.reload()
        person.drawn()
        assert not _is_asked(studio.settled())
        person.press("Control+z")
        studio.until(_is_asked)
        person.press("u")
        person.sees("stand like this?")
        person.press("y")
        studio.until(lambda hello: "+Z points from the leg hulls" in hello["project"]["orient"]["sentence"])
        assert project.orientation == parse_orient("orient +Z: Is(leg) -> Is(panel)")
