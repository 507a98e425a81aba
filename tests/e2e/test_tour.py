"""The guided tour of the demo, as a newcomer follows it: from the command to tables that are signed off, and right."""

from __future__ import annotations

import re
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser

from meshforge.formats import load
from meshforge.language import Program
from meshforge.project import Project
from tests.e2e.hand import Hand, hand, windows
from tests.e2e.studio import Studio, ending, started
from tests.e2e.walk import address, guessed, learned, stepped

MEANT = """labels panel, leg, handle, drawer, misc

orient +Z: Is(leg) -> Is(panel)

Is(misc)           => Delete
Geo(Is(panel), +Z) => Replace(box)
"""
"""What the person has in mind: of the panels, the table top alone."""
IN_VIEW = "Boolean(document.activeElement?.closest('[data-testid=viewport]'))"


@pytest.mark.parametrize("by", ["mouse", "keyboard"])
def test_who_follows_the_tour_has_fourteen_right_tables_signed_off(by: str, tmp_path: Path, browser: Browser) -> None:
    words = ("demo", "--studio", "--out", str(tmp_path / "tables"))
    with ending(started(*words)) as studio, windows(browser):
        person = hand(browser, 1280, 720, glides=True, by=by)
        person.open(address(studio))
        read = [_mark(person, "A family of tables")]
        person.click("Next")
        read.append(_mark(person, "Four stages"))
        _stage(person, "Demonstrate")
        read.append(_mark(person, "Select the splinters"))
        person.hull("convex_20")
        person.press("Shift+L")
        read.append(_mark(person, "Delete them"))
        person.press("x", "Enter")
        read.append(_mark(person, "Make the table top one box"))
        stepped(person, 1)
        person.hull("convex_00")
        person.press("Shift+L", "r", "Enter")
        read.append(_mark(person, "The second table is easier"))
        stepped(person, 2)
        while by == "keyboard" and not person.page.evaluate(IN_VIEW):  # elsewhere Tab moves within the page
            person.press("F6")
        person.press("Tab")
        for step in (1, 2):
            person.click(guessed(person, step))
            stepped(person, step)
        read.append(_mark(person, "MeshForge has learned"))
        _stage(person, "Learn")
        read.append(_mark(person, "The first program is not right yet"))
        assert "Is(panel) => Replace(box)" in learned(studio)
        _sees_what_is_held(person, studio)
        _choose(person, studio, "Geo(Is(panel), +Z)")
        read.append(_mark(person, "Answer until nothing is held"))
        answered = _answer_all(person, studio)
        read.append(_mark(person, "Write the tables"))
        _stage(person, "Review")
        person.click("Apply to all")
        read.append(_mark(person, "Look, then export"))
        person.sees("Signed off 14 of 14")
        person.press("Alt+2")
        person.click("Find hulls that span parts")
        person.sees("None: all hulls have labels from you or from files.")
        assert _assessed(studio)["signed_off"] == 14
        assert not person.complaints
        assert by == "mouse" or not person.page.evaluate("window.clicked")
    _are_right(Project.open(next(tmp_path.rglob("meshforge.toml")).parent))
    count = sum(len(text.split()) for text in read)
    print(f"\nthe tour by {by}: {count} words to read, {person.actions} clicks and keys, {answered} of them answers")


def _mark(person: Hand, title: str) -> str:
    """What the tour says, once it has come to a mark."""
    mark = person.page.get_by_role("dialog", name=title)
    mark.wait_for()
    return mark.inner_text()


def _stage(person: Hand, name: str) -> None:
    person.click(person.page.get_by_role("tab", name=re.compile(name)))


def _assessed(studio: Studio) -> dict[str, Any]:
    """How sure the edits are, once that is known."""
    found: dict[str, Any] = studio.until(_is_assessed)["assessment"]
    return found


def _is_assessed(hello: dict[str, Any]) -> bool:
    return not hello["learning"] and not hello["assessing"] and bool((hello["assessment"] or {}).get("assets"))


def _sees_what_is_held(person: Hand, studio: Studio) -> None:
    """Nothing reassures: tables that would become solid blocks are held, and nothing is green."""
    found = _assessed(studio)
    solid = {row["asset"] for row in found["assets"] if any("solid block" in doubt["text"] for doubt in row["reasons"])}
    assert len(solid) >= 4
    assert all(row["state"] == "needs review" for row in found["assets"] if row["asset"] in solid)
    person.sees(f"Signed off {found['signed_off']} of 14")
    assert not person.page.locator("[data-mood=good]").count()


def _choose(person: Hand, studio: Studio, extractor: str) -> None:
    """Take the picture of what is meant, by its key."""
    question = _assessed(studio)["question"]
    person.press("u", str([choice["text"] for choice in question["choices"]].index(extractor) + 1))
    studio.until(partial(_is_another, question["id"]))


def _is_another(last: str, hello: dict[str, Any]) -> bool:
    return _is_assessed(hello) and (hello["assessment"]["question"] or {}).get("id") != last


def _answer_all(person: Hand, studio: Studio) -> int:
    """Say yes to every card, as all that MeshForge proposes is right now; gives how many there were."""
    answered = 0
    while question := _assessed(studio)["question"]:
        card = person.page.get_by_role("region", name=question["text"])
        card.wait_for()
        person.press("y")
        studio.until(partial(_is_another, question["id"]))
        answered += 1
        assert answered < 12
    return answered


def _are_right(project: Project) -> None:
    """The program is the meant one, and every table that was written is what it makes of that table."""
    meant = Program.parse(MEANT)
    assert project.program() == meant
    assert not [row.id for row in project.status().assets if row.output != "edited"]
    for asset in project.assets():
        result = meant.run(project.mesh(asset)).mesh
        written = load(project.layout.edited / asset)
        volumes = [sorted(round(hull.volume, 6) for hull in mesh.hulls) for mesh in (result, written)]
        assert volumes[0] == volumes[1], asset
