"""What a person does with the bundled tables, in the browser: the paper's running example."""

from __future__ import annotations

import re
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from playwright.sync_api import Browser, Locator

import meshforge.studio
from meshforge.project import Project
from tests.e2e.hand import Hand, hand, windows
from tests.e2e.studio import Studio, opened

PAGE = Path(meshforge.studio.__file__).parent / "static"
FIRST, SECOND = "table_03.obj", "table_08.obj"
PATIENCE = 60.0


def address(studio: Studio) -> str:
    """Where a page of a studio is opened."""
    return f"{studio.base}/?token={studio.token}"


@contextmanager
def visiting(
    folder: Path, project: Project, browser: Browser, width: int = 1440, height: int = 900, latency: int = 0
) -> Iterator[tuple[Studio, Hand]]:
    """A person at the page of a studio on a project for a block; the page has nothing to complain of."""
    with opened(folder, project.folder, "--page", str(PAGE)) as studio, windows(browser):
        studio.settled()
        person = hand(browser, width, height, latency)
        person.open(address(studio))
        yield studio, person
        assert not person.complaints


def go_to(person: Hand, asset: str) -> None:
    """Open an asset by its card."""
    person.click(person.page.get_by_role("option", name=asset).first)
    person.drawn(asset)


def orient_by_clicking(person: Hand) -> None:
    """Up is from a leg to the panel."""
    person.click("Set by clicking")
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
    """Wait until the asset that is open says something about so many rules."""
    shown = '[aria-label="Steps of this asset"] li:not([data-open]):not(:first-child) [data-chip]'
    person.page.wait_for_function(f"count => document.querySelectorAll('{shown}').length === count", arg=steps)


def splinters(person: Hand) -> None:
    """Rule 1: what is labelled misc goes."""
    show_alike(person, "convex_30", "x", steps=1)


def top(person: Hand) -> None:
    """Rule 2: the boards of the top become one box."""
    person.hull("convex_00")
    for name in ("convex_01", "convex_02", "convex_03", "convex_04"):
        person.hull(name, "Shift")
    person.press("r", "Enter")
    stepped(person, 2)


def legs(person: Hand) -> None:
    """Rule 3: each leg becomes one hull."""
    show_alike(person, "convex_10", "m", "e", steps=3)


def drawers(person: Hand) -> None:
    """Rule 4: each drawer becomes a tray."""
    person.hull("convex_22")
    person.press("Shift+L", "r")
    person.click("tray.obj")
    person.press("e", "Enter")
    stepped(person, 4)


def handles(person: Hand) -> None:
    """Rule 5: the handles of drawers become capsules."""
    person.hull("convex_23")
    person.hull("convex_26", "Shift")
    person.press("r")
    person.click("capsule")
    person.press("e", "Enter")
    stepped(person, 5)


def click_row(person: Hand, hull: str, **how: Any) -> None:
    """Find a hull in the list by its name, and click on it there."""
    person.page.get_by_placeholder(re.compile("^Search [0-9]+ hulls")).fill(hull)
    person.click(person.page.locator(f'[role=row][data-name="{hull}"]'), **how)


def guessed(person: Hand, step: int) -> Locator:
    """Wait until the guess for a step is in hand; gives the button that keeps it."""
    button = person.button(f"Keep as step {step} Enter").or_(person.button(f"Keep as step {step}"))
    button.wait_for()
    return button


def demonstrate_tables(person: Hand) -> None:
    """Five rules on one table, and what is guessed of them on another."""
    person.press("Alt+2")
    go_to(person, FIRST)
    orient_by_clicking(person)
    for rule in (splinters, top, legs, drawers, handles):
        rule(person)
    go_to(person, SECOND)
    for step in range(1, 6):
        guessed(person, step)
        person.press("Enter")
        stepped(person, step)


def learned(studio: Studio) -> str:
    """The program that the studio has learned."""
    until = time.monotonic() + PATIENCE
    while True:
        hello = studio.settled()
        if hello["outcome"] and hello["outcome"]["program"]:
            text: str = hello["program"]["text"]
            return text
        assert time.monotonic() < until
