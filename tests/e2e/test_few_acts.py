"""Families from a dropped folder to signed off and exported, by mouse and without a name: how many acts that takes.

Every click, key, drop and character counts as an act; a key that is held for several clicks counts once.
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser

from meshforge.formats import load
from meshforge.language import Program
from meshforge.samples import TABLES
from meshforge.symbolic import NO_PART, Hull
from tests.corpus_path import corpus
from tests.e2e.expert import Expert, volumes_of
from tests.e2e.hand import hand, windows
from tests.e2e.studio import ending, started
from tests.e2e.test_eight_chairs import is_honest
from tests.e2e.transfer import drop
from tests.e2e.walk import PAGE, address, go_to, stepped

Truth = dict[str, dict[str, str]]
"""The part of each hull, by asset and name."""
CHAIRS = {
    "KayKit-Furniture-Bits-1.0": (
        "chair_A",
        "chair_A_wood",
        "chair_B",
        "chair_B_wood",
        "chair_stool",
        "chair_stool_wood",
    ),
    "KayKit-Restaurant-Bits-1.0": ["chair_A", "chair_B"],
}
SEAT = (0.35, 0.55)
"""Heights [m] between which the seats of these chairs end."""


def write_chairs(folder: Path) -> Truth:
    """Real chairs: what ends below the seat is a leg, what ends above it the back."""
    truth = Truth()
    for source, names in CHAIRS.items():
        shutil.copytree(corpus("chairs", source), folder / source)
        for file in (folder / source).glob("*.gltf"):
            if file.stem in names:
                truth[f"{source}/{file.name}"] = {hull.name: _part_of(hull) for hull in load(file).hulls}
            else:
                file.unlink()
    return truth


def _part_of(hull: Hull) -> str:
    height = hull.vertices[:, 1].max()  # y is up in glTF
    return "part_a" if height < SEAT[0] else "part_b" if height > SEAT[1] else NO_PART


def write_tables(folder: Path) -> Truth:
    """The bundled tables without their labels."""
    folder.mkdir()
    truth = Truth()
    for file in TABLES.glob("*.obj"):
        shutil.copy(file, folder)
        said = json.loads(file.with_suffix(".labels.json").read_text())["hulls"]
        truth[file.name] = {hull: "part_a" if row["label"] == "leg" else NO_PART for hull, row in said.items()}
    return truth


@dataclass(frozen=True)
class Family:
    """keys: the action of each rule; shown: the assets that demonstrate them."""

    write: Callable[[Path], Truth]
    count: str
    meant: str
    keys: Sequence[Sequence[str]]
    shown: Sequence[str]
    most: int


FAMILIES = {
    "eight real chairs": Family(
        write_chairs,
        "8 GLTF",
        "labels part_a, part_b\n\nIs(part_a) => Each(Replace(capsule))\nIs(part_b) => Merge\n",
        (("r", "capsule", "e"), ("m",)),
        [f"KayKit-Furniture-Bits-1.0/chair_{name}.gltf" for name in ("A", "B")],
        50,
    ),
    "14 tables": Family(
        write_tables,
        "14 OBJ",
        "labels part_a\n\nIs(part_a) => Each(Merge)\n",
        (("m", "e"),),
        ("table_03.obj", "table_08.obj"),
        64,
    ),
}


class Pointer(Expert):
    """Selects by the mouse: a hull and its look-alikes, then what is still missing or too much."""

    def open_asset(self, asset: str) -> None:
        go_to(self.person, asset)

    def choose(self, asset: str, hulls: frozenset[str]) -> None:
        self.person.drawn(asset)
        looks_for_alike = True
        while left := hulls - self._selected():
            self._take(min(left, key=lambda hull: (not self._is_seen(hull), hull)))
            if looks_for_alike:
                before = self._selected()
                with self.person.page.expect_response(lambda one: one.url.endswith("/api/similar")):
                    self.person.press("j")
                self.person.page.wait_for_timeout(200)  # there may be none
                more = self._selected() - before
                looks_for_alike = len(more - hulls) <= len(more & hulls)
        for hull in sorted(self._selected() - hulls):
            self._take(hull)
        assert self._selected() == hulls

    def _take(self, hull: str) -> None:
        """Click on a hull in the view, or in the list where others hide it; Ctrl is pressed for all clicks at once."""
        if self._is_seen(hull):
            self.person.hull(hull, *(["Control"] if self._selected() else []))
            self.person.actions -= bool(self._selected())
            return
        row = self.person.page.locator(f'[role=row][data-name="{hull}"]')
        self.person.page.get_by_role("grid", name="Hulls").hover()
        for _ in range(60):
            if row.count():
                break
            self.person.page.mouse.wheel(0, 200)
            self.person.page.wait_for_timeout(50)
        self.person.actions += 1  # to scroll
        self.person.click(row, modifiers=["Control"])

    def _selected(self) -> frozenset[str]:
        return frozenset(self.person.page.evaluate("window.meshforgeViewport.selected()"))

    def _is_seen(self, hull: str) -> bool:
        return self.person.page.evaluate("name => window.meshforgeViewport.project(name)", hull) is not None

    def _answer(self, question: dict[str, Any]) -> None:
        if question["kind"] != "group":
            return super()._answer(question)
        labels = [choice["label"] for choice in question["choices"]]
        if len(question["hulls"]) == 1:
            return super()._answer(question)
        for hull in question["hulls"]:
            name = f"{hull['hull']} of {hull['asset']}: "
            for _ in range(labels.index(self.truth[hull["asset"]][hull["hull"]])):
                self.person.click(self.person.page.get_by_role("button", name=name))
        self.person.press("1")

    def show_first(self, asset: str, keys: Sequence[Sequence[str]]) -> None:
        """Demonstrate the rules on the first asset."""
        self.open_asset(asset)
        for step, (own, hulls) in enumerate(zip(keys, self.selections[asset], strict=True), 1):
            self.choose(asset, hulls)
            for key in own:
                if len(key) == 1:
                    self.person.press(key)
                else:
                    self.person.click(key)
            self.person.press("Enter")
            stepped(self.person, step)


@pytest.mark.parametrize("name", ["eight real chairs", pytest.param("14 tables", marks=pytest.mark.long)])
def test_a_family_takes_few_acts(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, browser: Browser) -> None:
    monkeypatch.chdir(tmp_path)  # the folder that the page proposes for the project lies here
    family, source = FAMILIES[name], tmp_path / "source"
    truth = family.write(source)
    with ending(started("studio", "--page", str(PAGE))) as studio, windows(browser):
        person = hand(browser)
        person.page.goto(address(studio))
        person.page.get_by_role("heading", name="Recent projects").wait_for()
        drop(person, source)
        person.actions += 1
        person.sees(family.count)
        folder = Path(person.page.get_by_label("Project folder").input_value())
        person.click("Make the project")
        person.drawn()
        studio.settled()
        expert = Pointer(person, studio, source, truth, Program.parse(family.meant), folder)
        person.press("Alt+2")
        first, *others = family.shown
        expert.show_first(first, family.keys)
        for asset in others:
            expert.open_asset(asset)
            expert.show(asset)
        expert.answer_all(partial(is_honest, person))
        person.press("Alt+4")
        person.sees(f"Signed off {len(truth)} of {len(truth)}")
        person.click("Apply to all")
        studio.cards(lambda cards: all(card["output"] == "edited" and not card["stale"] for card in cards.values()))
        person.click(person.page.get_by_role("radio", name="Export"))
        person.click(f"Export {len(truth)} assets")
        person.sees("The last export")
        assert not person.complaints
    print(f"\n{name}: {person.actions} acts (at most {family.most}), cards: {dict(expert.answered)}")
    assert {asset: volumes_of(load(folder / "export" / asset)) for asset in truth} == expert.volumes
    assert person.actions <= family.most
