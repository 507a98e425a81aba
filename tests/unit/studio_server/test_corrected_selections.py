"""A slip that is admitted in the studio: what is corrected, and that undo brings all of it back."""

from __future__ import annotations

from pathlib import Path

from meshforge.project import Project
from meshforge.signoff import MistakeQuestion, ReviewChoice
from meshforge.store import History
from meshforge.studio.edits.base import make_edit
from meshforge.synthesis import Answer
from tests.unit.project.tables import FIRST, THIRD, applied
from tests.unit.studio_server.test_replies import edit_of

MEANT = ("crumb", "left_low")


def kept(project: Project) -> list[bytes | None]:
    """What a person said, as it is on disk."""
    paths = [project.folder / name for name in (f"demonstrations/{FIRST}.json", "events.jsonl")]
    return [path.read_bytes() if path.exists() else None for path in paths]


def correct(project: Project, history: History, asset: str) -> bool:
    choices = (ReviewChoice("no", "no", select=("crumb",)), ReviewChoice("yes", "yes", select=MEANT))
    question = MistakeQuestion("?", 3.0, 1.0, asset, 1, (), choices, "selection-1")
    return make_edit(history, project, edit_of(question, project, {"choice": "yes"})) is not None


def test_undo_brings_a_demonstration_an_answer_and_a_verdict_back(tmp_path: Path) -> None:
    project = applied(tmp_path)
    project.set_verdict(THIRD, "accepted")
    history, states = History.open(project.folder), [kept(project)]
    for asset in (FIRST, THIRD):
        assert correct(project, history, asset)
        states.append(kept(project))
    assert project.steps(FIRST)[0].select == frozenset(MEANT)
    said = project.feedback()
    assert [one.answer for one in said.answers.values()] == [Answer(1, THIRD, MEANT)]
    assert said.verdict_on(THIRD) is None
    for before in reversed(states[:-1]):
        assert history.undo()
        assert kept(project) == before
