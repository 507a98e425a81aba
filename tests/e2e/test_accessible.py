"""What a screen reader and weak eyes meet in each view, judged by axe-core, light and dark."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import pytest
import trimesh
from playwright.sync_api import Browser

from meshforge.project import Project
from tests.e2e.hand import Hand, hand, windows
from tests.e2e.studio import ending, started
from tests.e2e.test_seeing import two_bodies
from tests.e2e.walk import PAGE, address, visiting
from tests.studio_project import FEW, demo_project
from tests.unit.project.shelves import mislabelled
from tests.unit.project.tables import applied
from tests.unit.project.turned_racks import racks_on_their_side

AXE = Path(__file__).parents[2] / "web" / "node_modules" / "axe-core" / "axe.min.js"
_JUDGE = """
() => axe.run(document, {
  resultTypes: ['violations'],
  rules: { 'label-content-name-mismatch': { enabled: true } },  // experimental, so off unless asked for
})
"""
_REST = "document.getAnimations().every(one => one.effect.getComputedTiming().endTime === Infinity)"
"""What fades has come to rest; what turns for ever may go on."""
NEEDS_AXE = pytest.mark.skipif(not AXE.exists(), reason="axe-core is not installed: run script/bootstrap dev")


def _choose(name: str) -> Callable[[Hand], None]:
    return lambda person: person.click(person.page.get_by_role("radio", name=name))


def _press(*keys: str) -> Callable[[Hand], None]:
    return lambda person: person.press(*keys)


def _open_menu(person: Hand) -> None:
    person.press("Escape")
    person.click(person.page.get_by_role("button", name="Leave out the open asset"))


def _ask(text: str, *keys: str) -> dict[str, Callable[[Hand], None]]:
    """To the card of a question, by a part of its text; keys: that lead there from the card before it."""

    def act(person: Hand) -> None:
        person.press("Alt+3", *keys)
        person.page.get_by_role("region", name=text).wait_for()
        person.press("u")

    return {text: act}


def _meet_problem(person: Hand) -> None:
    person.page.evaluate("void Promise.reject(new Error('no hull has this name'))")
    person.page.get_by_role("alert").get_by_text("This is a bug").wait_for()


VIEWS = {f"stage {k}": _press(f"Alt+{k}") for k in range(1, 5)} | {"help": _press("?")}
PASSING: dict[str, Callable[[Hand], None]] = {
    "assets side by side": _press("Alt+1", "w"),
    "hulls of several assets": _press("a"),
    "one asset again": _press("Escape", "Escape"),
    "section plane": _press("Shift+K"),
    "ruler": _press("Shift+K", "d"),
    "extents": _press("Escape", "a", "Shift+D"),
    "hidden hulls": _press("Escape", "a", "h"),
    "gallery": _press("q"),
    "gallery in review": _press("Alt+4"),
    "review": _press("q"),
    "all results": _choose("All results"),
    "goals": _choose("Goals"),
    "a new goal": lambda person: person.click("New goal"),
    "export": _choose("Export"),
    "commands": _press("Control+k"),
    "menu of the asset": _open_menu,
    "history": _press("Escape", "Alt+z"),
    "an earlier state": _press("ArrowDown"),
    "tour": _press("Escape", "Control+k", *"guided tour", "Enter"),
    "problem": _meet_problem,
    "problems": lambda person: person.click(person.page.get_by_role("button", name="Problems")),
}
"""Ways to what is seen for a while only, one after the other."""


@NEEDS_AXE
@pytest.mark.parametrize(
    ("make", "acts"),
    [
        (partial(demo_project, tables=FEW), VIEWS),
        (applied, PASSING),
        (racks_on_their_side, _ask("stand like this?") | _ask("which hulls should rule 1 take?", "n")),
        (mislabelled, _ask("is it knob?")),
        (two_bodies, {"bodies": _press("Alt+1")}),
    ],
)
def test_every_view_can_be_read_and_reached(
    make: Callable[[Path], Project], acts: Mapping[str, Callable[[Hand], None]], tmp_path: Path, browser: Browser
) -> None:
    with visiting(tmp_path, make(tmp_path), browser) as (studio, person):
        studio.edit("up", up="Z")  # so that there is a history
        person.page.evaluate(AXE.read_text(encoding="utf-8"))
        for view, act in acts.items():
            act(person)
            _judge(person, view)


@NEEDS_AXE
def test_the_start_page_can_be_read_and_reached(tmp_path: Path, browser: Browser) -> None:
    source = tmp_path / "desks"
    source.mkdir()
    (source / "bad.obj").write_text("v 0 0 zero\n")
    mesh = trimesh.creation.annulus(0.5, 1.0, 1.0)
    mesh.export(source / "ring.stl")
    with ending(started("studio", "--page", str(PAGE))) as studio, windows(browser):
        person = hand(browser)
        person.page.add_init_script(path=AXE)
        person.page.goto(address(studio))
        person.page.get_by_role("heading", name="New project").wait_for()
        _judge(person, "start")
        person.page.get_by_label("Folder of assets", exact=True).fill(str(source))
        person.press("Enter")
        person.sees("Make convex hulls.")
        person.click(person.page.get_by_role("radio", name="V-HACD"))
        person.sees("1 asset cannot be read")
        _judge(person, "assets found")
        for button in ("Open…", "Browse for the folder of assets", "Browse for the place of the project"):
            person.click(button)
            person.page.get_by_role("list", name="Folders").wait_for()
            _judge(person, button)
            person.press("Escape")
        for name in ("Files that you drop or pick", "A bundled family"):
            person.click(person.page.get_by_role("radio", name=name))
            _judge(person, name)


def _judge(person: Hand, view: str) -> None:
    """Fail with what is wrong in what is seen, and where, light and dark."""
    for theme in ("light", "dark"):
        person.page.emulate_media(color_scheme="dark" if theme == "dark" else "light")
        person.page.wait_for_function(_REST)
        violations: list[dict[str, Any]] = person.page.evaluate(_JUDGE)["violations"]
        assert [(one["id"], node["html"]) for one in violations for node in one["nodes"]] == [], f"{view}, {theme}"
