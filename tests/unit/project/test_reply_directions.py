"""What every kind of reply does to the probabilities of a family, by `Project.reply` and by `review --answers`."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.unit.cli.in_process import runner
from tests.unit.project.racks import BLOCK
from tests.unit.project.replying import (
    CASES,
    STRICT,
    Direction,
    copy,
    find_question,
    look,
    probabilities,
    reply_by_method,
    review_once,
)


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    return review_once(tmp_path_factory)


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
