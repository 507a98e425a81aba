"""Frames: hovering, selecting and turning, on 60 and on 500 hulls."""

from __future__ import annotations

import statistics
import tempfile
from pathlib import Path

from playwright.sync_api import Page

from benchmark.report import Goal, Result, Table, Tell
from benchmark.studio.browser import chromium, open_asset, studio
from benchmark.studio.families import project_of

_ANSWER = """
async ([x, y]) => {
  const before = window.meshforgeViewport.frames();
  const began = performance.now();
  const target = document.elementFromPoint(x, y);
  const event = { bubbles: true, clientX: x, clientY: y, pointerId: 1, pointerType: 'mouse', isPrimary: true };
  target.dispatchEvent(new PointerEvent('pointermove', event));
  let waited = 0;
  while (window.meshforgeViewport.frames() === before && waited < 20) {
    await new Promise(requestAnimationFrame);
    waited += 1;
  }
  return [waited, performance.now() - began];
}
"""
"""Moves the pointer to a place and counts the frames of the page until the viewport has drawn what is new."""
_TURN = """
async (milliseconds) => {
  const canvas = document.querySelector('[data-testid=viewport] canvas');
  const box = canvas.getBoundingClientRect();
  const at = (type, x, buttons) => canvas.dispatchEvent(new PointerEvent(type, {
    bubbles: true, clientX: box.x + x, clientY: box.y + 12, pointerId: 1, pointerType: 'mouse', isPrimary: true,
    button: type === 'pointermove' ? -1 : 1, buttons,
  }));
  at('pointerdown', 20, 4);
  const first = window.meshforgeViewport.frames();
  const began = performance.now();
  let x = 20;
  while (performance.now() - began < milliseconds) {
    at('pointermove', x = 20 + (x + 5) % 600, 4);
    await new Promise(requestAnimationFrame);
  }
  at('pointerup', x, 0);
  return (window.meshforgeViewport.frames() - first) / ((performance.now() - began) / 1000);
}
"""
"""Turns the camera by dragging with the middle button, and gives frames drawn a second."""


def measure(tell: Tell, quick: bool) -> Result:
    """Hover over hulls and turn the camera on two assets."""
    rows = []
    for hulls in (60, 500):
        tell(f"moving: {hulls} hulls")
        with tempfile.TemporaryDirectory() as folder:
            project = project_of(Path(folder), 1, hulls)
            with studio(project.folder) as address, chromium() as browser:
                page = open_asset(browser, address, project.assets()[0])
                page.wait_for_timeout(1500)
                frames, milliseconds = _hover(page, hulls, 10 if quick else 60)
                rows.append((f"{hulls} hulls", frames, milliseconds, page.evaluate(_TURN, 1000 if quick else 4000)))
    columns = ("", "frames until a hover shows", "ms until then", "frames a second while turning")
    return Result(
        "moving",
        "Hovering and turning",
        (Table("Medians, 1440 by 900", columns, tuple(rows)),),
        (
            Goal("frames until a hover shows, 60 hulls", "at most", 1, rows[0][1]),
            Goal("frames until a hover shows, 500 hulls", "at most", 1, rows[1][1]),
            Goal("frames a second while turning 500 hulls, software rendering", "at least", 20, rows[1][3]),
        ),
        ("SwiftShader renders on the processor; a graphics card was not there to measure 60 frames a second on.",),
    )


def _hover(page: Page, hulls: int, wanted: int) -> tuple[float, float]:
    """The medians of frames and of milliseconds until hulls under the pointer are marked."""
    found = []
    for k in range(hulls):
        place = page.evaluate("name => window.meshforgeViewport.project(name)", f"part_{k:03}")
        if place:
            found.append(page.evaluate(_ANSWER, [place["x"], place["y"]]))
        if len(found) == wanted:
            break
    return statistics.median(f[0] for f in found), statistics.median(f[1] for f in found)
