"""Files into the page: what a person drops."""

from __future__ import annotations

from pathlib import Path

from tests.e2e.hand import Hand


def drop(person: Hand, *paths: Path) -> None:
    """Drop files or folders of this machine on the page, as from a file manager."""
    session = person.page.context.new_cdp_session(person.page)
    data = {"items": [], "files": [str(path) for path in paths], "dragOperationsMask": 1}
    for kind in ("dragEnter", "dragOver", "drop"):
        session.send("Input.dispatchDragEvent", {"type": kind, "x": 400, "y": 500, "data": data})
