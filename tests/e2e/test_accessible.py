"""What a screen reader and weak eyes meet in each view, judged by axe-core, light and dark."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import trimesh
from playwright.sync_api import Browser

from tests.e2e.hand import Hand, hand, windows
from tests.e2e.studio import ending, opened, started
from tests.e2e.walk import PAGE, address
from tests.studio_project import FEW, demo_project
from tests.unit.project.tables import applied

AXE = Path(__file__).parents[2] / "web" / "node_modules" / "axe-core" / "axe.min.js"
VIEWS = {"label": "Alt+1", "demonstrate": "Alt+2", "learn": "Alt+3", "review": "Alt+4", "question": "u", "help": "?"}
_JUDGE = """
() => axe.run(document, {
  resultTypes: ['violations'],
  rules: { 'label-content-name-mismatch': { enabled: true } },  // experimental, so off unless asked for
})
"""


NEEDS_AXE = pytest.mark.skipif(not AXE.exists(), reason="axe-core is not installed: run script/bootstrap dev")


def _choose(name: str) -> Callable[[Hand], None]:
    return lambda person: person.click(person.page.get_by_role("radio", name=name))


def _press(*keys: str) -> Callable[[Hand], None]:
    return lambda person: person.press(*keys)


def _open_menu(person: Hand) -> None:
    person.press("Escape")
    person.click(person.page.get_by_role("button", name="Leave out the open asset"))


PASSING: dict[str, Callable[[Hand], None]] = {
    "assets side by side": _press("Alt+1", "w"),
    "hulls of several assets": _press("a"),
    "one asset again": _press("Escape", "Escape"),
    "section plane": _press("Shift+K"),
    "ruler": _press("Shift+K", "d"),
    "extents": _press("Escape", "a", "Shift+D"),
    "hidden hulls": _press("Escape", "a", "h"),
    "gallery": _press("q"),
    "review": _press("q", "Alt+4"),
    "all results": _choose("All results"),
    "goals": _choose("Goals"),
    "a new goal": lambda person: person.click("New goal"),
    "export": _choose("Export"),
    "results in the centre": _press("q"),
    "history": _press("q", "Alt+z"),
    "commands": _press("Escape", "Control+k"),
    "menu of the asset": _open_menu,
}
"""Ways to what is seen for a while only, one after the other."""


@NEEDS_AXE
def test_every_view_can_be_read_and_reached(tmp_path: Path, browser: Browser) -> None:
    project = demo_project(tmp_path, tables=FEW)
    with opened(tmp_path, project.folder, "--page", str(PAGE)) as studio, windows(browser):
        studio.settled()
        for theme in ("light", "dark"):
            person = _person(browser, theme)
            person.open(address(studio))
            for view, key in VIEWS.items():
                person.press(key)
                person.page.wait_for_timeout(300)  # until what fades has come to rest
                assert _found(person) == [], f"{view}, {theme}"
            person.page.context.close()


@NEEDS_AXE
def test_what_comes_and_goes_can_be_read_and_reached(tmp_path: Path, browser: Browser) -> None:
    project = applied(tmp_path)
    with opened(tmp_path, project.folder, "--page", str(PAGE)) as studio, windows(browser):
        studio.settled()
        for theme in ("light", "dark"):
            person = _person(browser, theme)
            person.open(address(studio))
            for view, acts in PASSING.items():
                acts(person)
                person.page.wait_for_timeout(300)
                assert _found(person) == [], f"{view}, {theme}"
            assert not person.complaints
            person.page.context.close()


@NEEDS_AXE
def test_the_start_page_can_be_read_and_reached(tmp_path: Path, browser: Browser) -> None:
    source = tmp_path / "desks"
    source.mkdir()
    (source / "bad.obj").write_text("v 0 0 zero\n")
    mesh = trimesh.creation.annulus(0.5, 1.0, 1.0)
    mesh.export(source / "ring.stl")
    with ending(started("studio", "--page", str(PAGE))) as studio, windows(browser):
        for theme in ("light", "dark"):
            person = _person(browser, theme)
            person.page.goto(address(studio))
            person.page.get_by_role("heading", name="New project").wait_for()
            assert _found(person) == [], f"start, {theme}"
            person.page.get_by_label("Folder of assets", exact=True).fill(str(source))
            person.press("Enter")
            person.sees("Make convex hulls.")
            person.click(person.page.get_by_role("radio", name="V-HACD"))
            person.sees("1 asset cannot be read")
            assert _found(person) == [], f"assets found, {theme}"
            for button in ("Open…", "Browse for the folder of assets", "Browse for the place of the project"):
                person.click(button)
                person.page.get_by_role("list", name="Folders").wait_for()
                assert _found(person) == [], f"{button}, {theme}"
                person.press("Escape")
            for name in ("Files that you drop or pick", "A bundled family"):
                person.click(person.page.get_by_role("radio", name=name))
                assert _found(person) == [], f"{name}, {theme}"
            person.page.context.close()


def _person(browser: Browser, theme: str) -> Hand:
    person = hand(browser)
    person.page.emulate_media(color_scheme="dark" if theme == "dark" else "light")
    person.page.add_init_script(path=AXE)
    return person


def _found(person: Hand) -> list[tuple[str, str]]:
    """What is wrong, and where."""
    violations: list[dict[str, Any]] = person.page.evaluate(_JUDGE)["violations"]
    return [(one["id"], node["html"]) for one in violations for node in one["nodes"]]
