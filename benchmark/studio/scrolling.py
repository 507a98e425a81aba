"""Scrolling a gallery of a thousand thumbnails."""

from __future__ import annotations

import statistics
import tempfile
from pathlib import Path

from benchmark.report import Goal, Result, Table, Tell
from benchmark.studio.browser import chromium, open_asset, studio
from benchmark.studio.families import project_of

SCROLL = """
async (milliseconds) => {
  const gallery = document.querySelector('[data-testid=family]');
  const gaps = [];
  const began = performance.now();
  let last = began;
  while (last - began < milliseconds) {
    gallery.scrollTop += 24;
    await new Promise(requestAnimationFrame);
    const now = performance.now();
    gaps.push(now - last);
    last = now;
  }
  return gaps;
}
"""
"""Scrolls on at each frame, about eight rows of thumbnails a second, and gives the time of each frame."""


def measure(tell: Tell, quick: bool) -> Result:
    """Scroll through the family as fast as a person does, twice: thumbnails to be drawn first, then drawn already."""
    assets = 100 if quick else 1000
    with tempfile.TemporaryDirectory() as folder:
        tell(f"scrolling: making {assets} assets")
        project = project_of(Path(folder), assets, 12)
        with studio(project.folder) as address, chromium() as browser:
            page = open_asset(browser, address, project.assets()[0])
            page.wait_for_timeout(3000 if quick else 30_000)
            rows = []
            for turn in ("thumbnails not drawn yet", "thumbnails drawn before"):
                tell(f"scrolling: {turn}")
                page.evaluate("document.querySelector('[data-testid=family]').scrollTop = 0")
                gaps = page.evaluate(SCROLL, 2000 if quick else 8000)
                slow = sum(gap > 50 for gap in gaps) / len(gaps)
                rows.append((turn, 1000 / statistics.mean(gaps), statistics.median(gaps), max(gaps), 100 * slow))
                page.wait_for_timeout(3000)
    columns = ("", "frames a second", "ms a frame, median", "longest, ms", "% of frames over 50 ms")
    return Result(
        "scrolling",
        f"Scrolling {assets:,} thumbnails",
        (Table("1440 by 900", columns, tuple(rows)),),
        (Goal("frames a second while scrolling thumbnails drawn before", "at least", 30, rows[1][1]),),
    )
