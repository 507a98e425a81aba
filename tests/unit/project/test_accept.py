"""Results that a person accepts one by one are learned from."""

import json
from pathlib import Path

import pytest

from meshforge.batch import IN_PROCESS
from meshforge.language import Delete
from meshforge.project import Project
from meshforge.synthesis import Ambiguous, Found, Options, Step
from tests.unit.project.shelves import ambiguous

SHELVED, ALSO = "rack2.obj", "rack3.obj"
BOARDS = "Is(board) => Delete"


def applied(folder: Path) -> Project:
    """A project in which it is open whether boards or the highest boards are deleted; the program takes all."""
    project = ambiguous(folder)
    assert isinstance(project.synthesize(), Ambiguous)
    assert BOARDS in str(project.program())
    list(project.apply(execution=IN_PROCESS))
    return project


@pytest.mark.slow
def test_what_was_accepted_by_itself_settles_what_was_open(tmp_path: Path) -> None:
    project = applied(tmp_path)
    project.set_verdict(SHELVED, "accepted")
    (seen,) = json.loads(project.layout.events.read_text())["seen"]
    assert seen == {"rule": 1, "action": "Delete", "select": ["shelf", "top"]}
    outcome = project.synthesize()
    assert isinstance(outcome, Found) and outcome.unambiguous
    assert BOARDS in str(outcome.program)
    assert not outcome.stale and not outcome.overruled
    project.set_verdict(SHELVED, None)
    assert isinstance(project.synthesize(), Ambiguous)


def test_a_demonstration_counts_more_than_an_accepted_result(tmp_path: Path) -> None:
    project = applied(tmp_path)
    project.set_verdict(SHELVED, "accepted")
    project.demonstrate(SHELVED, [Step(1, {"top"}, Delete())])
    outcome = project.synthesize()
    assert isinstance(outcome, Found)
    assert "Geo(Is(board), +Z) => Delete" in str(outcome.program)


@pytest.mark.slow
def test_where_no_program_keeps_what_was_accepted_it_is_overruled_and_named(tmp_path: Path) -> None:
    project = applied(tmp_path)
    project.set_verdict(SHELVED, "accepted")
    project.demonstrate(ALSO, [Step(1, {"top"}, Delete())])
    outcome = project.synthesize(options=Options(repair=False))
    assert isinstance(outcome, Found)
    assert outcome.overruled == (SHELVED,)
    assert "Geo(Is(board), +Z) => Delete" in str(outcome.program)
    list(project.apply(execution=IN_PROCESS))
    assert all(asset.review is None for asset in project.status(workers=0).assets)
    again = project.synthesize(options=Options(repair=False))
    assert again.overruled == ()  # its output is another one now, which nobody accepted
