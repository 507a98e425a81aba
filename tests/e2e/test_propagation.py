"""From one asset that is labelled by clicks to labels on all, in the browser: labelled at once, walked through,
corrected, labelled again, and taken back; and hulls painted with their look-alikes."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from playwright.sync_api import Browser

from meshforge.project import GIVEN, Project
from meshforge.symbolic import Label
from tests.e2e.hand import Hand
from tests.e2e.labelling import point_brush
from tests.e2e.legs import HULLS, LABELS, LEGS, WORDS, four_legged
from tests.e2e.studio import Studio
from tests.e2e.walk import click_row, go_to, visiting
from tests.unit.batch.families import tree

FIRST, SECOND = "t0.obj", "t1.obj"
LABELLED = "All labels by source"


def test_one_asset_is_labelled_and_the_others_follow(tmp_path: Path, browser: Browser) -> None:
    project = four_legged(tmp_path, words=())
    labels = project.folder / "labels"
    with visiting(tmp_path, project, browser) as (studio, person):
        _is_told_why_not(person)
        _label_one(person, studio)
        person.press("p")
        person.sees("15 labels on 3 assets")
        carried = tree(labels)
        assert set(carried) == {f"t{k}.obj.json" for k in range(4)}
        person.press("n")
        person.sees("sure, propagated")
        _look_through(person, studio, project)
        said = tree(labels)
        _carry_again(person, project)
        assert tree(labels) != said
        _taken_back_and_done_again(person, labels, said)


def test_the_walk_goes_from_the_least_sure_up_until_every_label_is_given(tmp_path: Path, browser: Browser) -> None:
    project = four_legged(tmp_path, count=2, words=("alpha", "beta"))
    project.set_labels(FIRST, {name: "alpha" if name == "top" else "beta" for name in HULLS})
    with visiting(tmp_path, project, browser) as (_, person):
        person.press("Alt+1", "p")
        person.sees(LABELLED)
        sure = []
        for left in range(len(HULLS), 0, -1):
            person.press(*(["n"] if left == len(HULLS) else []))
            place = person.page.get_by_text(re.compile(rf"hull 1 of {left}, [01].[0-9]+ sure"))
            place.wait_for()
            sure.append(float(re.findall(r"([01]\.[0-9]+) sure", place.inner_text())[0]))
            person.press("Enter")
        person.sees("Every label was given by you, a file or a name.")
        assert sure == sorted(sure)
    assert {one.source for one in project.labels(SECOND).labels.values()} == {"user"}


@pytest.mark.parametrize("latency", [0, 400])
def test_a_click_paints_look_alikes_and_labelling_all_sees_them(tmp_path: Path, browser: Browser, latency: int) -> None:
    """Also while the strokes are still on their way to the server."""
    project = four_legged(tmp_path, words=("alpha", "beta", "gamma"))
    legs = dict.fromkeys(LEGS, Label("beta"))
    with visiting(tmp_path, project, browser, latency=latency) as (studio, person):
        person.press("Alt+1", "2")
        assert set(point_brush(person, "leg_b", 4)) == set(LEGS)
        person.hull("leg_b", "Alt")
        studio.until(lambda hello: hello["history"]["undoable"] == 1)
        assert project.labels(FIRST).labels == {"leg_b": Label("beta")}
        person.press("Control+z")
        studio.until(lambda hello: hello["history"]["undoable"] == 0)
        assert set(point_brush(person, "leg_a", 4)) == set(LEGS)
        person.hull("leg_a")
        person.press("1")
        person.hull("top")
        person.press("p")
        person.sees(LABELLED)
        assert project.labels(FIRST).labels == {**legs, "top": Label("alpha")}
        person.sees("All that is there is used")
        person.sees("gamma: no example, so no hull gets it.")
        assert not person.page.locator("[class*=note-good]").count(), "nothing reassures"
        hello = studio.until(lambda hello: hello["project"]["propagation"] is not None)
        assert (hello["project"]["propagation"]["unused"], hello["history"]["undoable"]) == (0, 3)
        found = {name: one.name for name, one in project.labels(SECOND).labels.items()}
        assert found == {"top": "alpha", **dict.fromkeys(LEGS, "beta")}


def _is_told_why_not(person: Hand) -> None:
    """There is nothing to carry over yet, and the page says what is missing."""
    person.press("Alt+1")
    assert person.button("Label all hulls").is_disabled()
    person.sees("Type the names of the labels first.")
    person.click(person.page.get_by_label("New labels, separated by commas"))
    person.page.keyboard.type(", ".join(WORDS))
    person.press("Enter", "Escape")
    person.sees("names of 4 hulls")


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
    studio.cards(lambda cards: cards[FIRST]["confidence"] == [GIVEN] * len(HULLS))
    person.sees("3 assets have no label: label all hulls.")
    person.sees("names of 3 hulls, 5 labels on 1 asset")


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
    studio.until(lambda hello: (hello["project"]["propagation"] or {}).get("unused") == 2)
    person.sees("2 labels not used yet")


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
    person.click("Label all hulls again")
    person.sees("All that is there is used")
    assert {name: label.name for name, label in project.labels(FIRST).labels.items()} == LABELS


def _taken_back_and_done_again(person: Hand, labels: Path, said: dict[str, bytes]) -> None:
    """Undo and redo."""
    again = tree(labels)
    person.press("Control+z")
    person.sees("Undone: hulls labelled")
    assert tree(labels) == said
    person.press("Control+Shift+Z")
    person.sees("Redone: hulls labelled")
    assert tree(labels) == again
