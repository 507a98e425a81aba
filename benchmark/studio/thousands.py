"""A family of ten thousand assets: how soon the first picture is there, and how evenly the gallery scrolls."""

from __future__ import annotations

import statistics
import tempfile
from pathlib import Path

from playwright.sync_api import Browser, Page

from benchmark.report import Goal, Result, Table, Tell
from benchmark.studio.browser import DRAWN, chromium, open_asset, studio, watch_events
from benchmark.studio.families import project_of
from benchmark.studio.scrolling import SCROLL

HULLS = 4
SLOW = 1000 / 30
"""Milliseconds of a frame that is seen to stutter."""
_COUNT_UNREAD = watch_events(
    start="""
window.unread = -1;
const known = new Map();
""",
    event="""
for (const card of event.cards ?? []) known.set(card.asset, card.hulls !== null || card.error !== null);
if (event.cards) window.unread = [...known.values()].filter((read) => !read).length;
""",
)
"""Counts the assets that are not read yet."""
_WAIT_MINUTES = 20


def measure(tell: Tell, quick: bool) -> Result:
    """Open the family anew several times once it is read, then scroll from one end on."""
    assets = 200 if quick else 10_000
    with tempfile.TemporaryDirectory() as folder:
        tell(f"thousands: making {assets:,} assets")
        project = project_of(Path(folder), assets, HULLS)
        first = project.assets()[0]
        tell(f"thousands: {assets:,} assets are read")
        project.status()
        with studio(project.folder) as address, chromium() as browser:
            tell(f"thousands: the studio looks at {assets:,} assets")
            _wait_until_read(browser, address, first)
            times = []
            for turn in range(2 if quick else 5):
                tell(f"thousands: opened {turn} times")
                page = open_asset(browser, address, first)
                times.append(page.evaluate("id => window.watched.ready[id]", first))
                page.context.close()
            page = open_asset(browser, address, first)
            page.wait_for_timeout(3000)
            rows = list[tuple[str, float, float, float, float]]()
            for turn_name in ("thumbnails not drawn yet", "thumbnails drawn before"):
                tell(f"thousands: scrolling, {turn_name}")
                if rows:
                    _draw_up_to_here(page)
                page.evaluate("document.querySelector('[data-testid=family]').scrollTop = 0")
                gaps = page.evaluate(SCROLL, 2000 if quick else 10_000)
                slow = 100 * sum(gap > SLOW for gap in gaps) / len(gaps)
                rows.append((turn_name, 1000 / statistics.mean(gaps), statistics.median(gaps), max(gaps), slow))
                page.wait_for_timeout(3000)
    opening = statistics.median(times)
    columns = ("", "frames a second", "ms a frame, median", "longest, ms", "% of frames over 33 ms")
    return Result(
        "thousands",
        f"A family of {assets:,} assets",
        (
            Table("From the request to the first picture, ms", ("", "median", "slowest"), (("", opening, max(times)),)),
            Table("Scrolling, 1440 by 900", columns, tuple(rows)),
        ),
        (
            Goal("ms until the first picture, server warm", "at most", 2000, opening),
            Goal("frames a second while scrolling thumbnails drawn before", "at least", 55, rows[1][1]),
            Goal("% of frames over 33 ms while scrolling thumbnails drawn before", "at most", 1, rows[1][4]),
        ),
        (
            f"Assets of {HULLS} hulls; every asset was read once before the page was opened. Between the two rows each "
            "thumbnail was waited for; without that a part of them is drawn in the second row, too (2% over 33 ms).",
        ),
    )


def _draw_up_to_here(page: Page) -> None:
    """Waits screen by screen until all thumbnails from the first one on are drawn."""
    family = "document.querySelector('[data-testid=family]')"
    reached, height = page.evaluate(f"[{family}.scrollTop, {family}.clientHeight]")
    for top in range(0, int(reached) + int(height), int(height)):
        page.evaluate(f"{family}.scrollTop = {top}")
        page.wait_for_timeout(100)
        page.wait_for_function(DRAWN)


def _wait_until_read(browser: Browser, address: str, first: str) -> None:
    """Opens the studio until every asset is read."""
    page = open_asset(browser, address, first, _COUNT_UNREAD)
    page.wait_for_function("() => window.unread === 0", timeout=_WAIT_MINUTES * 60_000)
    page.context.close()
