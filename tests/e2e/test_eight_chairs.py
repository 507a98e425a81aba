"""Eight chairs from a dropped folder, from nothing to signed off and exported: all of it in the browser. Labelling them
takes few acts (a click, a drag, a key).
"""

from __future__ import annotations

from pathlib import Path

from playwright.sync_api import Browser

from meshforge.formats import load
from meshforge.language import Program
from meshforge.project import GIVEN, Project
from tests.e2e.chair_family import WORDS, write_chairs
from tests.e2e.expert import Expert, volumes_of
from tests.e2e.hand import hand, windows
from tests.e2e.labelling import label_look_alikes
from tests.e2e.studio import ending, started
from tests.e2e.test_sessions import is_honest
from tests.e2e.transfer import drop
from tests.e2e.walk import PAGE, address, show_alike

MEANT = Program.parse(f"""labels {", ".join(WORDS)}

Is(slat) => Delete
Is(leg)  => Each(Merge)
""")
FIRST, SECOND = "chair_0.obj", "chair_1.obj"
MOST_ACTS = 22
"""To label eight chairs with eight labels."""


def test_eight_chairs_go_from_a_dropped_folder_to_an_export(tmp_path: Path, browser: Browser) -> None:
    source, folder = tmp_path / "chairs", tmp_path / "projects" / "my chairs"
    truth, _ = write_chairs(source)
    with ending(started("studio", "--page", str(PAGE))) as studio, windows(browser):
        person = hand(browser)
        person.page.goto(address(studio))
        person.page.get_by_role("heading", name="Recent projects").wait_for()
        drop(person, source)
        person.sees("8 OBJ")
        person.page.get_by_label("Project folder").fill(str(folder))
        person.press("Enter")
        person.drawn(FIRST)
        studio.settled()
        person.click(person.page.get_by_label("New labels, separated by commas"))
        person.type(", ".join(WORDS))
        person.press("Enter", "Escape")
        before = person.actions
        label_look_alikes(person, truth, WORDS)
        acts = person.actions - before
        studio.cards(lambda cards: all(set(card["confidence"]) == {GIVEN} for card in cards.values()))
        studio.until(lambda _: {asset: labels_of(folder, asset) for asset in truth} == truth)  # files come after cards
        person.press("Escape", "Alt+2")
        expert = Expert(person, studio, source, truth, MEANT, folder)
        expert.open_asset(FIRST)
        slat, leg = (next(name for name, its in truth[FIRST].items() if its == part) for part in ("slat", "leg"))
        show_alike(person, slat, "x", steps=1)
        show_alike(person, leg, "m", "e", steps=2)
        expert.open_asset(SECOND)
        expert.show(SECOND)
        expert.answer_all(lambda hello: is_honest(person, hello))
        person.press("Alt+4")
        person.sees("Signed off 8 of 8")
        assert person.page.locator("[data-mood=good]").count()
        person.click("Apply to all")
        studio.cards(lambda cards: all(card["output"] == "edited" and not card["stale"] for card in cards.values()))
        person.click(person.page.get_by_role("radio", name="Export"))
        person.click("Export 8 assets")
        person.sees("The last export")
        assert not person.complaints
    print(f"\neight chairs: {acts} acts to label them (at most {MOST_ACTS}), {person.actions} clicks and keys in all")
    assert acts <= MOST_ACTS
    assert {asset: volumes_of(load(folder / "export" / asset)) for asset in truth} == expert.volumes


def labels_of(folder: Path, asset: str) -> dict[str, str]:
    return {hull: label.name for hull, label in Project.open(folder).labels(asset).labels.items()}
