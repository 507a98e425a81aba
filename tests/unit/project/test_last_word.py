"""Two people reply otherwise to one question, one after the other: the first word counts until it is taken back. What
every kind of reply does to the probabilities of a family, by `Project.reply` and by `review --answers`."""

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from meshforge.project import Project, ProjectReview
from tests.loop.command import Done
from tests.unit.cli.in_process import Run, runner
from tests.unit.project.racks import BLOCK
from tests.unit.project.replying import (
    ASKED,
    CASES,
    STRICT,
    Case,
    Direction,
    copy,
    find_question,
    look,
    probabilities,
    reply_by_method,
    review_once,
)
from tests.unit.project.shelves import SHELVED


class Place(NamedTuple):
    """A project and what replies are given with. first: to the question, by Ada; question: its id."""

    project: Project
    run: Run
    question: str

    def say(self, reply: Mapping[str, Any], by: str) -> Done:
        Path("said.json").write_text(json.dumps([{"id": self.question, **reply}]))
        options = "--min-confidence", str(STRICT), "--answers", "said.json", "--by", by
        return self.run("review", self.project.folder.name, *options)


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    return review_once(tmp_path_factory)


@pytest.fixture
def place(
    made: Callable[[str], Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Callable[[Case], Place]:
    monkeypatch.setattr("meshforge.cli.review.draw_question", lambda *_: [])  # pictures are slow
    count = iter(range(9))

    def ask(case: Case) -> Place:
        project = copy(made(case.family), tmp_path / str(next(count)), monkeypatch)
        question = find_question(look(project), case.kind, case.asset)
        return Place(project, runner(monkeypatch, capsys), question.id)

    return ask


PAIRS = (
    ("right", "wrong", f"--forget {ASKED}"),
    ("wrong, other hulls", "right", f"--forget {ASKED}"),
    ("not solved", "right", f"--forget {ASKED}"),
    ("later", "right", "--again"),
    ("the reading that stands out", "another reading", f"--forget 1:{SHELVED}"),
)


@pytest.mark.slow
@pytest.mark.parametrize(("first", "last", "way"), PAIRS)
def test_another_reply_to_a_question_counts_once_the_one_before_is_taken_back(
    place: Callable[[Case], Place], first: str, last: str, way: str
) -> None:
    alone = place(CASES[last])
    alone.say(CASES[last].reply, "Ada")
    both = place(CASES[first])
    both.say(CASES[first].reply, "Ada")
    before = both.project.layout.events.read_bytes()
    told = both.say(CASES[last].reply, "Bob")
    assert told.code == 1 and f"{both.question}: Ada said {{" in told.err and "so the reply is skipped" in told.err
    assert f"to change that: meshforge review {both.project.folder} {way}\n" in told.err
    assert both.project.layout.events.read_bytes() == before
    assert f"{both.question}: it was replied to before" in both.say(CASES[first].reply, "Ada").err
    both.run("review", both.project.folder.name, *way.split())
    told = both.say(CASES[last].reply, "Bob")
    assert "is skipped" not in told.err
    assert sums(look(both.project)) == sums(look(alone.project))


STAYS = (("a slip", "no slip"), ("turned", "not turned"), ("a group is something else", "none of the labels"))


@pytest.mark.parametrize(("first", "last"), STAYS)
def test_what_lies_in_other_files_is_said_to_be_by_hand(place: Callable[[Case], Place], first: str, last: str) -> None:
    both = place(CASES[first])
    both.say(CASES[first].reply, "Ada")
    before, events = sums(look(both.project)), both.project.layout.events.read_bytes()
    told = both.say({"choice": None} if last not in CASES else CASES[last].reply, "Bob")
    assert told.code == 1 and "so the reply is skipped" in told.err
    assert "to change that: its demonstration, its labels, or its hulls, by hand" in told.err
    assert (sums(look(both.project)), both.project.layout.events.read_bytes()) == (before, events)


def sums(found: ProjectReview) -> object:
    return probabilities(found), found.assessment.need_review, found.assessment.excluded, found.assessment.looked_at


@pytest.mark.parametrize("road", ["Project.reply", "review --answers"])
@pytest.mark.parametrize("name", CASES)
def test_a_reply_moves_probabilities_as_it_should(
    made: Callable[[str], Path],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    name: str,
    road: str,
) -> None:
    case = CASES[name]
    project = copy(made(case.family), tmp_path, monkeypatch)
    before = look(project)
    question = find_question(before, case.kind, case.asset)
    if road == "Project.reply":
        reply_by_method(project, question, case.reply)
    else:
        monkeypatch.setattr("meshforge.cli.review.draw_question", lambda *_: [])  # pictures are slow
        Path("said.json").write_text(json.dumps([{"id": question.id, **case.reply}]))
        options = "--min-confidence", str(STRICT), "--answers", "said.json", "--by", "Ada"
        told = runner(monkeypatch, capsys)("review", project.folder.name, *options)
        assert "is not asked any more" not in told.err
        assert all('"by":"Ada"' in line for line in project.layout.events.read_text().splitlines())
    after = look(project)
    assert question.id in project.feedback().replied
    was, now = probabilities(before), probabilities(after)
    seen = {*before.state.reviewed_assets, *after.state.reviewed_assets, case.asset, BLOCK}
    check(case.others, [(was[one], now[one]) for one in now if one not in seen])
    check(case.own, [(was[case.asset], now.get(case.asset, 0.0))])
    assert question.id not in {one.id for one in after.assessment.questions} or name.startswith("wrong")


def check(direction: Direction, pairs: list[tuple[float, float]]) -> None:
    assert pairs
    for was, now in pairs:
        assert {"up": now > was, "down": now < was, "same": now == was, "any": True}[direction], (was, now)
