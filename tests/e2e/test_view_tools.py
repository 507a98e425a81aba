"""Tools around the view in the browser: section plane, ruler, hidden hulls, one row of tools, messages, first paint."""

from __future__ import annotations

import io
import itertools
import time
from collections.abc import Callable, Iterator
from typing import Any, Literal

import pytest
from PIL import Image
from playwright.sync_api import Browser

from meshforge.project import Project
from meshforge.samples import TABLES
from tests.e2e.hand import PATIENCE, Hand, hand, windows
from tests.e2e.studio import Studio, opened
from tests.e2e.walk import PAGE, address

TABLE = "table_08.obj"
LONG = "a label of many words " * 14
GROUNDS = {"light": (0xF4, 0xF5, 0xF7), "dark": (0x16, 0x18, 0x1C)}
"""`--ground` of the page's tokens.css."""


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    """A studio on two tables, of which one hull has a label of 300 characters."""
    folder = tmp_path_factory.mktemp("tools")
    long = LONG[:300].strip()
    project = Project.create(folder / "project", [TABLES / TABLE, TABLES / "table_03.obj"], vocabulary=("panel", long))
    project.set_labels(TABLE, {"convex_00": "panel", "convex_01": long})
    with opened(folder, project.folder, "--page", str(PAGE)) as running:
        running.settled()
        yield running


@pytest.fixture(autouse=True)
def _windows(browser: Browser) -> Iterator[None]:
    with windows(browser):
        yield


def test_one_looks_inside_and_measures_by_keys_and_by_clicks(studio: Studio, browser: Browser) -> None:
    person = _person(browser, studio)
    seen = _hulls_in_sight(person)
    person.press("Shift+K")
    bar = person.page.get_by_role("group", name="Section plane")
    bar.wait_for()
    _until(person, lambda: bool(_hulls_in_sight(person) - seen))  # what was hidden is seen inside
    before = _hulls_in_sight(person)
    bar.get_by_role("slider").focus()
    for _ in range(30):
        person.press("ArrowLeft")
    _until(person, lambda: _hulls_in_sight(person) != before)
    person.press("Shift+K")
    bar.wait_for(state="detached")

    person.press("d")
    first, second = (_pixel(person, name) for name in sorted(_hulls_in_sight(person))[:2])
    for x, y in (first, second):
        person.page.mouse.move(x, y)
        person.page.mouse.click(x, y)
    measures = person.page.get_by_test_id("measure")
    assert " m" in measures.first.inner_text() and "dz" in measures.first.inner_text()
    person.click(person.page.get_by_role("radio", name="Millimetres"))
    assert " mm" in measures.first.inner_text()
    person.press("Escape")
    person.page.get_by_role("group", name="Ruler").wait_for(state="detached")
    person.press("a", "Shift+D")
    assert measures.count() == 2
    person.page.get_by_role("status").filter(has_text="Extents of").wait_for(state="attached")
    assert not person.complaints


def test_hidden_hulls_are_counted_over_the_view_until_all_are_shown(studio: Studio, browser: Browser) -> None:
    person = _person(browser, studio)
    names = sorted(_hulls_in_sight(person))
    person.hull(names[0])
    person.press("Shift+H")
    chip = person.page.get_by_test_id("hidden")
    assert chip.inner_text().startswith("1 of ")
    person.press("Shift+H")
    chip.wait_for(state="detached")
    person.press("h")
    chip.wait_for()
    person.click(chip.get_by_role("button", name="Show all"))
    chip.wait_for(state="detached")


@pytest.mark.parametrize(("width", "height"), [(1920, 1080), (1024, 768), (960, 600)])
def test_tools_are_in_one_row_the_rest_in_a_menu(studio: Studio, browser: Browser, width: int, height: int) -> None:
    person = _person(browser, studio, width, height)
    bar = person.page.get_by_role("toolbar", name="View")
    box = bar.bounding_box()
    assert box and box["height"] <= 40
    more = person.button("More of the view")
    if more.count():
        more.focus()
        person.press("Enter")
    person.page.get_by_role("slider", name="Exploded view").wait_for()
    person.page.get_by_test_id("extractor").wait_for()
    boxes = [part.bounding_box() for part in bar.locator("[data-part-id]").all()]
    rights = [part["x"] + part["width"] for part in boxes if part and part["width"]]
    assert rights == sorted(rights) and rights[-1] <= box["x"] + box["width"]


def test_messages_lie_over_neither_the_view_nor_the_family(studio: Studio, browser: Browser) -> None:
    person = _person(browser, studio)
    person.press("Alt+1")
    person.hull(sorted(_hulls_in_sight(person))[0])
    person.press("1")
    toast = person.page.get_by_test_id("toasts").get_by_role("status")
    toast.get_by_text("labelled panel").wait_for()
    column = person.page.get_by_role("complementary", name="Stage")
    message, view, side = (part.bounding_box() for part in (toast, person.page.get_by_test_id("viewport"), column))
    assert message and view and side
    assert message["x"] >= view["x"] + view["width"]
    assert message["y"] + message["height"] <= side["y"] + side["height"]
    person.press("Control+z")


def test_names_are_what_an_asset_has_alone_and_columns_are_made_wider_by_keys(studio: Studio, browser: Browser) -> None:
    person = _person(browser, studio)
    cards = person.page.get_by_role("listbox", name="Assets").get_by_role("option")
    foot = cards.first.locator("[aria-hidden] > span").first
    assert foot.inner_text() == "03"
    assert (cards.first.get_attribute("title") or "").splitlines() == ["table_03.obj", "36 hulls have no label"]
    assert "table_03.obj" in cards.first.inner_text(), "a screen reader says it whole"
    row = person.page.locator("[data-name=convex_00] [role=gridcell]").first
    assert row.inner_text().split() == ["00", "convex_00"] and row.get_attribute("title") == "convex_00"
    for name, column, key in (("family", "Family", "ArrowRight"), ("panel", "Stage", "ArrowLeft")):
        side = person.page.get_by_role("complementary", name=column)
        wide = side.evaluate("one => one.offsetWidth") + 32
        person.reach(person.page.get_by_role("separator", name=f"Width of the {name}"))
        person.press(key, key)
        person.page.wait_for_function(
            "([name, wide]) => document.querySelector(`[aria-label=${name}][data-part]`)?.offsetWidth === wide",
            arg=[column, wide],
        )
        person.page.reload()
        person.page.wait_for_function(
            "([name, wide]) => document.querySelector(`[aria-label=${name}][data-part]`)?.offsetWidth === wide",
            arg=[column, wide],
        )


def test_a_label_of_300_characters_is_cut(studio: Studio, browser: Browser) -> None:
    person = _person(browser, studio)
    person.press("Alt+1")
    x, y = _pixel(person, "convex_01")
    person.page.mouse.move(x, y)
    line = person.page.get_by_test_id("pointed")
    line.get_by_text(LONG[:20]).first.wait_for()
    pointed, view = line.bounding_box(), person.page.get_by_test_id("viewport").bounding_box()
    assert pointed and view
    assert pointed["height"] <= 90 and pointed["x"] + pointed["width"] <= view["x"] + view["width"]
    right = person.page.evaluate(
        "() => Math.max(...[...document.querySelectorAll('body *')].map(one => one.getBoundingClientRect().right))"
    )
    assert right <= 1440, "nothing is wider than the window"
    rows = [row.bounding_box() for row in person.page.locator("[data-name]").all()]
    assert len({row["height"] for row in rows if row}) == 1, "all rows of the list are as high"


@pytest.mark.parametrize(
    ("system", "chosen"),
    [*itertools.product(("light", "dark"), ("light", "dark", None))],
    ids=lambda word: word or "system",
)
def test_the_first_paint_is_in_the_theme_before_any_script_or_style(
    studio: Studio, browser: Browser, system: Literal["light", "dark"], chosen: Literal["light", "dark"] | None
) -> None:
    page = browser.new_context(color_scheme=system, viewport={"width": 300, "height": 200}).new_page()
    page.route("**/assets/*", lambda route: route.abort())
    if chosen:
        page.add_init_script(f"""localStorage.setItem("meshforge.desk", '{{"theme":"{chosen}"}}')""")
    page.goto(address(studio), wait_until="domcontentloaded")
    picture = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
    assert picture.getcolors() == [(300 * 200, GROUNDS[chosen or system])]


def _person(browser: Browser, studio: Studio, width: int = 1440, height: int = 900) -> Hand:
    person = hand(browser, width, height)
    person.open(address(studio))
    person.press("Control+k")
    person.type(TABLE)
    person.press("Enter")
    person.drawn(TABLE)
    person.page.locator("[data-name=convex_00]").wait_for()
    return person


def _hulls_in_sight(person: Hand) -> set[str]:
    """The hulls that a grid of pixels of the view meets."""
    script = """() => {
      const canvas = document.querySelector('[data-testid=viewport] canvas');
      const { left, top, width, height } = canvas.getBoundingClientRect();
      const found = new Set();
      for (let x = 4; x < width; x += 12) for (let y = 4; y < height; y += 12) {
        const hull = window.meshforgeViewport.hullAt(left + x, top + y);
        if (hull !== null) found.add(hull);
      }
      return [...found];
    }"""
    return set(person.page.evaluate(script))


def _pixel(person: Hand, name: str) -> tuple[float, float]:
    """Where a hull is seen."""
    person.page.wait_for_function("name => window.meshforgeViewport?.project(name)", arg=name)
    place: dict[str, Any] = person.page.evaluate("name => window.meshforgeViewport.project(name)", name)
    return place["x"], place["y"]


def _until(person: Hand, holds: Callable[[], bool]) -> None:
    """Wait until a condition holds."""
    until = time.monotonic() + PATIENCE / 1000
    while not holds():
        assert time.monotonic() < until, "that does not come to hold"
        person.page.wait_for_timeout(50)
