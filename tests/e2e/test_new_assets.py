"""Assets that came to a project after the others were prepared, in the studio: a run prepares them first."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from playwright.sync_api import Browser

from meshforge.batch import IN_PROCESS, read_stamp
from meshforge.language import Program
from meshforge.project import Project, RebuildSettings
from tests.e2e.studio import ok, opened
from tests.e2e.walk import visiting
from tests.unit.project.stools import boxes, coarse, create_stools, write_stool


@pytest.fixture
def project(tmp_path: Path) -> Project:
    """Two labelled stools, both looked at, with a program; two more came later, whose first hull spans two parts."""
    project = create_stools(tmp_path, {"a": (0.2, 0.4), "b": (0.22, 0.45)}, "")
    list(project.rebuild_spanning(how=RebuildSettings(0.7), execution=IN_PROCESS))
    project.write_program(Program.parse("Is(leg) => Each(Replace(box))"))
    for name, width in (("c", 0.18), ("d", 0.21)):
        parts = boxes(width, 0.4)
        write_stool(tmp_path / "assets", name, parts, coarse(parts))
    return Project.open(project.folder)


def test_a_run_rebuilds_bodies_of_new_assets_undo_undoes(project: Project, tmp_path: Path, browser: Browser) -> None:
    shutil.copytree(project.folder, tmp_path / "by_command")
    with visiting(tmp_path, project, browser) as (studio, person):
        person.press("Alt+4")
        person.sees("2 assets are new, and prepared first as the others were.")
        assert person.page.get_by_role(
            "checkbox", name="Rebuild their bodies where a hull spans parts, from 70% on"
        ).is_checked()
        person.click("Apply to all")
        person.sees("2 bodies of new assets rebuilt (c.urdf, d.urdf).")
        lines = person.page.get_by_role("list", name="Results by asset").get_by_role("listitem")
        texts = lines.all_inner_texts()
        assert [text.split()[1] for text in texts] == ["c", "d"]  # what tells them apart
        assert all("base/h0 holds seat and leg, " in text and "base rebuilt into " in text for text in texts)
        assert not person.page.get_by_text("are new").count()
        by_command = Project.open(tmp_path / "by_command")
        list(by_command.prepare_new())
        for asset in ("c.urdf", "d.urdf"):
            assert [hull.label for hull in project.mesh(asset).hulls] == [h.label for h in by_command.mesh(asset).hulls]
            stamp = read_stamp(project.layout.edited, asset)
            assert stamp and any("base rebuilt into " in note for note in stamp.notes)
        person.press("Control+z")
        person.page.wait_for_function("() => !document.querySelector('[aria-label^=\"Undo: \"]')")
        assert not project.layout.preparation.ids and not project.layout.labels("c.urdf").exists()
        hello = studio.settled()
        assert hello["project"]["new"] is None, "what was taken back is not done again"


def test_hulls_of_new_assets_stay_as_they_are_where_that_is_chosen(project: Project, tmp_path: Path) -> None:
    (tmp_path / "assets" / "d.urdf").write_text("<robot")
    with opened(tmp_path, project.folder) as studio, studio.page() as page:
        new = studio.settled()["project"]["new"]
        assert (new["ids"], new["rebuilt"], new["min_confidence"]) == (["c.urdf", "d.urdf"], 2, 0.7)
        job = page.job(ok(studio.post("/api/jobs", {"kind": "apply", "rebuild": False}))["id"])
        lines = {line["asset"]: line for line in job["lines"]}
        assert "it could not be prepared: " in lines["d.urdf"]["text"] and lines["d.urdf"]["status"] == "failed"
        assert lines["c.urdf"]["status"] == "edited" and lines["c.urdf"]["before"][0].endswith(": left as it is")
        assert job["message"].endswith("1 hull likely spans parts, left as is.")
        assert not project.layout.preparation.ids
        hello = studio.until(lambda hello: hello["project"]["new"] is not None)
        assert hello["project"]["new"]["rebuilt"] == 2, "another run may still rebuild them"


def test_a_run_that_is_stopped_leaves_each_new_asset_as_it_was_or_whole(project: Project, tmp_path: Path) -> None:
    with opened(tmp_path, project.folder) as studio, studio.page() as page:
        studio.settled()
        job = ok(studio.post("/api/jobs", {"kind": "apply"}))["id"]
        page.until(lambda event: event["kind"] == "job" and event["job"]["doing"] not in ("", "applying the program"))
        assert studio.post("/api/jobs/cancel", {"id": job}).status_code == 200
        ended = page.job(job)
        assert (ended["state"], ended["message"]) == ("cancelled", "Cancelled: what was done by then stays.")
        prepared = project.layout.preparation.ids
        for asset in ("c.urdf", "d.urdf"):
            labels = [hull.label for hull in project.mesh(asset).hulls]
            assert (
                sorted(map(str, labels)) == ["leg", "leg", "leg", "leg", "seat"]
                if asset in prepared
                else labels == [None] * 4
            )
        hello = studio.until(lambda hello: not hello["learning"])
        left = hello["project"]["new"]["ids"] if hello["project"]["new"] else []
        assert left == [asset for asset in ("c.urdf", "d.urdf") if asset not in prepared]
