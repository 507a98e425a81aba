"""A studio's server and a headless Chromium with software rendering, for as long as a measurement takes."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from playwright.sync_api import Browser, Page, sync_playwright

FLAGS = (
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    "--disable-gpu-compositing",  # as where there is no graphics card: only the view is drawn by way of OpenGL
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-quic",
    "--disable-sync",
    "--no-first-run",
)
PATIENCE = 180_000
"""Milliseconds that anything may take before a measurement gives up."""
WATCH = """
window.watched = { ready: {}, keys: [] };
new MutationObserver(() => {
  const id = document.querySelector('[data-testid=viewport]')?.getAttribute('data-ready');
  if (id && !(id in window.watched.ready)) window.watched.ready[id] = performance.now();
}).observe(document, { subtree: true, attributes: true, childList: true, attributeFilter: ['data-ready'] });
addEventListener('keydown', () => window.watched.keys.push(performance.now()), true);
"""
"""Notes when an asset's first frame was drawn, and when keys were pressed [ms since the page was asked for]."""


def watch_events(start: str, event: str) -> str:
    """A script for a page, before its own: `start` first, then `event` for each `event` that the server sends."""
    return f"""{start}
const Before = window.WebSocket;
window.WebSocket = class extends Before {{
  constructor(...given) {{
    super(...given);
    this.addEventListener('message', ({{ data }}) => {{
      const event = JSON.parse(data);
      {event}
    }});
  }}
}};
"""


@contextmanager
def studio(project: Path) -> Iterator[str]:
    """The address of a studio that serves a project, which the user's list of recent projects does not get."""
    command = [str(Path(sys.executable).with_name("meshforge")), "studio", str(project), "--no-browser"]
    with tempfile.TemporaryDirectory() as state:
        server = subprocess.Popen(
            command, stdout=subprocess.PIPE, text=True, env={**os.environ, "MESHFORGE_STATE": state}
        )
        assert server.stdout
        try:
            found = re.search(r"http://\S+", server.stdout.readline())
            assert found, "the studio does not tell its address"
            yield found[0]
        finally:
            server.terminate()
            server.wait(30)


@contextmanager
def chromium() -> Iterator[Browser]:
    """Debian's Chromium, or that of the variable CHROMIUM."""
    with sync_playwright() as tool:
        browser = tool.chromium.launch(
            executable_path=os.environ.get("CHROMIUM", "/usr/bin/chromium"), args=list(FLAGS)
        )
        yield browser
        browser.close()


def open_asset(browser: Browser, address: str, asset: str, watch: str = "") -> Page:
    """A page of a browser that knows nothing of the studio yet, once it shows an asset; watch: a script more."""
    page = browser.new_context(viewport={"width": 1440, "height": 900}).new_page()
    page.set_default_timeout(PATIENCE)
    page.add_init_script(WATCH + watch)
    page.goto(address)
    page.wait_for_function("id => id in window.watched.ready", arg=asset)
    return page


def warm(browser: Browser, address: str, asset: str) -> None:
    """Opens the studio once, until the pictures of the family are drawn: server and browser keep much from then on."""
    page = open_asset(browser, address, asset)
    page.wait_for_function(DRAWN)
    page.context.close()


DRAWN = """
() => {
  const pictures = [...document.querySelectorAll('[data-testid=family] [data-state]:has(> canvas)')];
  return pictures.length > 0 && pictures.every((picture) => picture.dataset.state === 'there');
}
"""
"""Whether all thumbnails in sight are drawn."""
