"""Hulls that span parts, in the browser: found by a job, asked about on a card that shows their parts, and answered."""

from __future__ import annotations

import colorsys
import json
import shutil
import time
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from meshforge.batch import IN_PROCESS
from meshforge.project import Project, SplitSettings
from meshforge.rendering import label_color
from tests.e2e.hand import Hand, chromium, hand
from tests.e2e.studio import Studio, ok, opened
from tests.e2e.walk import PAGE, PATIENCE, address
from tests.unit.project.stools import create_stools

pytestmark = pytest.mark.slow

_SPANNING = ("c.urdf", "d.urdf")
_MANY = 2000
"""Pixels of a part in the view, at least; there are some 800,000."""


@pytest.fixture
def project(tmp_path: Path) -> Project:
    """Four stools, two of them labelled; of the others the first hull spans the seat and a leg."""
    sizes = {"a": (0.2, 0.4), "b": (0.22, 0.45), "c": (0.18, 0.38), "d": (0.19, 0.42)}
    return create_stools(tmp_path, sizes, "cd")


def test_a_card_asks_about_each_hull_that_spans_parts_and_yes_splits_it(project: Project, tmp_path: Path) -> None:
    shutil.copytree(project.folder, tmp_path / "by_command")
    with opened(tmp_path, project.folder, "--page", str(PAGE)) as studio, chromium() as browser:
        studio.settled()
        person = hand(browser)
        person.open(address(studio))
        _find(person)
        first = _asked(person)
        person.press("Tab")
        assert person.page.locator("section[aria-labelledby=asked] :focus").count() == 1, "Tab goes on from the card"
        assert not project.layout.preparation(first).exists()
        _sees_parts_in_color(person, tmp_path / "view.png")
        person.sees("1 more hull likely spans parts.")
        _is_beside_its_parts(studio.get("/api/parts/picture", asset=first, hull="base/h0").content)
        _is_marked(person, studio, first)
        person.press("y")
        other = _asked(person, before=first)
        assert {first, other} == set(_SPANNING)
        studio.cards(lambda cards: [asset for asset in cards if cards[asset]["spans"]] == [other])
        _assert_split_as_by_command(project, Project.open(tmp_path / "by_command"), first)
        person.press("Control+z")
        assert _asked(person, before=other) == first, "undone, it is asked about again"
        assert not project.layout.preparation(first).exists()
        person.press("n")
        assert _asked(person, before=first) == other
        assert list(project.single_parts().assets) == [first]
        studio.cards(lambda cards: [asset for asset in cards if cards[asset]["spans"]] == [other])
        assert not project.layout.preparation(first).exists()
        assert not person.complaints


def test_an_asset_on_which_the_program_cannot_run_is_corrected_or_excluded(project: Project, tmp_path: Path) -> None:
    with opened(tmp_path, project.folder, "--page", str(PAGE)) as studio, chromium() as browser:
        studio.settled()
        legs = [hull.name for hull in project.mesh("a.urdf").hulls if hull.label == "leg"]
        studio.edit("steps", **studio.steps("a.urdf") | {"steps": [{"select": legs, "action": {"name": "Delete"}}]})
        person = hand(browser)
        person.open(address(studio))
        person.press("Alt+3")
        person.page.locator("#asked", has_text="The program cannot run on ").wait_for()
        person.press("u")
        assert not person.page.get_by_role("button", name="Right").count()
        person.page.get_by_role("button", name="Show it").wait_for()
        person.page.get_by_role("button", name="Exclude").wait_for()
        person.press("s", "n")
        person.sees("What to do with the selected hulls")
        assert not person.complaints, "no result was asked for that there cannot be"


def test_the_job_can_be_stopped_and_says_what_is_wrong(project: Project, tmp_path: Path) -> None:
    with opened(tmp_path, project.folder) as studio, studio.page() as page:
        studio.settled()
        job = ok(studio.post("/api/jobs", {"kind": "spans"}))["id"]
        cancelled = studio.post("/api/jobs/cancel", {"id": job}).status_code == 200
        state = page.job(job)["state"]
        assert state == "done" or (cancelled and state == "cancelled")
        assert project.layout.spans.exists() == (state == "done")
        for asset in project.assets():
            project.set_labels(asset, dict.fromkeys((hull.name for hull in project.mesh(asset).hulls), None))
        found = page.job(ok(studio.post("/api/jobs", {"kind": "spans"}))["id"])
        assert found["state"] == "failed" and "no hull has a label" in found["message"]
        refused = studio.get("/api/parts", asset="a.urdf", hull="base/h0")
        assert refused.status_code == 400 and "nothing is known of parts" in refused.json()["message"]


def _is_beside_its_parts(packet: bytes) -> None:
    """The left half of the picture shows the hull, the right half its parts, as many as the left half's other hulls."""
    names = _header(packet)["names"]
    assert names == ["base/h0#0", "base/h0#1", "base/h1", "base/h2", "base/h3", "base/h0"]
    with Image.open(BytesIO(packet[4 + int.from_bytes(packet[:4], "little") :])) as picture:
        shown = np.asarray(picture)[..., 1].astype(int)
    left, right = (set(half.ravel()) - {0} for half in np.hsplit(shown, 2))
    assert 6 in left and not left & {1, 2}
    assert {1, 2} <= right and 6 not in right


def _header(packet: bytes) -> dict[str, Any]:
    header: dict[str, Any] = json.loads(packet[4 : 4 + int.from_bytes(packet[:4], "little")])
    return header


def _find(person: Hand) -> None:
    person.press("Alt+2")
    person.click("Find hulls that span parts")
    person.sees("2 hulls of 2 assets likely span parts: you are asked about each.")
    person.button("Go to the question").wait_for()
    person.press("u")


def _asked(person: Hand, before: str | None = None) -> str:
    """The asset that the card is about and that is open, once it is another than before."""
    person.page.wait_for_function(
        "before => { const card = document.querySelector('#asked')?.textContent;"
        " return card?.endsWith('split so?') && (!before || !card.includes(before)); }",
        arg=before,
    )
    text = person.page.locator("#asked").inner_text()
    (asset,) = (name for name in _SPANNING if f"of {name} holds seat and leg" in text)
    person.drawn(asset)
    return asset


def _is_marked(person: Hand, studio: Studio, asset: str) -> None:
    """Cards and the list of hulls name the hull."""
    spans = {name: card["spans"] for name, card in studio.cards(lambda cards: bool(cards[asset]["spans"])).items()}
    assert [name for name in spans if spans[name]] == list(_SPANNING)
    (told,) = spans[asset].values()
    assert told.startswith("base/h0 holds seat and leg, ")
    person.press("Alt+2")
    row = person.page.locator("[role=row][data-name='base/h0']")
    row.get_by_role("img", name=told).wait_for()
    person.press("u")


def _sees_parts_in_color(person: Hand, file: Path) -> None:
    """Wait until the view shows both colours: without the parts there are none, as no hull of the asset has a label."""
    parts = person.page.get_by_role("list", name="Parts").get_by_role("listitem")
    parts.nth(1).wait_for()
    assert [text.split()[0] for text in parts.all_inner_texts()] == ["leg", "seat"]
    colors = [label_color(place) for place in range(2)]
    until = time.monotonic() + PATIENCE
    while True:
        person.page.get_by_test_id("viewport").screenshot(path=file)
        if all(_count_pixels(file, color) > _MANY for color in colors):
            return
        assert time.monotonic() < until, "the parts are not seen"
        person.page.wait_for_timeout(200)


def _count_pixels(file: Path, color: str) -> int:
    """How many pixels have the hue of a colour, and are no grey."""
    wanted = colorsys.rgb_to_hsv(*(int(color[k : k + 2], 16) / 255 for k in (1, 3, 5)))[0]
    with Image.open(file) as picture:
        hue, saturation, _ = np.moveaxis(np.asarray(picture.convert("HSV"), dtype=float) / 255, 2, 0)
    return int(((np.abs(hue - wanted) < 0.02) & (saturation > 0.4)).sum())


def _assert_split_as_by_command(project: Project, other: Project, asset: str) -> None:
    results = list(other.split_spanning([asset], SplitSettings(0.5), execution=IN_PROCESS))
    assert not any(result.problems for result in results)
    own, theirs = (one.layout.preparation(asset) / "hulls.obj" for one in (project, other))
    assert own.read_bytes() == theirs.read_bytes()
    assert project.layout.labels(asset).read_bytes() == other.layout.labels(asset).read_bytes()
    steps, others = (one.preparation(asset).steps for one in (project, other))
    assert [step.replaced for step in steps] == [step.replaced for step in others]
