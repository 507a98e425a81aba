"""The studio without a project: a person drops a folder on the start page, and has a project of it."""

from __future__ import annotations

import shutil
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser

from meshforge.project import Project
from meshforge.samples import TABLES
from tests.e2e.hand import hand, windows
from tests.e2e.legs import four_legged
from tests.e2e.studio import PATIENCE, Studio, ending, ok, started
from tests.e2e.transfer import drop
from tests.e2e.walk import PAGE, address
from tests.unit.project.stools import write_bare_stool


@pytest.fixture
def studio() -> Iterator[Studio]:
    with ending(started("studio", "--page", str(PAGE))) as found:
        yield found


def test_a_dropped_folder_becomes_a_project_with_its_assets(studio: Studio, tmp_path: Path, browser: Browser) -> None:
    source = tmp_path / "desks"
    source.mkdir()
    for name in ("table_01.obj", "table_02.obj"):
        shutil.copyfile(TABLES / name, source / name)
    before = sorted(tmp_path.rglob("*"))
    project = tmp_path / "projects" / "my desks"
    with windows(browser):
        person = hand(browser)
        person.page.goto(address(studio))
        person.page.get_by_role("heading", name="Recent projects").wait_for()
        drop(person, source)
        person.sees("2 OBJ")
        assert sorted(tmp_path.rglob("*")) == before
        person.page.get_by_label("Project folder").fill(str(project))
        person.press("Enter")
        person.page.get_by_role("option", name="table_01.obj").wait_for()
        person.drawn("table_01.obj")
        assert person.page.get_by_role("heading", name="my desks").is_visible()
        person.click("Projects: leave this one for the start page")
        person.page.get_by_role("button", name="my desks").first.wait_for()
        assert person.complaints == []
    assert sorted(path.name for path in (project / "assets" / "desks").iterdir()) == ["table_01.obj", "table_02.obj"]
    assert sorted(path.name for path in source.iterdir()) == ["table_01.obj", "table_02.obj"]


def test_assets_without_hulls_are_decomposed_part_by_part(studio: Studio, tmp_path: Path, browser: Browser) -> None:
    write_bare_stool(tmp_path / "stools", "a")
    project = tmp_path / "project"
    with windows(browser):
        person = hand(browser)
        person.page.goto(address(studio))
        person.page.get_by_label("Folder of assets", exact=True).fill(str(tmp_path / "stools"))
        person.press("Enter")
        person.sees("1 asset says what its parts are (seat and leg): a hull may hold several of them.")
        person.click(person.page.get_by_role("radio", name="Part by part"))
        person.sees("no hull crosses from one to another")
        person.page.get_by_label("Project folder").fill(str(project))
        person.press("Enter")
        person.page.locator("[role=row][data-name='base/leg#0']").wait_for()
        assert person.complaints == []
    made = Project.open(project)
    assert [hull.name for hull in made.mesh("a.urdf").hulls] == ["base/seat#0", *(f"base/leg#{k}" for k in range(4))]
    (step,) = made.preparation("a.urdf").steps
    assert step.settings["by"] == "parts"


@pytest.mark.parametrize("on_project", [True, False], ids=["project", "start page"])
def test_a_studio_that_was_killed_is_started_again_and_its_page_goes_on(
    on_project: bool, tmp_path: Path, browser: Browser, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("MESHFORGE_STATE", str(tmp_path / "state"))
    project = four_legged(tmp_path)
    words = ["studio", *([str(project.folder)] if on_project else []), "--page", str(PAGE)]
    with windows(browser):
        person = hand(browser)
        with ending(started(*words)) as studio:
            person.page.goto(address(studio))
            if not on_project:
                ok(studio.post("/api/start/open", {"folder": str(project.folder)}))
            person.drawn()
            (kept,) = (tmp_path / "state" / "addresses").iterdir()
            assert kept.stat().st_mode & 0o777 == 0o600
            person.hull("leg_a")
            studio.process.send_signal(signal.SIGKILL)
            studio.process.wait(PATIENCE)
            command = f"meshforge studio {project.folder}" if on_project else "meshforge studio"
            person.sees(f"Start it again by {command}: this page goes on by itself.")
            person.press("2")  # labels the hull, as soon as there is a server
            person.sees("1 edit of this page waits to be saved.")
        with ending(started(*words)) as again:
            assert (again.base, again.token) == (studio.base, studio.token)
            person.sees("1 hull of t0.obj labelled first")
            assert project.labels("t0.obj").labels["leg_a"].name == "first"
            person.click("Undo")
            person.sees("Undone: 1 hull of t0.obj labelled first")
        assert not person.complaints


def test_the_tour_is_one_click_in_a_folder_that_is_typed_and_stays_among_the_projects(
    studio: Studio, tmp_path: Path, browser: Browser
) -> None:
    (tmp_path / "cup.xml").write_text(
        "<mujoco><asset><mesh file='cup.stl'/></asset><worldbody><geom type='mesh' mesh='cup'/></worldbody></mujoco>"
    )
    with windows(browser):
        person = hand(browser)
        person.page.goto(address(studio))
        person.sees("says how sure each result is")
        drop(person, tmp_path / "cup.xml")
        person.sees("cup.xml refers to 1 file that was not dropped: cup.stl: drop the folder")
        assert person.page.get_by_label("Project folder").count() == 0
        person.page.get_by_label("Folder of the tour").fill(str(tmp_path / "tour"))
        person.click("Take the guided tour")
        person.page.get_by_role("dialog", name="Tour: A family of tables").wait_for()
        person.drawn()
        studio.settled()
        person.page.get_by_role("option", name="table_14.obj").get_by_text("hulls").first.wait_for(state="attached")
        person.click("Projects: leave this one for the start page")
        person.sees("14 assets · no program yet · today")
        assert person.complaints == []
    assert len(Project.open(tmp_path / "tour").assets()) == 14
