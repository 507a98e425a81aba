"""The start page without a pointer: a project is made, an asset left out and put back, and that is undone."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from playwright.sync_api import Browser

from meshforge.samples import TABLES
from tests.e2e.hand import hand, windows
from tests.e2e.studio import ending, started
from tests.e2e.walk import PAGE, address


def test_a_project_is_made_and_its_family_changed_by_the_keyboard_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, browser: Browser
) -> None:
    monkeypatch.setenv("MESHFORGE_STATE", str(tmp_path / "state"))  # no projects of other tests among the recent ones
    source = tmp_path / "desks"
    source.mkdir()
    names = ["table_01.obj", "table_02.obj", "table_03.obj"]
    for name in names:
        shutil.copyfile(TABLES / name, source / name)
    with ending(started("studio", "--page", str(PAGE))) as studio, windows(browser):
        person = hand(browser, by="keyboard")
        person.page.goto(address(studio))
        person.page.get_by_role("heading", name="New project").wait_for()
        person.reach(person.page.get_by_label("Folder of assets", exact=True))
        person.type(str(source))
        person.press("Enter")
        person.sees("3 OBJ")
        person.reach(person.page.get_by_label("Project folder"))
        person.press("Control+a")
        person.type(str(tmp_path / "mine"))
        person.press("Enter")
        person.drawn("table_01.obj")
        shown = person.page.get_by_role("option")
        person.press("Control+k")
        person.type("leave this asset")
        person.press("Enter")
        person.sees("1 asset left out")
        assert shown.count() == 2
        person.click(person.page.get_by_text("1 asset left out"))
        person.click("Put back table_01.obj")
        person.page.get_by_role("option", name="table_01.obj").wait_for()
        assert shown.count() == 3
        person.press("Control+z")
        person.sees("1 asset left out")
        person.press("Control+z")
        person.page.get_by_role("option", name="table_01.obj").wait_for()
        assert person.complaints == []
