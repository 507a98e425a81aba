"""A studio's server and a headless Chromium with software rendering, for as long as a measurement takes."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from playwright.sync_api import Browser, sync_playwright

FLAGS = (
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-quic",
    "--disable-sync",
    "--no-first-run",
)
WATCH = """
window.watched = { ready: {}, keys: [] };
new MutationObserver(() => {
  const id = document.querySelector('[data-testid=viewport]')?.getAttribute('data-ready');
  if (id && !(id in window.watched.ready)) window.watched.ready[id] = performance.now();
}).observe(document, { subtree: true, attributes: true, childList: true, attributeFilter: ['data-ready'] });
addEventListener('keydown', () => window.watched.keys.push(performance.now()), true);
"""
"""Notes when an asset's first frame was drawn, and when keys were pressed [ms since the page was asked for]."""


@contextmanager
def studio(project: Path) -> Iterator[str]:
    """The address of a studio that serves a project."""
    command = [str(Path(sys.executable).with_name("meshforge")), "studio", str(project), "--no-browser"]
    server = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
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
