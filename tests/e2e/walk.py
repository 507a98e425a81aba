"""What a person does with the bundled tables, in the browser: the paper's running example."""

from __future__ import annotations

import time
from pathlib import Path

import meshforge.studio
from tests.e2e.hand import Hand
from tests.e2e.studio import Studio

PAGE = Path(meshforge.studio.__file__).parent / "static"
FIRST, SECOND = "table_03.obj", "table_08.obj"
PATIENCE = 60.0


def address(studio: Studio) -> str:
    """Where a page of a studio is opened."""
    return f"{studio.base}/?token={studio.token}"


def go_to(person: Hand, asset: str) -> None:
    """Open an asset by its card."""
    person.click(person.page.get_by_role("option", name=asset).first)
    person.drawn(asset)


def orient_by_clicking(person: Hand) -> None:
    """Up is from a leg to the panel."""
    person.click("Tell it by clicking")
    person.hull("convex_10")
    person.hull("convex_00")
    person.sees("+Z points from the leg hulls to the panel hulls")


def show_alike(person: Hand, hull: str, *keys: str, steps: int) -> None:
    """Show a rule on all hulls that are labelled as one of them, and wait until it is on disk."""
    person.hull(hull)
    person.press("Shift+L", *keys)
    person.press("Enter")
    stepped(person, steps)


def stepped(person: Hand, steps: int) -> None:
    """Wait until the asset that is open says something about so many rules, and no action is in hand."""
    shown = '[aria-label="Steps of this asset"] li:not([data-open]) button[aria-label^="Step "]'
    person.page.wait_for_function(f"count => document.querySelectorAll('{shown}').length === count", arg=steps)
    person.button("Cancel").wait_for(state="detached")


def demonstrate_tables(person: Hand) -> None:
    """Five rules on one table, and what is guessed of them on another."""
    person.press("Alt+2")
    go_to(person, FIRST)
    orient_by_clicking(person)
    show_alike(person, "convex_30", "x", steps=1)
    person.hull("convex_00")
    for name in ("convex_01", "convex_02", "convex_03", "convex_04"):
        person.hull(name, "Shift")
    person.press("r", "Enter")
    stepped(person, 2)
    show_alike(person, "convex_10", "m", "e", steps=3)
    person.hull("convex_22")
    person.press("Shift+L", "r")
    person.click("tray.obj")
    person.press("e", "Enter")
    stepped(person, 4)
    person.hull("convex_23")
    person.hull("convex_26", "Shift")
    person.press("r")
    person.click("capsule")
    person.press("e", "Enter")
    stepped(person, 5)
    go_to(person, SECOND)
    for step in range(1, 6):
        person.press("Enter")
        stepped(person, step)


def learned(studio: Studio) -> str:
    """The program that the studio has learned."""
    until = time.monotonic() + PATIENCE
    while True:
        hello = studio.settled()
        if hello["lesson"] and hello["lesson"]["program"]:
            text: str = hello["program"]["text"]
            return text
        assert time.monotonic() < until
