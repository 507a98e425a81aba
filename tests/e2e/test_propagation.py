"""From one asset that is labelled by clicks to labels on all, in the browser: carried over, looked through, corrected,
carried over again, and taken back."""

from __future__ import annotations

import re
from pathlib import Path

from playwright.sync_api import Browser, Locator

from meshforge.project import Project
from meshforge.symbolic import Label
from tests.e2e.hand import Hand
from tests.e2e.legs import HULLS, LABELS, WORDS, four_legged
from tests.e2e.studio import Studio
from tests.e2e.walk import click_row, go_to, visiting
from tests.unit.batch.families import tree

FIRST, SECOND = "t0.obj", "t1.obj"
CARRIED = "Labels propagated"


def test_one_asset_is_labelled_and_the_others_follow(tmp_path: Path, browser: Browser) -> None:
    project = four_legged(tmp_path, words=())
    labels = project.folder / "labels"
    with visiting(tmp_path, project, browser) as (studio, person):
        _is_told_why_not(person)
        _label_one(person, studio)
        person.press("p")
        _outcome(person).wait_for()
        person.sees("15 new on 3 assets")
        _mark(person, SECOND, "5 labels are new").wait_for()
        carried = tree(labels)
        assert set(carried) == {f"t{k}.obj.json" for k in range(4)}
        person.press("n")
        person.sees("sure, propagated")
        _outcome(person).wait_for()
        _look_through(person, studio, project)
        said = tree(labels)
        assert not _outcome(person).is_visible(), "another edit was made"
        _carry_again(person, project)
        assert tree(labels) != said
        _taken_back_and_done_again(person, labels, said)


def _outcome(person: Hand) -> Locator:
    return person.page.get_by_role("status", name=CARRIED, exact=True)


def _mark(person: Hand, asset: str, text: str) -> Locator:
    return person.page.get_by_role("option", name=re.compile(f"{re.escape(asset)}.*{text}"))


def _is_told_why_not(person: Hand) -> None:
    """There is nothing to carry over yet, and the page says what is missing."""
    person.press("Alt+1")
    assert person.button("Propagate labels").is_disabled()
    person.sees("Type the names of the labels first.")
    person.click(person.page.get_by_label("New labels, separated by commas"))
    person.page.keyboard.type(", ".join(WORDS))
    person.press("Enter", "Escape")
    person.sees("Label the hulls of one asset first.")
    assert person.button("Propagate labels").is_disabled()


def _label_one(person: Hand, studio: Studio) -> None:
    """Click each hull of one asset, in the view or in the list, and press the digit of its label."""
    go_to(person, FIRST)
    person.hull("top")
    person.press("1")
    for k, name in enumerate(HULLS[1:], 2):
        click_row(person, name)
        person.press(str(k))
    person.page.get_by_placeholder(re.compile("^Search 5 hulls")).fill("")
    go_to(person, FIRST)
    studio.cards(lambda cards: cards[FIRST]["given"] == len(HULLS))
    person.sees("3 assets have no label: propagate labels.")
    person.sees("5 labels on 1 asset")


def _look_through(person: Hand, studio: Studio, project: Project) -> None:
    """Say that the first unsure label is right, correct the second: each time the next one is in hand."""
    seen = []
    for key in ("Enter", "3"):
        asset, hull = _in_hand(person)
        before = project.labels(asset).labels[hull]
        assert (before.source, before.confidence < 0.5) == ("propagated", True)
        person.press(key)
        person.page.wait_for_function(
            "hull => document.querySelector('[role=row][aria-selected=true]')?.dataset.name !== hull", arg=hull
        )
        name = before.name if key == "Enter" else WORDS[2]
        assert project.labels(asset).labels[hull] == Label(name)
        seen.append((asset, hull))
    person.press("Shift+N")
    assert _in_hand(person) not in seen, "what was said is sure"
    studio.until(lambda hello: (hello["project"]["carried"] or {}).get("unused") == 2)
    person.sees("2 labels not propagated yet")


def _in_hand(person: Hand) -> tuple[str, str]:
    """The hull that is selected, and its asset."""
    person.page.wait_for_function(
        "() => document.querySelector('[data-testid=viewport]').ariaBusy === 'false'"
        " && document.querySelectorAll('[role=row][aria-selected=true]').length === 1"
    )
    asset = person.page.locator("[data-testid=viewport]").get_attribute("data-asset")
    hull = person.page.locator("[role=row][aria-selected=true]").get_attribute("data-name")
    assert asset and hull
    return asset, hull


def _carry_again(person: Hand, project: Project) -> None:
    person.click("Propagate labels again")
    _outcome(person).wait_for()
    person.sees("All your labels are propagated")
    assert {name: label.name for name, label in project.labels(FIRST).labels.items()} == LABELS


def _taken_back_and_done_again(person: Hand, labels: Path, said: dict[str, bytes]) -> None:
    """Undo and redo, and putting aside what is told."""
    again = tree(labels)
    person.click(_outcome(person).get_by_role("button", name="Undo"))
    _outcome(person).wait_for(state="hidden")
    person.sees("Undone: labels propagated")
    assert tree(labels) == said
    person.press("Control+Shift+Z")
    _outcome(person).wait_for()
    assert tree(labels) == again
    person.click(_outcome(person).get_by_role("button", name="Dismiss; the labels stay"))
    _outcome(person).wait_for(state="hidden")
    assert tree(labels) == again
