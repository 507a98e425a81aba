"""How long it takes until a reply to a card, which labels a group of hulls, shows on all thumbnails of a family."""

from __future__ import annotations

import shutil
import statistics
import tempfile
from pathlib import Path

from playwright.sync_api import Page

from benchmark.report import Goal, Result, Table, Tell
from benchmark.studio.browser import chromium, open_asset, studio, watch_events
from meshforge.project import Project
from meshforge.samples import TABLES

ASSETS = 75
HULL = "convex_02"
"""A hull that every table has, and that no demonstration is about."""
_WATCH = watch_events(
    start="""
window.shown = { cards: new Set(), reach: 0 };
""",
    event="""
if (event.kind === 'cards') for (const card of event.cards) window.shown.cards.add(card.asset);
if (event.kind === 'reach' && event.reach.length) window.shown.reach += 1;
""",
)
"""Notes which cards came anew, and how often what the program does on all assets came."""
_REPLY = """
async ([token, edit, patience]) => {
  const frame = () => new Promise(requestAnimationFrame);
  const wanted = new Set(Object.keys(edit.hulls));
  window.shown = { cards: new Set(), reach: 0 };
  const began = performance.now();
  const headers = { 'Content-Type': 'application/json', Authorization: `Bearer ${token}` };
  const sending = fetch('api/edit', { method: 'POST', headers, body: JSON.stringify(edit) });
  const until = async (holds) => {
    while (!holds()) {
      if (performance.now() - began > patience) throw new Error('nothing came of it');
      await frame();
    }
    await frame();
    return performance.now() - began;
  };
  const labels = await until(() => [...wanted].every((asset) => window.shown.cards.has(asset)));
  const answer = await sending;
  if (!answer.ok) throw new Error(await answer.text());
  const written = performance.now() - began;
  const reach = await until(() => window.shown.reach > 0);
  return [labels, written, reach];
}
"""
"""Replies as the card does; ms until thumbnails show the labels, until these are on disk, and until thumbnails show
what the program does."""


def measure(tell: Tell, quick: bool) -> Result:
    """On copies of the bundled tables: a reply labels one hull on each, the next one takes that back."""
    with tempfile.TemporaryDirectory() as folder:
        tell(f"replies: making {ASSETS} tables")
        project = _family(Path(folder))
        shown = set(project.layout.demonstration.ids)
        named = [asset for asset in project.assets() if asset not in shown]
        with studio(project.folder) as address, chromium() as browser:
            page = open_asset(browser, address, project.assets()[0], _WATCH)
            page.wait_for_function("() => window.shown.reach > 0")
            page.wait_for_timeout(5000 if quick else 20_000)  # thumbnails are drawn, and how sure all is worked out
            found = []
            for turn in range(2 if quick else 10):
                tell(f"replies: {turn} measured")
                found.append(_reply(page, address, named, ("misc", "panel")[turn % 2]))
                page.wait_for_timeout(3000)
    what = ("all thumbnails show its labels", "these are on disk", "all thumbnails show what the program does")
    rows = tuple((w, statistics.median(t), max(t)) for w, t in zip(what, zip(*found, strict=True), strict=True))
    middle = rows[0][1]
    return Result(
        "replies",
        f"A reply to a card, on {ASSETS} assets",
        (Table("From the reply until ..., ms", ("", "median", "slowest"), rows),),
        (Goal(f"ms until a reply shows on all thumbnails, {ASSETS} assets", "at most", 500, middle),),
        (f"Each reply labels one hull on {len(named)} assets; two others demonstrate five rules.",),
    )


def _reply(page: Page, address: str, assets: list[str], label: str) -> list[float]:
    edit = {"kind": "label", "label": label, "hulls": {asset: [HULL] for asset in assets}}
    times: list[float] = page.evaluate(_REPLY, [address.partition("token=")[2], edit, 120_000])
    return times


def _family(folder: Path) -> Project:
    """The bundled tables with copies of them, labelled, and demonstrated on two."""
    sources = sorted(TABLES.glob("table_*.obj"))
    (folder / "assets").mkdir()
    for number in range(ASSETS):
        source, copy = sources[number % len(sources)], number // len(sources)
        name = f"{source.stem}_copy{copy}" if copy else source.stem
        for file in TABLES.glob(f"{source.stem}.*"):
            shutil.copyfile(file, folder / "assets" / f"{name}{file.name.removeprefix(source.stem)}")
    words, orient = ("panel", "leg", "handle", "drawer", "misc"), "+Z: Is(leg) -> Is(panel)"
    project = Project.create(
        folder / "project", [folder / "assets" / "*.obj"], name="tables", vocabulary=words, orient=orient
    )
    for part in ("templates", "demonstrations"):
        shutil.copytree(TABLES / part, project.folder / part)
    project.label("file")
    return project
