"""What people said is kept as events, one a line: merged by lines, named by line where it is damaged, and read from the
four files of before."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest

from meshforge.batch import IN_PROCESS
from meshforge.common import ProjectError
from meshforge.project import Project
from meshforge.store import SnoozeEvent
from meshforge.store.events import parse_events
from meshforge.store.feedback import Feedback
from meshforge.store.program import ProgramRecord
from meshforge.store.sign_off import SignOffBasis
from meshforge.symbolic import Label
from meshforge.synthesis import Answer, LabelFix
from tests.unit.batch.families import tree
from tests.unit.deaths import deaths, needs_fork
from tests.unit.project.tables import FIRST, LEGS, SECOND, THIRD, applied, learned

OLD = ("answers.json", "review.json", "signoff.json", "later.json")
SEEN = [{"rule": 1, "action": "Delete", "select": ["crumb"]}, {"rule": 2, "action": "Merge", "select": sorted(LEGS)}]


def in_the_old_format(folder: Path) -> Project:
    """A project that was signed off, then said all there is to say, kept as it was before there were events."""
    project = applied(folder)
    project.set_verdict(FIRST, "accepted")
    project.review(0.5, execution=IN_PROCESS)
    output = next(one for one in project.status(workers=0).assets if one.id == FIRST).output_digest
    fix = {"asset": THIRD, "hull": "crumb", "from": "misc"}
    before = {"label": "misc", "source": "file", "confidence": 1.0}
    answer = {"id": f"1:{THIRD}", "rule": 1, "asset": THIRD, "select": ["crumb"], "action": "Delete", "refused": []}
    neither = {"id": f"2:{THIRD}", "rule": 2, "asset": THIRD, "select": None, "refused": [["top"], []]}
    signed = {name: one.model_dump(exclude={"asset"}) for name, one in project.sign_offs().items()}
    texts: dict[str, dict[str, Any]] = {
        "answers.json": {
            "answers": [answer, neither],
            "confirmed": [{"id": f"{THIRD}#crumb=leg", **fix, "to": "leg", "before": before}],
            "rejected": [{"id": f"{THIRD}#crumb=top", **fix, "to": "top"}],
        },
        "review.json": {
            "assets": {
                FIRST: {"verdict": "accepted", "note": "fine", "output": output, "seen": SEEN},
                SECOND: {"verdict": "flagged", "note": None, "output": None, "seen": []},
                THIRD: {"verdict": "flagged", "note": "set aside", "output": None, "seen": []},
            }
        },
        "signoff.json": {"assets": signed, "aside": ["gone/model.obj"]},
        "later.json": {"questions": ["group-1", "result-2"]},
    }
    project.layout.events.unlink()
    project.layout.sign_offs.unlink()
    for name, text in texts.items():
        (project.folder / name).write_text(json.dumps(text, indent=2))
    return project


def check_all_is_understood(project: Project) -> None:
    said = project.feedback()
    assert [line.answer for line in said.answers.values()] == [
        Answer(1, THIRD, ["crumb"]),
        Answer(2, THIRD, None, [["top"], []]),
    ]
    assert {line.fix: line.accepted for line in said.fixes.values()} == {
        LabelFix(THIRD, "crumb", "misc", "leg"): True,
        LabelFix(THIRD, "crumb", "misc", "top"): False,
    }
    before = said.fixes[f"{THIRD}#crumb=leg"].before
    assert before is not None and before.annotation == Label("misc", 1.0, "file")
    assert {asset: some[-1].verdict for asset, some in said.verdicts.items()} == {
        FIRST: "accepted",
        SECOND: "wrong",
        THIRD: "wrong",
    }
    accepted = said.verdict_on(FIRST)
    assert accepted is not None and accepted.note == "fine" and accepted.output
    assert [(one.rule, one.action, set(one.select)) for one in accepted.seen] == [
        (1, "Delete", {"crumb"}),
        (2, "Merge", LEGS),
    ]
    assert {asset: one.reason for asset, one in said.exclusions.items()} == {
        THIRD: "not solved",
        "gone/model.obj": "not solved",
    }
    assert set(said.snoozed) == {"group-1", "result-2"}
    assert {asset: one.by for asset, one in project.sign_offs().items()} == {
        FIRST: "person",
        SECOND: "person",
        THIRD: "tool",
    }


def test_a_project_of_before_is_understood_and_reading_it_changes_nothing(tmp_path: Path) -> None:
    project = in_the_old_format(tmp_path)
    before = tree(project.folder)
    check_all_is_understood(project)
    states = {one.id: one.sign_off for one in project.status(workers=0).assets}
    assert states == {FIRST: "signed off", SECOND: "needs review", THIRD: "excluded"}
    assert tree(project.folder) == before


WRITES: dict[str, Callable[[Project], object]] = {
    "a snooze": lambda project: project.add_events(SnoozeEvent(question="span-3")),
    "a review": lambda project: project.review(0.5, execution=IN_PROCESS),
    "a vocabulary": lambda project: project.rename_label("top", "board"),
}


@pytest.mark.parametrize("write", WRITES)
def test_the_first_write_makes_events_of_it_and_the_old_files_stay_beside(tmp_path: Path, write: str) -> None:
    project = in_the_old_format(tmp_path)
    old = {name: (project.folder / name).read_bytes() for name in OLD}
    WRITES[write](project)
    assert project.layout.events.exists()
    assert not any((project.folder / name).exists() for name in OLD)
    assert {name: (project.folder / f"{name}.old").read_bytes() for name in OLD} == old
    if write == "a snooze":
        assert project.feedback().snoozed[-1] == "span-3"
        (project.layout.events).write_text(project.layout.events.read_text().replace("span-3", "group-1"))
        check_all_is_understood(project)


@needs_fork
def test_a_killed_migration_loses_nothing(tmp_path: Path) -> None:
    project = in_the_old_format(tmp_path)
    died = 0
    for _ in deaths(lambda: project.add_events(SnoozeEvent(question="group-1"))):
        check_all_is_understood(Project.open(project.folder))
        died += 1
    assert died > len(OLD)
    check_all_is_understood(project)


@pytest.mark.parametrize("name", OLD)
@pytest.mark.parametrize("text", ["[", "[1]", '{"answers": [1], "assets": {"a": {}}, "aside": 1, "questions": [[]]}'])
def test_a_damaged_file_of_before_is_named_and_kept(tmp_path: Path, name: str, text: str) -> None:
    project = learned(tmp_path)
    (project.folder / name).write_text(text)
    with pytest.raises(ProjectError, match=name.replace(".", r"\.")):
        project.add_events(SnoozeEvent(question="group-1"))
        project.sign_offs()
    assert (project.folder / name).read_text() == text and not project.layout.events.exists()


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


def test_the_order_is_that_of_the_file_whatever_clocks_say() -> None:
    late, early = {**RIGHT, "when": "2026-11-28T12:00:00Z"}, {**WRONG, "when": "2020-01-01T00:00:00Z"}
    found = Feedback.of(parse_events(lines(late, early), "here")).verdict_on(THIRD)
    assert found is not None and found.verdict == "wrong"


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
