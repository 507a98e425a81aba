"""Pictures of the studio for the documentation: its page in a real Chromium, on the bundled tables and cups."""

from __future__ import annotations

import shutil
import sys
import tempfile
from pathlib import Path
from typing import Literal

from playwright.sync_api import Browser, Page

from benchmark.studio.browser import chromium, studio
from meshforge.cli.demo import create_tables, open_tables
from meshforge.language import Delete, Replace
from meshforge.project import Project
from meshforge.project.demonstrations import demonstrate
from meshforge.samples import TABLES, family_of
from meshforge.symbolic import read_labels
from meshforge.synthesis import Step
from script.pictures import BY_HAND

SIZE = (1440, 900)


def main(folder: Path) -> None:
    """Write the pictures into a folder."""
    with tempfile.TemporaryDirectory() as scratch, chromium() as browser:
        project = open_tables(Path(scratch) / "one")
        shutil.copytree(TABLES / "demonstrations", project.folder / "demonstrations")
        (project.folder / "demonstrations" / "table_08.obj.json").unlink()
        with studio(project.folder) as address:
            _show_demonstration(_page(browser, address, "light"), folder / "studio.png")
            _show_question(_page(browser, address, "light"), folder / "studio-learn.png")
        project = open_tables(Path(scratch) / "four")
        _show_first_steps(project)
        with studio(project.folder) as address:
            _show_question(_page(browser, address, "dark"), folder / "studio-signoff.png")
        with studio(_prepare_project(Path(scratch) / "three").folder) as address:
            _show_labels(_page(browser, address, "light"), folder / "studio-label.png")
        project = create_tables(Path(scratch) / "two")
        project.synthesize()
        list(project.apply())
        with studio(project.folder) as address:
            _show_review(_page(browser, address, "dark"), folder / "studio-review.png")


def _show_first_steps(project: Project) -> None:
    """Two steps on two tables without a shelf, of which a program is learned that takes shelves for table tops."""
    for asset in ("table_01.obj", "table_02.obj"):
        mesh = project.mesh(asset)
        named = {name: frozenset(hull.name for hull in mesh.hulls if hull.label == name) for name in ("misc", "panel")}
        steps = (Step(1, named["misc"], Delete()), Step(2, named["panel"], Replace("box")))
        demonstrate(project, asset, steps)


def _prepare_project(folder: Path) -> Project:
    """The tables without the labels beside them, of which one is labelled by hand."""
    (folder / "assets").mkdir(parents=True)
    assets = [shutil.copy2(asset, folder / "assets") for asset in sorted(TABLES.glob("*.obj"))]
    project = Project.create(folder / "project", assets, vocabulary=family_of("tables").vocabulary)
    true = read_labels(TABLES / f"{BY_HAND[0]}.labels.json").labels
    project.set_labels(f"{BY_HAND[0]}.obj", {hull: label.name for hull, label in true.items()})
    return project


def _page(browser: Browser, address: str, theme: Literal["light", "dark"]) -> Page:
    """An open page, when all thumbnails are drawn and learning is over."""
    width, height = SIZE
    context = browser.new_context(viewport={"width": width, "height": height}, color_scheme=theme)
    page = context.new_page()
    page.goto(address)
    page.wait_for_function("() => document.querySelector('[data-testid=viewport]')?.dataset.ready")
    page.wait_for_timeout(9000)
    return page


def _show_labels(page: Page, path: Path) -> None:
    """What the labels of one table gave on the others, at the hull that is least sure."""
    page.keyboard.press("Alt+1")
    page.keyboard.press("p")
    page.get_by_text("All labels by source").first.wait_for()
    page.wait_for_timeout(5000)
    page.keyboard.press("n")
    page.wait_for_timeout(3000)
    page.screenshot(path=path)


def _show_demonstration(page: Page, path: Path) -> None:
    """The second table, with what is guessed of the second step in hand."""
    page.keyboard.press("Alt+2")
    page.get_by_role("option", name="table_08.obj").first.click()
    page.get_by_role("button", name="Keep as step 1").wait_for()
    page.wait_for_timeout(3000)
    page.screenshot(path=path)


def _show_question(page: Page, path: Path) -> None:
    """A question, as pictures, beside the program; the view shows what it is about."""
    page.keyboard.press("Alt+3")
    page.get_by_role("heading", name="which hulls should rule").wait_for()
    page.keyboard.press("u")
    page.wait_for_timeout(4000)
    page.screenshot(path=path)


def _show_review(page: Page, path: Path) -> None:
    """Before and after, divided by the slider."""
    page.keyboard.press("Alt+4")
    page.get_by_role("option", name="table_11.obj").first.click()
    page.get_by_role("radio", name="Before and after with a line between them").click()
    page.wait_for_timeout(4000)
    page.screenshot(path=path)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
