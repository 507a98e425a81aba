"""What the browser saves from the Export panel, opened again: a zip of the results, the report."""

from __future__ import annotations

from pathlib import Path
from zipfile import ZipFile

import pytest
import trimesh
from playwright.sync_api import Browser

from meshforge.formats import load
from tests.e2e.transfer import save
from tests.e2e.walk import visiting
from tests.unit.project.tables import FIRST, SECOND, THIRD, applied


def test_results_and_report_are_saved_by_the_browser_and_can_be_opened(tmp_path: Path, browser: Browser) -> None:
    project = applied(tmp_path)
    project.set_verdict([FIRST, SECOND], "accepted")
    project.set_verdict([THIRD], "wrong")
    with visiting(tmp_path, project, browser) as (_, person):
        person.press("Alt+4")
        person.click(person.page.get_by_role("radio", name="Export"))

        zipped = save(person, "Download the results", tmp_path)
        assert zipped.name == "tables-results.zip"
        person.sees("2 of 3 results; not in it: 1 ")
        with ZipFile(zipped) as archive:
            archive.extractall(tmp_path / "results")
        assert not (tmp_path / "results" / THIRD).exists()
        for asset in (FIRST, SECOND):
            loaded = trimesh.load_scene(tmp_path / "results" / asset).to_mesh()
            output = load(project.layout.edited / asset)
            assert len(loaded.faces) >= 12 * len(output.hulls) > 12
            assert output.aabb and loaded.extents == pytest.approx(output.aabb.max - output.aabb.min)
            assert (tmp_path / "results" / asset).read_bytes() == (project.layout.edited / asset).read_bytes()

        report = save(person, "Download the report", tmp_path)
        page = browser.new_page()
        page.goto(report.as_uri())
        shown = page.locator("body").inner_text()
        assert all(asset in shown for asset in (FIRST, SECOND, THIRD))
        assert page.locator("img").count() >= 6
        page.close()

        assert person.page.evaluate("document.activeElement.ariaLabel") == "Download the report", "the focus stays"
        assert save(person, "Save again", tmp_path).name == "tables-report.html"
