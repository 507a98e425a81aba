"""A person at the studio: a real browser, whose clicks and keys are counted."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

import pytest
from playwright.sync_api import Browser, ConsoleMessage, Locator, Page, sync_playwright

from benchmark.studio.browser import FLAGS

CHROMIUM = Path(os.environ.get("CHROMIUM", "/usr/bin/chromium"))
PATIENCE = 60_000.0
"""Milliseconds that anything may take before a test gives up; nothing is measured by it."""

_MOST_KEYS = 60
_KEY_TOWARDS = """
target => {
  const now = document.activeElement;
  if (now === target) return null;
  const parts = [...document.querySelectorAll('[data-part]')];
  const partOf = element => parts.findLast(part => part.contains(element));
  if (parts.length && partOf(now) !== partOf(target)) return 'F6';
  return now.compareDocumentPosition(target) & Node.DOCUMENT_POSITION_PRECEDING ? 'Shift+Tab' : 'Tab';
}
"""
"""The key that leads from where the focus is towards an element."""
_NEXT_ROW = """
([grid, last]) => {
  const name = document.getElementById(grid.getAttribute('aria-activedescendant'))?.dataset.name;
  return name !== last ? name : null;
}
"""


@dataclass
class Hand:
    """Clicks and types on a page. actions: how many clicks and keys that took; complaints: errors of the page."""

    page: Page
    actions: int = 0
    complaints: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.page.set_default_timeout(PATIENCE)
        self.page.on("console", self._heard)
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))

    def _heard(self, message: ConsoleMessage) -> None:
        # the browser itself complains of every refused request, which the page then tells in words
        if (
            message.type == "error"
            and "Failed to load resource" not in message.text
            and "WebSocket" not in message.text
        ):
            self.complaints.append(message.text)

    # Acting

    def open(self, address: str) -> None:
        """Open the studio and wait until an asset is drawn."""
        self.page.goto(address)
        self.drawn()

    def press(self, *keys: str) -> None:
        for key in keys:
            self.page.keyboard.press(key)
            self.actions += 1

    def type(self, text: str) -> None:
        self.page.keyboard.type(text)
        self.actions += len(text)

    def click(self, target: Locator | str, **how: Any) -> None:
        """Click on something, or on the button of a name."""
        place = self.button(target) if isinstance(target, str) else target
        place.click(**how)
        self.actions += 1

    def hull(self, name: str, *held: Any) -> None:
        """Click on a hull in the viewport, while keys are held, once the picture is that of the present state."""
        self.page.wait_for_function(
            "name => document.querySelector('[data-testid=viewport]')?.ariaBusy === 'false'"
            " && window.meshforgeViewport?.project(name)",
            arg=name,
        )
        place = self.page.evaluate("name => window.meshforgeViewport.project(name)", name)
        for key in held:
            self.page.keyboard.down(key)
        self.page.mouse.move(place["x"], place["y"])
        self.page.mouse.click(place["x"], place["y"])
        for key in held:
            self.page.keyboard.up(key)
        self.actions += 1 + len(held)

    def reach(self, target: Locator) -> None:
        """Put the focus on something by keys: F6 goes from part to part, Tab within one."""
        target.wait_for()
        for _ in range(_MOST_KEYS):
            if key := target.evaluate(_KEY_TOWARDS):
                self.press(key)
            else:
                return
        raise AssertionError("no key leads there")

    def choose(self, hulls: Collection[str]) -> None:
        """Select hulls of what is shown in the list of hulls, by keys."""
        grid = self.page.get_by_role("grid", name="Hulls").or_(self.page.get_by_role("treegrid", name="Hulls"))
        self.reach(grid)
        self.press("Alt+a", "Control+Home")
        left, last = set(hulls), None
        while left:  # a row is drawn after its key; the list is over where no other one comes
            at = self.page.wait_for_function(_NEXT_ROW, arg=[grid.element_handle(), last]).json_value()
            if at in left:
                self.press("Space")
                left.remove(at)
            else:
                last = at
                self.press("Control+ArrowDown")
        self.page.wait_for_function("count => window.meshforgeViewport.selected().length === count", arg=len(hulls))

    # Looking

    def button(self, name: str) -> Locator:
        return self.page.get_by_role("button", name=name, exact=True)

    def region(self, name: str) -> Locator:
        return self.page.get_by_role("region", name=name, exact=True)

    def sees(self, text: str) -> None:
        self.page.get_by_text(text).first.wait_for(state="visible")

    def drawn(self, asset: str | None = None) -> None:
        """Wait until an asset, or any, is drawn."""
        self.page.wait_for_function(
            "wanted => { const seen = document.querySelector('[data-testid=viewport]')?.dataset.ready;"
            " return wanted ? seen === wanted : Boolean(seen); }",
            arg=asset,
        )


class KeyboardHand(Hand):
    """A person without a pointer: buttons, choices and hulls are reached by keys."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self.page.add_init_script("addEventListener('pointerdown', () => { window.clicked = true }, true)")

    def click(self, target: Locator | str, **how: Any) -> None:
        place = self.button(target) if isinstance(target, str) else target
        place.wait_for()
        if place.get_attribute("role") in ("radio", "tab"):  # of which Tab reaches the one that is chosen
            group = place.locator("xpath=ancestor::*[@role='group' or @role='radiogroup' or @role='tablist'][1]")
            self.reach(group.locator("[aria-checked=true], [aria-selected=true]"))
            while not place.evaluate("one => one === document.activeElement"):
                self.press("ArrowRight")
        self.reach(place)
        self.press("Enter")

    def hull(self, name: str, *held: Any) -> None:
        self.choose([*(self.page.evaluate("window.meshforgeViewport.selected()") if held else ()), name])


@contextmanager
def chromium() -> Iterator[Browser]:
    """A browser with rendering in software; tests skip where there is none, and fail in CI."""
    if not CHROMIUM.exists():
        if os.environ.get("CI"):
            raise FileNotFoundError(f"there is no browser at {CHROMIUM}")
        pytest.skip(f"there is no browser at {CHROMIUM}: install Debian's chromium, or set CHROMIUM")
    with sync_playwright() as tool, tool.chromium.launch(executable_path=CHROMIUM, args=list(FLAGS)) as browser:
        yield browser


@contextmanager
def windows(browser: Browser) -> Iterator[None]:
    """Close all windows of a browser after a block, and photograph them first if it fails."""
    try:
        yield
    except BaseException:
        _photograph(browser)
        raise
    finally:
        for context in browser.contexts:
            context.close()


def _photograph(browser: Browser) -> None:
    """Keep how the pages of a failed test look, in the folder that MESHFORGE_SCREENSHOTS names, if it does."""
    folder = os.environ.get("MESHFORGE_SCREENSHOTS")
    pages = [page for context in browser.contexts for page in context.pages] if folder else []
    for number, page in enumerate(pages):
        page.screenshot(path=f"{folder}/{number}.png")


def hand(
    browser: Browser, width: int = 1440, height: int = 900, latency: int = 0, *, glides: bool = False, by: str = "mouse"
) -> Hand:
    """A person at a fresh window. latency: of the connection [ms]; glides: whether the camera does; by: mouse, or
    keyboard alone."""
    motion: Literal["no-preference", "reduce"] = "no-preference" if glides else "reduce"
    page = browser.new_context(viewport={"width": width, "height": height}, reduced_motion=motion).new_page()
    if latency:
        speed = {"offline": False, "latency": latency, "downloadThroughput": -1, "uploadThroughput": -1}
        page.context.new_cdp_session(page).send("Network.emulateNetworkConditions", speed)
    return KeyboardHand(page) if by == "keyboard" else Hand(page)
