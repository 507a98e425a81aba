"""The paper's running example in the browser: from files to exported assets, with accidents on the way."""

from __future__ import annotations

import re
import shutil
import signal
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser

from meshforge.formats import load
from meshforge.language import Program, show
from meshforge.project import Project
from meshforge.samples import TABLES
from tests.e2e.hand import Hand, hand, windows
from tests.e2e.studio import PATIENCE, Studio, opened
from tests.e2e.walk import (
    FIRST,
    PAGE,
    SECOND,
    address,
    click_row,
    drawers,
    go_to,
    guessed,
    handles,
    legs,
    orient_by_clicking,
    splinters,
    stepped,
    top,
)

ADDED = "added/table_11.obj"
MISLABELLED = "convex_60"
MEANT = [show(rule.extractor) for rule in Program.read(TABLES / "tables.mf").rules]


@pytest.mark.long
def test_from_files_to_exported_assets_with_accidents_on_the_way(tmp_path: Path, browser: Browser) -> None:
    project = _tables(tmp_path)
    with windows(browser):
        person = hand(browser)
        with opened(tmp_path, project, "--page", str(PAGE)) as studio:
            person.open(address(studio))
            _import_one(person, tmp_path)
            _label(person)
            person.press("Alt+2")
            go_to(person, FIRST)
            orient_by_clicking(person)
            splinters(person)
            top(person)
            person.page.reload()
            person.drawn(FIRST)
            person.press("Alt+2")
            stepped(person, 2)
            legs(person)
            port = studio.base.rpartition(":")[2]
            studio.process.send_signal(signal.SIGKILL)
            studio.process.wait(PATIENCE)
            person.sees("Connection lost")
        with opened(tmp_path, project, "--page", str(PAGE), "--port", port) as studio:
            person.open(address(studio))
            other = hand(browser)
            other.open(address(studio))
            person.press("Alt+2")
            go_to(person, FIRST)
            stepped(person, 3)
            drawers(person)
            handles(person)
            assert _answer(person, studio) > 0
            _second_table(person)
            _repair(person, studio)
            _review(person, other, studio, tmp_path)
            assert _rules(studio) == TABLES.joinpath("tables.mf").read_text(encoding="utf-8").split("\n\n")[-1].strip()
        assert not person.complaints
        assert not other.complaints
    exported = sorted(path.name for path in (project / "export").rglob("*.obj"))
    assert "table_01.obj" in exported
    assert "table_02.obj" not in exported, "it is wrong"
    assert len(load(project / "export" / "table_01.obj").hulls) < len(load(TABLES / "table_01.obj").hulls)


def _tables(folder: Path) -> Path:
    """A project of ten tables that have labels files, a template, and nothing else."""
    (folder / "assets").mkdir()
    (folder / "more").mkdir()
    for number in range(1, 12):
        for source in TABLES.glob(f"table_{number:02}.*"):
            shutil.copyfile(source, folder / ("assets" if number < 11 else "more") / source.name)
    project = Project.create(folder / "project", [folder / "assets" / "*.obj"], name="tables").folder
    shutil.copytree(TABLES / "templates", project / "templates", dirs_exist_ok=True)
    return project


def _import_one(person: Hand, folder: Path) -> None:
    """Files that are no assets are refused in words; a table comes in with its labels."""
    picker = person.page.get_by_label("Files to add")
    (folder / "more" / "notes.obj").write_text("nothing of a mesh", encoding="utf-8")
    picker.set_input_files(folder / "more" / "notes.obj")
    person.sees("this is no OBJ file")
    picker.set_input_files([folder / "more" / "table_11.obj", folder / "more" / "table_11.labels.json"])
    person.page.get_by_role("option", name=ADDED).first.wait_for()


def _label(person: Hand) -> None:
    """Labels come from the files; one of them is wrong."""
    person.press("Alt+1")
    person.click(person.page.get_by_label("New labels, separated by commas"))
    person.page.keyboard.type("panel, leg, handle, drawer, misc")
    person.press("Enter")
    person.sees("labels files beside")
    person.click("Label all hulls")
    person.sees("All labels by source")
    go_to(person, SECOND)
    click_row(person, MISLABELLED)
    person.press("2")
    person.sees(f"1 hull of {SECOND} labelled leg")


def _answer(person: Hand, studio: Studio) -> int:
    """Take the choice that is meant, of everything that is asked; gives how many questions there were."""
    person.press("Alt+3")
    answered = 0
    while (question := _assessed(studio)["question"]) and question["kind"] in ("candidate", "label"):
        place = [choice["text"] for choice in question["choices"]].index(MEANT[question["rule"] - 1])
        card = person.page.get_by_role("region", name=re.compile(f"which hulls should rule {question['rule']} take"))
        person.click(card.get_by_role("button").nth(place))
        answered += 1
        studio.until(partial(_has_said, answered))
    return answered


def _assessed(studio: Studio) -> dict[str, Any]:
    found = studio.until(lambda hello: not hello["assessing"] and hello["assessment"] is not None)["assessment"]
    return dict(found)


def _has_said(answers: int, hello: dict[str, Any]) -> bool:
    return len([said for said in hello["project"]["answers"] if said["kind"] == "answer"]) == answers


def _second_table(person: Hand) -> None:
    """Take what is guessed, but for the hull that has a wrong label."""
    person.press("Alt+2")
    go_to(person, SECOND)
    guessed(person, 1)
    click_row(person, MISLABELLED, modifiers=["ControlOrMeta"])
    person.press("Enter")
    stepped(person, 1)
    for step in range(2, 6):
        guessed(person, step)
        person.press("Enter")
        stepped(person, step)


def _repair(person: Hand, studio: Studio) -> None:
    studio.until(lambda hello: bool(hello["outcome"] and hello["outcome"]["repairs"]))
    person.press("Alt+3")
    card = person.page.get_by_role("region", name=f"{MISLABELLED} of {SECOND} is called")
    person.click(card.get_by_role("button", name="It is misc"))
    person.sees("1 hull labelled misc")
    studio.until(lambda hello: not hello["learning"] and hello["outcome"]["status"] in ("found", "ambiguous"))


def _review(person: Hand, other: Hand, studio: Studio, folder: Path) -> None:
    """Apply to all, accept one, call one wrong, which the other page shows; export what is signed off."""
    person.press("Alt+4")
    person.click("Apply to all")
    studio.cards(lambda cards: all(card["output"] in ("edited", "unchanged", "failed") for card in cards.values()))
    go_to(person, "table_01.obj")
    person.press("y")
    studio.cards(lambda cards: cards["table_01.obj"]["review"] == "accepted")
    go_to(person, "table_02.obj")
    person.press("f")
    studio.cards(lambda cards: cards["table_02.obj"]["review"] == "wrong")
    other.page.get_by_role("option", name=re.compile("table_02.obj.*wrong", re.IGNORECASE)).wait_for()
    hollow = folder / "more" / "hollow.obj"
    hollow.write_text("v 0 0 0\n", encoding="utf-8")
    for _ in range(2):  # messages of problems stay: what is below them can still be scrolled to
        person.page.get_by_label("Files to add").set_input_files(hollow)
    person.page.get_by_role("alert").filter(has_text="Nothing was added").nth(0).wait_for()
    person.click(person.page.get_by_role("radio", name="Export"))
    person.click(person.page.get_by_role("button", name=re.compile("^Export [1-9][0-9]* asset")))
    person.sees("The last export")


def _rules(studio: Studio) -> str:
    program: str = studio.settled()["outcome"]["program"]
    return program.split("\n\n")[-1].strip()
