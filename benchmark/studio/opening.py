"""How long it takes until an asset is seen, and until the next one is."""

from __future__ import annotations

import statistics
import tempfile
from pathlib import Path

from playwright.sync_api import Browser

from benchmark.report import Goal, Result, Table, Tell
from benchmark.studio.browser import chromium, open_asset, studio, warm
from benchmark.studio.families import project_of

HULLS, ASSETS = 60, 12
FAMILY, FAMILY_HULLS = 70, 24
"""A family of usual size, of assets of usual size."""


def measure(tell: Tell, quick: bool) -> Result:
    """Open the page anew several times; then go from asset to asset by Tab."""
    with tempfile.TemporaryDirectory() as folder:
        project = project_of(Path(folder), ASSETS, HULLS)
        first = project.assets()[0]
        with studio(project.folder) as address, chromium() as browser:
            warm(browser, address, first)
            times = [_open(browser, address, first) for _ in range(2 if quick else 7)]
            tell(f"opening: {len(times)} times opened")
            switches = _switch(browser, address, project.assets(), tell)
    turns = _switch_in_family(tell, quick)
    opening, switching, turning = statistics.median(times), statistics.median(switches), statistics.median(turns)
    rows = (
        (f"first picture of {HULLS} hulls after opening", opening, max(times)),
        ("next asset after Tab", switching, max(switches)),
        (f"next asset after Tab, {FAMILY} assets of {FAMILY_HULLS} hulls", turning, max(turns)),
    )
    return Result(
        "opening",
        "Opening the studio, and going from asset to asset",
        (Table("From the request or the key to the drawn frame, ms", ("", "median", "slowest"), rows),),
        (
            Goal(f"ms until the first picture of {HULLS} hulls, server warm", "at most", 1500, opening),
            Goal("ms until the next asset is drawn", "at most", 150, switching),
            Goal(f"ms until the next asset is drawn, {FAMILY} assets", "at most", 60, turning),
        ),
        (
            "Headless Chromium with software rendering; the page's own time, from the start of its navigation. "
            "The studio was opened once before; each page starts with an empty cache.",
        ),
    )


def _switch_in_family(tell: Tell, quick: bool) -> list[float]:
    """From asset to asset in a family of usual size, whose pictures are drawn."""
    with tempfile.TemporaryDirectory() as folder:
        project = project_of(Path(folder), FAMILY, FAMILY_HULLS)
        assets = project.assets()[: 5 if quick else FAMILY]
        with studio(project.folder) as address, chromium() as browser:
            warm(browser, address, assets[0])
            return _switch(browser, address, assets, tell)


def _open(browser: Browser, address: str, asset: str) -> float:
    page = open_asset(browser, address, asset)
    milliseconds: float = page.evaluate("id => window.watched.ready[id]", asset)
    page.context.close()
    return milliseconds


def _switch(browser: Browser, address: str, assets: tuple[str, ...], tell: Tell) -> list[float]:
    page = open_asset(browser, address, assets[0])
    times = []
    for asset in assets[1:]:
        page.wait_for_timeout(400)  # a person looks, and the next asset is fetched meanwhile
        page.keyboard.press("Tab")
        page.wait_for_function("id => id in window.watched.ready", arg=asset)
        times.append(page.evaluate("id => window.watched.ready[id] - window.watched.keys.at(-1)", asset))
        tell(f"opening: {len(times)} assets switched to")
    return times
