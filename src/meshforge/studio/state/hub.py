"""The pages that are open, and what each is still to be told, in order."""

from __future__ import annotations

import asyncio
from contextlib import suppress
from threading import Lock

from meshforge.studio.wire.base import Wire

BEHIND = 2000
"""Events that a page may be behind; one that is farther behind is closed, and connects anew with one `Hello`."""


class Page:
    """One open page. Its queue ends with None where the connection is to be closed."""

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        self.events: asyncio.Queue[str | None] = asyncio.Queue()
        self._loop = loop

    def send(self, text: str | None) -> None:
        """Add to what it is told; from any thread."""
        with suppress(RuntimeError):  # the studio is closed, and its loop with it
            self._loop.call_soon_threadsafe(self._put, text)

    def _put(self, text: str | None) -> None:
        self.events.put_nowait(None if self.events.qsize() > BEHIND else text)


class Hub:
    """All open pages."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._pages: dict[Page, None] = {}

    def join(self, page: Page, hello: Wire) -> None:
        """Add a page, which is told `hello` first, then everything that comes after that."""
        with self._lock:
            page.send(hello.model_dump_json())
            self._pages[page] = None

    def leave(self, page: Page) -> None:
        """A page is no more."""
        with self._lock:
            self._pages.pop(page, None)

    def broadcast(self, event: Wire) -> None:
        """Tell all pages; from any thread."""
        with self._lock:
            pages = list(self._pages)
            if pages:
                text = event.model_dump_json()
                for page in pages:
                    page.send(text)

    def close(self) -> None:
        """End all connections."""
        with self._lock:
            for page in self._pages:
                page.send(None)
