"""A slip that is admitted in the studio: what is corrected, and that undo brings all of it back."""

from __future__ import annotations

from pathlib import Path

import pytest

from meshforge.common import ProjectError
from meshforge.project import Project
from meshforge.studio.edits.program import CorrectSelection
from meshforge.studio.history import History
from meshforge.synthesis import Answer
from tests.unit.project.tables import FIRST, THIRD, applied

MEANT = ("crumb", "left_low")


def correct(asset: str) -> CorrectSelection:
    return CorrectSelection(asset=asset, rule=1, select=MEANT)


def kept(project: Project) -> list[bytes | None]:
    """What a person said, as it is on disk."""
    paths = [project.folder / name for name in (f"demonstrations/{FIRST}.json", "answers.json", "review.json")]
    return [path.read_bytes() if path.exists() else None for path in paths]


def test_undo_brings_a_demonstration_an_answer_and_a_verdict_back(tmp_path: Path) -> None:
    project = applied(tmp_path)
    project.set_verdict(THIRD, "accepted")
    history, states = History(project), [kept(project)]
    for asset in (FIRST, THIRD):
        assert history.do(project, correct(asset))
        states.append(kept(project))
    assert project.steps(FIRST)[0].select == frozenset(MEANT)
    assert [line.answer for line in project.answers().answers] == [Answer(1, THIRD, MEANT)]
    assert THIRD not in project.reviews()
    for before in reversed(states[:-1]):
        assert history.undo(project)
        assert kept(project) == before


def test_what_nobody_said_cannot_be_corrected(tmp_path: Path) -> None:
    project = applied(tmp_path)
    before = kept(project)
    with pytest.raises(ProjectError, match="rule 1 is not demonstrated here any more"):
        History(project).do(project, correct(THIRD))
    assert kept(project) == before
