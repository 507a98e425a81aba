"""What the view shows, pixel by pixel: hulls with faces in one plane, the outline of what is selected."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from PIL import Image
from playwright.sync_api import Browser

from meshforge.project import Project
from tests.e2e.hand import Hand
from tests.e2e.legs import four_legged
from tests.e2e.walk import visiting

BOXES = {
    "first": ((0.0, 0.0, 0.0), (1.0, 1.0, 1.0), "left"),
    "second": ((0.5, 0.2, 0.0), (1.6, 0.8, 1.0), "right"),  # top and bottom lie in those of the first
    "third": ((0.2, -0.5, 0.1), (0.8, 0.6, 1.0), "right"),
}
_HULLS = """
([step, reach]) => {
  const { left, top, width, height } = document.querySelector('[data-testid=viewport] canvas').getBoundingClientRect();
  const at = (x, y) => window.meshforgeViewport.hullAt(left + x, top + y);
  const found = [];
  for (let y = step; y < height - step; y += step) {
    for (let x = step; x < width - step; x += step) {
      const hull = at(x, y);
      const same = ([dx, dy]) => at(x + dx, y + dy) === hull;
      if (hull && [[reach, 0], [-reach, 0], [0, reach], [0, -reach]].every(same)) found.push([left + x, top + y, hull]);
    }
  }
  return found;
}
"""
"""Pixels well within what the pointer finds to be one hull."""


def pixels(person: Hand) -> np.ndarray[tuple[int, ...], Any]:
    """The page as it looks once the camera rests: (height, width, 3)."""
    person.page.wait_for_timeout(500)
    return np.asarray(Image.open(BytesIO(person.page.screenshot())).convert("RGB")).astype(int)


def turn(person: Hand) -> None:
    """A small turn of the camera by dragging with the middle button."""
    box = person.page.locator("[data-testid=viewport] canvas").bounding_box()
    assert box
    x, y = box["x"] + 40, box["y"] + box["height"] / 2
    person.page.mouse.move(x, y)
    person.page.mouse.down(button="middle")
    person.page.mouse.move(x + 23, y + 11, steps=3)
    person.page.mouse.up(button="middle")


def test_of_faces_in_one_plane_the_same_is_drawn_and_picked_from_every_side(tmp_path: Path, browser: Browser) -> None:
    lines, count = [], 0
    for name, (low, high, _) in BOXES.items():
        made = trimesh.creation.box(bounds=(low, high))
        lines += [f"o {name}", *("v {} {} {}".format(*vertex) for vertex in made.vertices)]
        lines += ["f {} {} {}".format(*(face + 1 + count)) for face in made.faces]
        count += len(made.vertices)
    asset = tmp_path / "boxes.obj"
    asset.write_text("\n".join(lines) + "\n")
    project = Project.create(tmp_path / "project", [asset], vocabulary=("left", "right"))
    project.set_labels("boxes.obj", {name: label for name, (_, _, label) in BOXES.items()})
    with visiting(tmp_path, project, browser, 1024, 700) as (_, person):
        person.page.mouse.move(5, 5)
        for _ in range(3):
            seen = pixels(person)
            spots = person.page.evaluate(_HULLS, [6, 4])
            assert len({hull for _, _, hull in spots}) == 3
            for x, y, hull in spots:
                red, _, blue = seen[round(y), round(x)]
                assert ("left" if red > blue else "right") == BOXES[hull][2], (x, y, hull)
            turn(person)
            person.page.mouse.move(5, 5)
        before = pixels(person)
        person.hull("first")
        person.page.mouse.move(5, 5)
        changed = pixels(person)[np.abs(pixels(person) - before).max(axis=2) > 60]
        assert (changed.min(axis=1) > 225).sum() > 100, "a light line"
        assert (changed.max(axis=1) < 50).sum() > 100, "on a dark one"


def two_bodies(folder: Path) -> Project:
    """A project of one asset, a frame and a door of two hulls each."""
    geoms = [f'<geom name="{name}" type="box" size=".1 .1 .1" pos="{k} 0 0"/>' for k, name in enumerate("abcd")]
    asset = folder / "two.xml"
    bodies = f'<body name="frame">{geoms[0]}{geoms[1]}</body><body name="door">{geoms[2]}{geoms[3]}</body>'
    asset.write_text(f"<mujoco><worldbody>{bodies}</worldbody></mujoco>")
    return Project.create(folder / "project", [asset])


def test_hulls_are_selected_by_their_bodies_in_a_tree(tmp_path: Path, browser: Browser) -> None:
    with visiting(tmp_path, two_bodies(tmp_path), browser) as (_, person):
        person.drawn("two.xml")
        tree = person.page.get_by_role("treegrid", name="Hulls")
        tree.focus()
        for keys, hulls in (
            (("ArrowDown", "ArrowLeft"), "ab"),  # the first body, closed
            (("Shift+ArrowDown",), "abcd"),
            (("ArrowDown",), "c"),
            (("Shift+B",), "cd"),
            (("ArrowLeft", "Space"), ""),
        ):
            person.press(*keys)
            selected = person.page.evaluate("window.meshforgeViewport.selected()")
            assert "".join(sorted(name[-1] for name in selected)) == hulls, keys
        levels = tree.locator("[aria-level='1']").all()
        assert [row.get_attribute("aria-expanded") for row in levels] == ["false", "true"]


def test_no_row_moves_under_the_pointer_where_a_message_comes(tmp_path: Path, browser: Browser) -> None:
    project = four_legged(tmp_path)
    with visiting(tmp_path, project, browser, 1024, 700) as (_, person):
        row = person.page.locator("[role=row][data-name=leg_a]")
        row.click()
        before = row.bounding_box()
        person.press("2")
        person.sees("1 hull of t0.obj labelled first")
        assert row.bounding_box() == before


def test_a_form_shows_what_is_chosen_and_lets_it_be_chosen_back(tmp_path: Path, browser: Browser) -> None:
    with visiting(tmp_path, four_legged(tmp_path), browser, 1024, 700) as (_, person):
        person.press("Alt+2")
        person.hull("top")
        person.press("r")
        person.click("capsule")
        along, fit = person.page.get_by_role("group", name="Along"), person.page.get_by_label("Fit").last
        assert along.get_by_role("radio", checked=True).inner_text() == "by itself"
        person.click(along.get_by_role("radio", name="X"))
        assert along.get_by_role("radio", checked=True).inner_text() == "X"
        fit.select_option(label="tight, in any direction")  # which goes with no axis
        assert along.get_by_role("radio", checked=True).inner_text() == "by itself"
        fit.select_option(label="bounding box")
        assert fit.input_value() == ""
        box = fit.bounding_box()
        assert box and box["x"] + box["width"] <= 1024


def test_a_program_that_is_typed_stays_until_it_is_saved_or_cancelled(tmp_path: Path, browser: Browser) -> None:
    with visiting(tmp_path, four_legged(tmp_path), browser) as (_, person):
        person.press("Alt+3")
        person.click("Write as text")
        editor = person.page.get_by_role("textbox", name="Program")
        editor.click()
        person.type("Is(top) => Delete")
        typed = editor.inner_text()
        assert "Is(top) => Delete" in typed
        person.press("Escape", "Escape")  # the first one may close a list of completions
        assert editor.inner_text() == typed
        person.click(person.page.get_by_role("tab", name="Review"))
        person.click(person.page.get_by_role("tab", name="Learn"))
        assert editor.inner_text() == typed
        person.click("Cancel")
        assert not editor.count()
