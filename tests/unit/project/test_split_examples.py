"""A split that a person made, proposed for the hulls of other assets that look alike."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from meshforge.project import Project, list_span_questions
from meshforge.signoff import SpanQuestion
from meshforge.signoff.question import NO, YES
from tests.unit.project.stools import create_stools
from tests.unit.project.test_span_questions import HULL, answer, ask, asked
from tests.unit.project.test_spans import files

SHOWN = "c.urdf"
OTHERS = {"a.urdf", "b.urdf", "d.urdf"}


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Four stools without labels, of which the first hull spans the seat and a leg; one is cut below its seat."""
    folder = tmp_path_factory.mktemp("stools")
    sizes = {"a": (0.2, 0.4), "b": (0.22, 0.45), "c": (0.18, 0.38), "d": (0.19, 0.42)}
    create_stools(folder, sizes, "abcd").cut(SHOWN, HULL, (0, 0, 0.38), (0, 0, 1))
    return folder


@pytest.fixture
def project(made: Path, tmp_path: Path) -> Project:
    shutil.copytree(made, tmp_path, dirs_exist_ok=True)
    return Project.open(tmp_path / "p")


def label(project: Project, below: str = "leg", above: str = "seat") -> None:
    project.set_labels(SHOWN, {f"{HULL}#0": below, f"{HULL}#1": above})


def ask_until_done(project: Project, choice: str) -> list[SpanQuestion]:
    found = list[SpanQuestion]()
    while asked(project):
        found.append(answer(project, choice))
        assert len(found) <= len(OTHERS), "it is asked again"
    return found


def test_nothing_is_asked_before_the_parts_have_labels_of_which_two_differ(project: Project) -> None:
    assert asked(project) is None
    label(project, "leg", "leg")
    assert asked(project) is None
    label(project)
    question = ask(project)
    assert question.asset in OTHERS and question.hulls[0].hull == HULL
    assert question.text.startswith(f"{HULL} of {question.asset} looks like {HULL} of {SHOWN}, ")
    assert question.text.endswith("%: split as that was?")
    assert question.choices[1].text == "split so: leg, seat"


def test_yes_splits_each_look_alike_by_the_plane_carried_over_once(project: Project) -> None:
    label(project)
    answered = ask_until_done(project, YES)
    assert {question.asset for question in answered} == OTHERS
    for asset, height in (("a.urdf", 0.44), ("b.urdf", 0.49), ("d.urdf", 0.46)):
        below, above = (project.mesh(asset).hull_of(f"{HULL}#{k}") for k in range(2))
        assert (below.label, above.label) == ("leg", "seat")
        assert above.aabb.min[2] == pytest.approx(height * 0.38 / 0.42)
    (step,) = project.preparation("a.urdf").steps
    assert step.do == "divide" and step.settings["like"] == f"{HULL} of {SHOWN}"


def test_an_answer_is_undone_to_the_last_byte_and_no_is_remembered(project: Project) -> None:
    label(project)
    before = files(project)
    first = answer(project, YES).asset
    project.unprepare(first)
    assert {name: data for name, data in files(project).items() if name != "events.jsonl"} == before
    assert {question.asset for question in ask_until_done(project, NO)} == OTHERS
    assert set(project.single_parts().assets) == OTHERS


def test_a_split_that_is_taken_back_is_proposed_no_more(project: Project) -> None:
    label(project)
    assert asked(project)
    project.unprepare(SHOWN)
    assert asked(project) is None


def test_a_damaged_preparation_shows_nothing_and_stops_nothing(project: Project) -> None:
    label(project)
    meshes = dict(project.meshes_by_id())
    (project.layout.preparation(SHOWN) / "preparation.json").write_text("{")
    assert list_span_questions(project, meshes) == []


def test_look_alikes_are_found_anew_under_another_contact_threshold(project: Project) -> None:
    label(project)
    ask(project)
    before = project.lookalike_spans()
    ask(project)
    assert project.lookalike_spans() == before
    toml = project.layout.settings
    toml.write_text(toml.read_text() + "\n[thresholds]\ncontact = 0.01\n")
    project = Project.open(project.folder)
    ask(project)
    assert project.lookalike_spans().key != before.key
