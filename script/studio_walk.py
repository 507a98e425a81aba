"""A newcomer's walk through the studio, from a folder without labels to signed off, as one sheet of pictures.

Run as `python -m script.studio_walk FILE`; the walk is written down in docs/walk.md.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from itertools import product
from pathlib import Path

from PIL import Image
from playwright.sync_api import Browser, Page

from benchmark.studio.browser import chromium
from meshforge.samples import TABLES

WINDOWS = ((1024, 768), (1440, 900), (1920, 1080))
ASSET, LEG = "table_01.obj", "convex_10"
WIDTH = 560
"""Pixels of a picture on the sheet."""


def main(file: Path) -> None:
    """Write the sheet: a row for each window and theme, a column for each step."""
    pictures = []
    with tempfile.TemporaryDirectory() as scratch, chromium() as browser:
        folder = Path(scratch) / "tables"
        folder.mkdir()
        for asset in sorted(TABLES.glob("*.obj"))[:8]:
            shutil.copy(asset, folder)
        for k, (size, theme) in enumerate(product(WINDOWS, ("light", "dark"))):
            place = Path(scratch) / str(k)
            place.mkdir()
            pictures.append([_shrink(path) for path in _walk(browser, size, theme, folder, place)])
    heights = [max(one.height for one in row) for row in pictures]
    sheet = Image.new("RGB", (WIDTH * len(pictures[0]), sum(heights)), "white")
    for k, row in enumerate(pictures):
        for j, one in enumerate(row):
            sheet.paste(one, (j * WIDTH, sum(heights[:k])))
    sheet.save(file, quality=72, optimize=True)


def _shrink(path: Path) -> Image.Image:
    picture = Image.open(path).convert("RGB")
    return picture.resize((WIDTH, picture.height * WIDTH // picture.width), Image.Resampling.LANCZOS)


def _walk(browser: Browser, size: tuple[int, int], theme: str, folder: Path, place: Path) -> list[Path]:
    command = [sys.executable, "-m", "meshforge", "studio", "--no-browser"]
    environment = os.environ | {"MESHFORGE_STATE": str(place / "state")}
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=place, env=environment)
    try:
        assert process.stdout
        address = process.stdout.readline().removeprefix("Studio: ").strip()
        page = browser.new_context(
            viewport={"width": size[0], "height": size[1]}, color_scheme="dark" if theme == "dark" else "light"
        ).new_page()
        page.goto(address)
        steps = [_start, _look, _select, _preview, _ask, _sign_off]
        return [_photograph(page, step, folder, place / f"{k}.png") for k, step in enumerate(steps)]
    finally:
        process.terminate()
        process.wait()


def _photograph(page: Page, step: Callable[[Page, Path], None], folder: Path, path: Path) -> Path:
    step(page, folder)
    page.wait_for_timeout(2500)
    page.screenshot(path=path)
    return path


def _start(page: Page, _: Path) -> None:
    page.get_by_role("heading", name="New project").wait_for()


def _look(page: Page, folder: Path) -> None:
    page.get_by_label("Folder of assets", exact=True).fill(str(folder))
    page.keyboard.press("Enter")
    page.get_by_role("button", name="Make the project").wait_for()


def _select(page: Page, _: Path) -> None:
    page.get_by_role("button", name="Make the project").click()
    page.wait_for_function("() => document.querySelector('[data-testid=viewport]')?.dataset.ready")
    page.keyboard.press("Alt+2")
    page.get_by_role("option", name=ASSET).first.click()
    page.wait_for_function(f"() => document.querySelector('[data-testid=viewport]')?.dataset.ready === '{ASSET}'")
    page.wait_for_timeout(2000)
    at = page.evaluate(f"window.meshforgeViewport.project('{LEG}')")
    page.mouse.click(at["x"], at["y"])
    page.keyboard.press("j")


def _preview(page: Page, _: Path) -> None:
    page.keyboard.press("r")
    page.wait_for_timeout(1500)


def _ask(page: Page, _: Path) -> None:
    page.keyboard.press("e")
    page.keyboard.press("Enter")
    page.wait_for_timeout(6000)
    page.keyboard.press("u")
    page.wait_for_timeout(2000)


def _sign_off(page: Page, _: Path) -> None:
    for _turn in range(12):
        if page.get_by_text("Nothing is left to ask").count():
            break
        page.keyboard.press("u")
        page.keyboard.press("y")
        page.wait_for_timeout(1500)
    page.keyboard.press("Alt+4")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
