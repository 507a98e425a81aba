"""What people said is kept as events, one a line: merged by lines, and named by line where it is damaged."""

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest

from meshforge.common import ProjectError
from meshforge.project import Project
from meshforge.store import SnoozeEvent
from meshforge.store.events import parse_events
from meshforge.store.program import ProgramRecord
from meshforge.store.sign_off import SignOffBasis
from meshforge.synthesis import Answer
from tests.unit.project.tables import FIRST, LEGS, THIRD, applied, learned


def lines(*rows: Mapping[str, object]) -> str:
    return "".join(f"{json.dumps(row)}\n" for row in rows)


RIGHT = {"event": "verdict", "asset": THIRD, "verdict": "accepted", "by": "Ada"}
WRONG = {"event": "verdict", "asset": THIRD, "verdict": "wrong", "by": "Bob"}
SNOOZE = {"event": "snooze", "question": "group-1"}


@pytest.mark.parametrize(
    "damage",
    [
        '{"event": "verdict", "asset": "tab',
        "<<<<<<< ours",
        "=======",
        '{"event": "praise"}',
        '{"asset": "a"}',
        '{"event": "verdict", "asset": "a", "verdict": "flagged"}',
        "null",
    ],
)
def test_a_cut_line_and_a_conflict_marker_are_named_with_their_line(tmp_path: Path, damage: str) -> None:
    project = learned(tmp_path)
    project.layout.events.write_text(f"{lines(RIGHT)}\n{damage}\n{lines(SNOOZE)}")
    before = project.layout.events.read_bytes()
    with pytest.raises(ProjectError, match="line 3: ") as raised:
        project.add_events(SnoozeEvent(question="span-1"))
    assert raised.value.where == str(project.layout.events)
    assert raised.value.remedy == "Correct that line by hand, or remove it: each line is one JSON object."
    assert project.layout.events.read_bytes() == before


def test_the_lines_of_two_branches_are_merged_in_either_order(tmp_path: Path) -> None:
    project = learned(tmp_path)
    assert (project.folder / ".gitattributes").read_text() == "events.jsonl merge=union\n"
    project.add_answer(Answer(1, FIRST, ["crumb"]))
    base = project.layout.events.read_text()

    def branch(*changes: Callable[[Project], object]) -> str:
        project.layout.events.write_text(base)
        for change in changes:
            change(project)
        return project.layout.events.read_text().removeprefix(base)

    ours = branch(
        lambda p: p.add_answer(Answer(2, THIRD, LEGS)), lambda p: p.add_events(SnoozeEvent(question="group-1"))
    )
    theirs = branch(lambda p: p.set_verdict(THIRD, "wrong"), lambda p: p.take_back(f"1:{FIRST}"))
    for merged in (base + ours + theirs, base + theirs + ours):
        project.layout.events.write_text(merged)
        said = project.feedback()
        assert list(said.answers) == [f"2:{THIRD}"]
        assert list(said.verdicts) == [THIRD]
        assert said.snoozed == ("group-1",)


@pytest.mark.parametrize(("first", "last"), [(RIGHT, WRONG), (WRONG, RIGHT)])
def test_of_two_people_who_contradict_each_other_the_last_counts(
    tmp_path: Path, first: Mapping[str, object], last: Mapping[str, object]
) -> None:
    project = learned(tmp_path)
    project.layout.events.write_text(lines(first, SNOOZE, last))
    said = project.feedback()
    found = said.verdict_on(THIRD)
    assert found is not None and (found.verdict, found.by) == (last["verdict"], last["by"])
    assert [one.by for one in said.verdicts[THIRD]] == [first["by"], last["by"]]


def test_fields_that_are_not_known_and_line_ends_stay(tmp_path: Path) -> None:
    project = learned(tmp_path)
    odd = {**RIGHT, "mood": {"good": [1, None]}, "verdict": "accepted"}
    project.layout.events.write_bytes(f"\ufeff{lines(odd)}\n{lines(SNOOZE)}".replace("\n", "\r\n").encode())
    project.add_events(SnoozeEvent(question="span-1"))
    rows = [json.loads(line) for line in project.layout.events.read_text().splitlines()]
    assert rows == [odd, SNOOZE, {"event": "snooze", "question": "span-1"}]


def test_what_is_taken_back_is_as_if_it_had_never_been_said(tmp_path: Path) -> None:
    project = applied(tmp_path)
    project.set_verdict(THIRD, "accepted")
    project.set_verdict(THIRD, None)
    project.add_events(SnoozeEvent(question="group-1"))
    project.ask_again()
    said = project.feedback()
    assert not said.verdicts and not said.snoozed
    assert len(project.layout.events.read_text().splitlines()) == 4, "but all of it stays in the file"


def test_keys_of_earlier_versions_are_read() -> None:
    line = {
        "event": "verdict",
        "asset": FIRST,
        "verdict": "accepted",
        "said": {"asked": {"id": "q"}, "reply": {"id": "q"}},
    }
    (event,) = parse_events(json.dumps(line) + "\n", "events.jsonl")
    assert event.origin and event.origin.asked == {"id": "q"}
    assert "said" not in event.model_dump(mode="json") and "origin" in event.model_dump(mode="json")
    assert ProgramRecord.model_validate({"program": "p", "lesson": "digest"}).inputs_digest == "digest"
    basis: dict[str, Any] = {
        "asset": {},
        "labels": None,
        "program": "p",
        "templates": {},
        "settings": "s",
        "software": "",
    }
    earlier = SignOffBasis.model_validate({**basis, "corrections": "edits", "said": "answers"})
    assert (earlier.manual_edits, earlier.answers) == ("edits", "answers")
