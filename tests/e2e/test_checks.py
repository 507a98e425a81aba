"""Results measured in the review: what is found, where, whose limits count, and the whole family, worst first."""

from __future__ import annotations

import re
from pathlib import Path

from playwright.sync_api import Browser

from tests.cup_project import BARE, CUP, cup_project
from tests.e2e.studio import ok, opened
from tests.e2e.walk import go_to, visiting


def test_a_filled_cup_is_found_shown_and_sorted_first(tmp_path: Path, browser: Browser) -> None:
    project = cup_project(tmp_path)
    with visiting(tmp_path, project, browser) as (_, person):
        person.press("Alt+4")
        go_to(person, CUP)
        person.press("Shift+C")
        fit = person.region("Fit to what is seen")
        fit.get_by_role("row", name=re.compile("Hulls stick out, at most 0 m 0.0397 m")).wait_for()
        person.click(fit.get_by_role("button", name=re.compile("Sticks out")))
        assert person.page.get_by_test_id("selection").inner_text().startswith("1 selected")
        person.click(fit.get_by_role("button", name="Show where"))
        fit.get_by_role("img", name="Hulls stick out by 0.0397 m at most.").wait_for()
        limits = person.region("Limits of an engine")
        person.click(limits.get_by_role("button", name="Limits of no engine"))
        person.click(person.page.get_by_role("menuitem", name="Unity"))
        limits.get_by_text("Within all of them.").wait_for()

        go_to(person, BARE)
        fit.get_by_text("Nothing is shown").wait_for()
        person.region("Free space").get_by_role("row", name=re.compile("Closed by the edit 0.558 l")).wait_for()

        person.click(person.page.get_by_role("radio", name="All results"))
        person.press("Control+K")
        person.type("check all")
        person.press("Enter")
        person.click(person.page.get_by_role("button", name="All are checked: worst first in the family"))
        cards = person.page.get_by_test_id("family").get_by_role("option")
        person.page.wait_for_function(
            "first => document.querySelector('[data-testid=family] [role=option]')?.dataset.asset === first", arg=CUP
        )
        assert "findings of the checks" in (cards.first.text_content() or "")
        person.page.reload()
        person.drawn()
        cards.and_(person.page.get_by_title(re.compile("findings? of the checks, by the edit"))).first.wait_for()


def test_a_check_that_cannot_be_made_says_why(tmp_path: Path) -> None:
    project = cup_project(tmp_path)
    with opened(tmp_path, project.folder) as studio:
        studio.settled()
        assert ok(studio.get("/api/checked", asset=CUP, part="engines"))["part"] == "engines"
        (project.layout.edited / CUP).write_text("<robot/>")
        (project.folder / ".meshforge" / "studio" / "checks").rename(tmp_path / "gone")
        refused = studio.get("/api/checked", asset=CUP, part="engines")
        assert refused.status_code == 400 and "gone or changed" in refused.json()["message"]
        with studio.page() as page:
            assert page.hello
            job = page.job(ok(studio.post("/api/jobs", {"kind": "check"}))["id"])
        assert {line["asset"]: line["status"] for line in job["lines"]} == {CUP: "failed", BARE: "done"}
        assert "1 could not be checked" in job["message"]
        assert studio.get("/api/checked", asset="no.urdf", part="fit").status_code == 404
