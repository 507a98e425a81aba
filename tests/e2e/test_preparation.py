"""What is done to an asset before its demonstration, in the browser: labels from names, hulls made, hulls cut."""

from __future__ import annotations

from pathlib import Path

from playwright.sync_api import Browser

from meshforge.project import Project
from tests.e2e.hand import Hand
from tests.e2e.walk import go_to, visiting
from tests.unit.batch.families import obj
from tests.unit.project.stools import create_stools
from tests.urdf_sample import corner_obj

STOOL = obj({"seat_1": ((0, 0, 1), (2, 2, 1.5)), "leg_1": ((0.5, 0.5, 0), (1, 1, 1))})


def test_names_give_labels_a_button_makes_hulls_and_a_plane_cuts_one(tmp_path: Path, browser: Browser) -> None:
    assets = tmp_path / "assets"
    assets.mkdir()
    (assets / "corner.obj").write_text(corner_obj(), encoding="utf-8")
    (assets / "stool.obj").write_text(STOOL, encoding="utf-8")
    project = Project.create(tmp_path / "project", [assets / "*.obj"], vocabulary=("seat", "leg"))
    with visiting(tmp_path, project, browser) as (_, person):
        _label_by_names(person)
        labels = {hull.name: (hull.label, hull.source) for hull in project.mesh("stool.obj").hulls}
        assert labels == {"seat_1": ("seat", "name"), "leg_1": ("leg", "name")}
        _cut_in_two(person)
        assert len(project.mesh("stool.obj").hulls) == 3
        person.press("Control+z")
        _has_hulls(person, 2)
        assert not project.mesh("corner.obj").hulls
        _make_hulls(person)
        person.page.get_by_role("button", name="Jobs").wait_for()
        assert len(project.mesh("corner.obj").hulls) == 2


def test_hulls_that_span_parts_are_pictures_to_tick_of_which_the_others_stay(tmp_path: Path, browser: Browser) -> None:
    sizes = {"a": (0.2, 0.4), "b": (0.22, 0.45), "c": (0.18, 0.38), "d": (0.21, 0.41)}
    project = create_stools(tmp_path, sizes, spanning="cd")
    with visiting(tmp_path, project, browser) as (studio, person):
        person.press("Alt+2")
        person.click("Find hulls that span parts")
        person.sees("2 hulls of 2 assets may span parts. Nothing is changed.")
        sheet = person.page.get_by_role("list", name="Hulls that may span parts")
        assert sheet.get_by_text("base/h0 holds seat and leg, ").count() == 2
        assert not sheet.get_by_role("checkbox", checked=True).count() and not project.layout.preparation.ids
        person.click(sheet.get_by_role("checkbox").nth(1))
        person.click("Rebuild 1 ticked body")
        person.sees("Bodies of 1 asset rebuilt")
        assert project.layout.preparation.ids == ("d.urdf",)
        person.press("Control+z")
        studio.until(lambda hello: not hello["history"]["undoable"])
        assert not project.layout.preparation.ids
        _find_and_dismiss(person, 2)
        person.click("Find hulls that span parts")
        person.sees("None: no hull spans parts")
        person.press("Control+z")
        person.sees("Undone: 2 hulls left as found")
        _find_and_dismiss(person, 2)


def _find_and_dismiss(person: Hand, count: int) -> None:
    person.click("Find hulls that span parts")
    person.sees(f"{count} hulls of 2 assets may span parts")
    person.click("None of these")
    person.page.get_by_role("list", name="Hulls that may span parts").wait_for(state="detached")


def _label_by_names(person: Hand) -> None:
    person.press("Alt+1")
    go_to(person, "stool.obj")
    person.sees("names of 2 hulls")
    person.click("Label all hulls")
    person.sees("2 given")


def _cut_in_two(person: Hand) -> None:
    person.press("Alt+2")
    person.hull("seat_1")
    person.press("k")
    person.click(person.page.get_by_role("radio", name="Across the Y axis"))
    person.press("Enter")
    _has_hulls(person, 3)


def _make_hulls(person: Hand) -> None:
    # in the middle of its card is a button that makes hulls, too
    person.click(person.page.get_by_role("option", name="corner.obj").first, position={"x": 8, "y": 8})
    person.drawn("corner.obj")
    person.page.get_by_label("Hulls of a piece, at most").fill("1")
    person.click("Try on this asset")
    person.sees("1 piece: 1 hull, ")
    _has_hulls(person, 1)
    person.click("Discard")
    _has_hulls(person, 0)
    person.page.get_by_label("Hulls of a piece, at most").fill("")
    person.click("Try again")
    person.sees("Hulls to try: none is kept yet")
    _has_hulls(person, 2)
    person.click("Keep for this one")
    person.sees("Original")
    _has_hulls(person, 2)


def _has_hulls(person: Hand, count: int) -> None:
    person.page.wait_for_function(
        "count => document.querySelectorAll('[role=row][data-name]').length === count", arg=count
    )
