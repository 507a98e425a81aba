"""The guided tour of the demo, as a newcomer follows it, from the command to a program and edited tables."""

from __future__ import annotations

import re
from pathlib import Path

from tests.e2e.hand import Hand, chromium, hand
from tests.e2e.studio import ending, started
from tests.e2e.walk import address, guessed, learned, stepped


def test_who_follows_the_tour_has_a_program_and_edited_tables(tmp_path: Path) -> None:
    words = ("demo", "--studio", "--out", str(tmp_path / "tables"))
    with ending(started(*words)) as studio, chromium() as browser:
        person = hand(browser, 1280, 720)
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
        person.press("Tab")
        for step in (1, 2):
            guessed(person, step)
            person.press("Enter")
            stepped(person, step)
        read.append(_mark(person, "MeshForge has learned"))
        _stage(person, "Learn")
        read.append(_mark(person, "The program, in words"))
        program = learned(studio)
        _stage(person, "Review")
        read.append(_mark(person, "Apply to all tables"))
        person.click("Apply to all")
        read.append(_mark(person, "Look before you export"))
        studio.cards(lambda cards: all(card["output"] in ("edited", "unchanged") for card in cards.values()))
        assert not person.complaints
    rules = [line.partition("=>")[2].strip() for line in program.splitlines() if "=>" in line]
    assert rules == ["Delete", "Replace(box)"]
    count = sum(len(text.split()) for text in read)
    print(f"\nthe tour: {count} words to read, {person.actions} clicks and keys")


def _mark(person: Hand, title: str) -> str:
    """What the tour says, once it has come to a mark."""
    mark = person.page.get_by_role("dialog", name=title)
    mark.wait_for()
    return mark.inner_text()


def _stage(person: Hand, name: str) -> None:
    person.click(person.page.get_by_role("tab", name=re.compile(name)))
