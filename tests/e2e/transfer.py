"""Files into the page and out of it: what a person drops, and what the browser saves."""

from __future__ import annotations

from pathlib import Path

from playwright.sync_api import Download

from tests.e2e.hand import Hand


def drop(person: Hand, *paths: Path) -> None:
    """Drop files or folders of this machine on the page, as from a file manager."""
    session = person.page.context.new_cdp_session(person.page)
    data = {"items": [], "files": [str(path) for path in paths], "dragOperationsMask": 1}
    for kind in ("dragEnter", "dragOver", "drop"):
        session.send("Input.dispatchDragEvent", {"type": kind, "x": 400, "y": 500, "data": data})


def save(person: Hand, button: str, folder: Path) -> Path:
    """Press a button by the keyboard, and keep what the browser saves for it."""
    with person.page.expect_download() as found:
        person.page.get_by_role("button", name=button).focus()
        person.press("Enter")
    saved: Download = found.value
    assert "token" not in saved.url
    path = folder / saved.suggested_filename
    saved.save_as(path)
    return path
