"""How long it takes until what is learned follows a change that a person makes."""

from __future__ import annotations

import json
import statistics
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import httpx
from playwright.sync_api import Page
from websockets.sync.client import connect
from websockets.typing import Subprotocol

from benchmark.report import Goal, Result, Table, Tell
from benchmark.studio.browser import chromium, open_asset, studio, watch_events
from meshforge.cli.demo import create_tables
from meshforge.studio.api.connection import PROTOCOL

OPEN, SHOWN = "table_05.obj", "table_08.obj"
"""A table of which nothing is shown, and one that demonstrates."""
OUTCOMES = watch_events(
    start="""
window.outcomes = [];
""",
    event="""
if (event.kind === 'outcome' && !event.learning) requestAnimationFrame(() => outcomes.push(performance.now()));
""",
)
"""Notes when what was learned is on the page [ms since the page was asked for]."""

Change = Callable[[], None]


def measure(tell: Tell, quick: bool) -> Result:
    """On the bundled tables, of which two show five rules: change a label, or a step, and wait for the outcome."""
    turns = 2 if quick else 10
    with tempfile.TemporaryDirectory() as folder:
        project = create_tables(Path(folder) / "tables")
        with studio(project.folder) as address:
            with chromium() as browser:
                page = open_asset(browser, address, project.assets()[0], OUTCOMES)
                page.wait_for_timeout(4000)  # the first outcome is longer than those that are measured
                rows = []
                for what, changes in (
                    ("a label on a table of which nothing is shown", _labels(page, OPEN)),
                    ("a label on a table that demonstrates", _labels(page, SHOWN)),
                    ("a step taken away, and put back", _steps(page, SHOWN)),
                ):
                    tell(f"relearning: {what}")
                    rows.append(_row(what, [_time_learning(page, next(changes)) for _ in range(2 * turns)]))
            tell("relearning: without a browser")
            bare = _row("a label, told to a client that draws nothing", _time_answers(address, 2 * turns))
    return Result(
        "relearning",
        "Learning anew while a person works",
        (Table("From the key to the program on the page, ms", ("", "median", "slowest"), (*rows, bare)),),
        (Goal("ms from a changed label to what is learned from it, nothing drawn beside", "at most", 200, bare[1]),),
        (
            "Fourteen tables, two demonstrations of five rules; every other change takes back the one before. "
            "In the browser the picture is drawn anew at the same time, by the same two cores that learn; "
            "the last row is what is left where a graphics card draws.",
        ),
    )


def _row(what: str, times: list[float]) -> tuple[str, float, float]:
    return what, statistics.median(times), max(times)


def _time_answers(address: str, turns: int) -> list[float]:
    """From the request to the outcome, at a client without a picture [ms]."""
    base, _, token = address.partition("/?token=")
    headers, times = {"Authorization": f"Bearer {token}"}, []
    offered = [Subprotocol(PROTOCOL), Subprotocol(token)]
    with (
        connect(f"{base.replace('http', 'ws')}/ws", subprotocols=offered, max_size=None) as socket,
        httpx.Client(base_url=base, headers=headers, timeout=60) as client,
    ):
        for turn in range(turns):
            time.sleep(0.5)
            began = time.perf_counter()
            label = ("misc", "panel")[turn % 2]
            edit = {"kind": "label", "hulls": {OPEN: ["convex_02"]}, "label": label}
            client.post("/api/edit", json=edit).raise_for_status()
            while not _is_outcome(json.loads(socket.recv())):
                pass
            times.append(1000 * (time.perf_counter() - began))
    return times


def _is_outcome(event: dict[str, Any]) -> bool:
    return event["kind"] == "outcome" and not event["learning"]


def _labels(page: Page, asset: str) -> Iterator[Change]:
    """A hull gets another label, and its own again."""
    page.keyboard.press("Alt+1")
    _open(page, asset)
    row = page.locator('[role=row][data-name="convex_02"]')
    row.scroll_into_view_if_needed()
    while True:
        row.click()
        yield lambda: page.keyboard.press("5")
        yield lambda: page.keyboard.press("Control+z")


def _steps(page: Page, asset: str) -> Iterator[Change]:
    """The last step is taken away and comes back."""
    page.keyboard.press("Alt+2")
    _open(page, asset)
    while True:
        yield lambda: page.keyboard.press("Backspace")
        yield lambda: page.keyboard.press("Control+z")


def _open(page: Page, asset: str) -> None:
    page.get_by_role("option", name=asset).first.click()
    page.wait_for_function("id => id in window.watched.ready", arg=asset)


def _time_learning(page: Page, change: Change) -> float:
    """The time from the key of a change to the outcome [ms]."""
    page.wait_for_timeout(500)  # a person looks
    before = page.evaluate("() => window.outcomes.length")
    change()
    page.wait_for_function("count => window.outcomes.length > count", arg=before)
    milliseconds: float = page.evaluate("() => window.outcomes.at(-1) - window.watched.keys.at(-1)")
    return milliseconds
