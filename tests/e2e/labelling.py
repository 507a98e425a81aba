"""How a person labels a whole family at once: its assets side by side, a hull painted with its look-alikes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress

from playwright.sync_api import TimeoutError as PlaywrightTimeout

from tests.e2e.hand import Hand


def label_look_alikes(person: Hand, truth: Mapping[str, Mapping[str, str]], words: Sequence[str]) -> None:
    """Paint every hull of up to eight assets. truth: by asset and name; words: the labels by their digits."""
    meant = {f"{hull} · {asset}": word for asset, own in truth.items() for hull, word in own.items()}
    done = set[str]()
    person.press("w")
    person.page.wait_for_function(
        "count => document.querySelector('[data-testid=counts]')?.textContent.startsWith(`${count}`)", arg=len(meant)
    )
    for digit, word in enumerate(words, 1):
        person.press(str(digit))
        while left := [name for name, its in meant.items() if its == word and name not in done]:
            hull = next(name for name in left if visible(person, name))
            taken = point_brush(person, hull)
            alone = any(meant[name] != word for name in taken)
            person.hull(hull, *(["Alt"] if alone else []))
            done |= {hull} if alone else set(taken)


def visible(person: Hand, hull: str) -> bool:
    """Whether something of a hull is seen in the view."""
    return person.page.evaluate("name => window.meshforgeViewport.project(name)", hull) is not None


def point_brush(person: Hand, hull: str, least: int = 2) -> list[str]:
    """Point at a hull with the brush; the hulls that a click then paints, once its look-alikes are outlined."""
    at = person.page.evaluate("name => window.meshforgeViewport.project(name)", hull)
    name = hull.partition(" · ")[0]
    with person.page.expect_response(
        lambda one: one.url.endswith("/api/similar") and name in (one.request.post_data or "")
    ):
        person.page.mouse.move(at["x"], at["y"])
    with suppress(PlaywrightTimeout):  # there may be none
        person.page.wait_for_function(
            "count => window.meshforgeViewport.toPaint().length >= count", arg=least, timeout=1500
        )
    found: list[str] = person.page.evaluate("window.meshforgeViewport.toPaint()")
    return found
