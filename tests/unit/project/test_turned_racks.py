"""The question whether assets are to be turned, in a project: what a reply does, and how it is shown."""

from pathlib import Path

import pytest

from meshforge.cli.review_session import draw_question
from meshforge.project import Project
from meshforge.signoff import ReviewQuestion, ReviewReply
from meshforge.signoff.question import NO, YES
from tests.unit.project.replying import look
from tests.unit.project.turned_racks import racks_on_their_side


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return racks_on_their_side(tmp_path)


def asked(project: Project) -> list[ReviewQuestion]:
    return [one for one in look(project).assessment.questions if one.kind == "orientation"]


def test_each_choice_has_a_picture_of_the_asset(project: Project) -> None:
    (question,) = asked(project)
    now, then = draw_question(project, look(project), question)
    assert [path.stem.rpartition("-")[2] for path in (now, then)] == [NO, YES]
    assert now.read_bytes() != then.read_bytes()


def test_what_would_be_edited_otherwise_is_doubtful_until_somebody_said_no(project: Project) -> None:
    (question,) = asked(project)
    open_, lying = look(project).assessment, ("rack2.obj", "rack5.obj")
    assert all(any(doubt.kind == "orientation" for doubt in open_.assets[name].reasons) for name in lying)
    project.reply(question, ReviewReply(question.id, NO))
    refused = look(project).assessment
    assert not any(doubt.kind == "orientation" for name in lying for doubt in refused.assets[name].reasons)
