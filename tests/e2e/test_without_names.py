"""Eight chairs from a dropped folder to signed off and exported in the browser, without a name being typed."""

from __future__ import annotations

from pathlib import Path

from playwright.sync_api import Browser

from meshforge.formats import load
from meshforge.language import Program
from meshforge.project import Project
from meshforge.symbolic import NO_PART
from tests.e2e.chair_family import write_chairs
from tests.e2e.expert import Expert, volumes_of
from tests.e2e.hand import hand, windows
from tests.e2e.studio import ending, started
from tests.e2e.test_eight_chairs import is_honest
from tests.e2e.transfer import drop
from tests.e2e.walk import PAGE, address, stepped

CLASSES = {"slat": "part_a", "leg": "part_b"}
MEANT = Program.parse("""labels part_a, part_b

Is(part_a) => Delete
Is(part_b) => Each(Merge)
""")
SHOWN = ("chair_0.obj", "chair_3.obj")
"""Slats that lie, and some that stand."""


def test_eight_chairs_are_signed_off_without_a_name(tmp_path: Path, browser: Browser) -> None:
    source, folder = tmp_path / "chairs", tmp_path / "projects" / "my chairs"
    parts, _ = write_chairs(source)
    truth = {asset: {hull: CLASSES.get(part, NO_PART) for hull, part in its.items()} for asset, its in parts.items()}
    with ending(started("studio", "--page", str(PAGE))) as studio, windows(browser):
        person = hand(browser)
        person.page.goto(address(studio))
        person.page.get_by_role("heading", name="Recent projects").wait_for()
        drop(person, source)
        person.sees("8 OBJ")
        person.page.get_by_label("Project folder").fill(str(folder))
        person.press("Enter")
        person.drawn(SHOWN[0])
        studio.settled()
        before = person.actions
        person.press("Alt+2")
        expert = Expert(person, studio, source, truth, MEANT, folder)
        for asset in SHOWN:
            expert.open_asset(asset)
            for step, (part, keys) in enumerate((("slat", "x"), ("leg", "me")), 1):
                expert.choose(asset, frozenset(name for name, its in parts[asset].items() if its == part))
                person.press(*keys, "Enter")
                stepped(person, step)
        expert.answer_all(lambda hello: is_honest(person, hello))
        person.press("Alt+4")
        person.sees("Signed off 8 of 8")
        person.click("Apply to all")
        studio.cards(lambda cards: all(card["output"] == "edited" and not card["stale"] for card in cards.values()))
        assert not person.complaints
    print(f"\neight chairs without a name: {person.actions - before} acts, {expert.answered.total()} answers")
    assert not Project.open(folder).vocabulary
    assert {asset: volumes_of(load(folder / "edited" / asset)) for asset in truth} == expert.volumes
