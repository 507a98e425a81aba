"""How sure edits are, as pages are told; and the edits that replies become."""

from __future__ import annotations

import pytest

from meshforge.language import Program
from meshforge.project import Project
from meshforge.signoff import Assessment, AssetConfidence, Doubt, HullPlace, ReviewChoice, ReviewQuestion, ReviewState
from meshforge.studio.edits.assets import GroupHull, LabelGroup, MarkAsOnePart
from meshforge.studio.edits.program import PutOff
from meshforge.studio.learning.assessment import view_assessment
from meshforge.studio.session.file_sync import changes_of
from tests.studio_project import demo_project

ONE, OTHER = "table_01.obj", "table_02.obj"


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Project:
    return demo_project(tmp_path_factory.mktemp("tables"))


def assessment_of(question: ReviewQuestion | None = None) -> Assessment:
    rows = {
        ONE: AssetConfidence(ONE, 0.97),
        OTHER: AssetConfidence(OTHER, 0.62, (Doubt("alarm", "nearly one solid block", share=0.3),)),
        "aside": AssetConfidence("aside", 0.1),
    }
    return Assessment(rows, aside=frozenset({"aside"}), looked_at=frozenset({ONE}), question=question)


def test_each_asset_is_signed_off_held_or_set_aside_and_counted() -> None:
    view = view_assessment(assessment_of(), ReviewState({}, Program()), 3)
    assert (view.number, view.bar, view.signed_off, view.held, view.aside) == (3, 0.95, 1, 1, 1)
    assert [(row.asset, row.state, row.told) for row in view.assets] == [
        (ONE, "signed", True),
        (OTHER, "held", False),
        ("aside", "aside", False),
    ]
    assert view.assets[1].probability == 0.62
    assert [doubt.text for doubt in view.assets[1].doubts] == ["nearly one solid block"]


def test_without_a_program_no_edit_has_a_probability() -> None:
    view = view_assessment(assessment_of(), ReviewState({}, Program()), 3, has_program=False)
    assert (view.assets, view.signed_off, view.held) == ((), 0, 0)


def test_a_question_says_where_its_hulls_are_and_what_its_readings_mean(project: Project) -> None:
    mesh = project.mesh(ONE)
    hull = mesh.hulls[2].name
    choices = (ReviewChoice("Is(leg)", select=(hull,)), ReviewChoice("right"))
    question = ReviewQuestion("q", "group", "?", 4.0, 1.2, ONE, 1, (HullPlace(ONE, hull),), choices)
    asked = view_assessment(assessment_of(question), ReviewState({ONE: mesh}, Program()), 1).question
    assert asked
    assert [(one.hull, one.place) for one in asked.hulls] == [(hull, 2)]
    assert asked.was == mesh.hulls[2].label
    assert [choice.sentence for choice in asked.choices] == ["the leg hulls", ""]


def test_a_group_gets_its_label_in_one_edit(project: Project) -> None:
    places = [GroupHull(asset=asset, hull=project.mesh(asset).hulls[0].name) for asset in (ONE, OTHER)]
    edit = LabelGroup(hulls=tuple(places), label="drawer")
    assert edit.describe(project) == "2 hulls of 2 assets labelled drawer"
    assert edit.list_paths(project) == tuple(project.layout.labels(asset) for asset in (ONE, OTHER))
    edit.apply(project)
    for place in places:
        label = project.mesh(place.asset).hull_of(place.hull).annotation
        assert label and (label.name, label.source) == ("drawer", "user")


def test_exceptions_of_a_group_get_their_own_label_in_the_same_edit(project: Project) -> None:
    first, second = (mesh.hulls[0].name for mesh in map(project.mesh, (ONE, OTHER)))
    hulls = (GroupHull(asset=ONE, hull=first), GroupHull(asset=OTHER, hull=second, label="leg"))
    edit = LabelGroup(hulls=hulls, label="drawer")
    assert edit.describe(project) == "2 hulls of 2 assets: 1 drawer, 1 leg"
    edit.apply(project)
    given = [project.mesh(one.asset).hull_of(one.hull).annotation for one in hulls]
    assert [(label.name, label.source) for label in given if label] == [("drawer", "user"), ("leg", "user")]


def test_a_question_that_is_put_off_is_judged_anew_without_learning(project: Project) -> None:
    edit = PutOff(id="group-1")
    edit.apply(project)
    assert project.put_off_ids() == ("group-1",)
    paths = edit.list_paths(project)
    assert paths == (project.layout.later,)
    changes = changes_of(project, [str(path.relative_to(project.folder)) for path in paths])
    assert changes.questions
    assert not changes.learning


def test_what_is_said_of_hulls_that_span_parts_is_judged_anew_without_learning(project: Project) -> None:
    hull = project.mesh(ONE).hulls[0].name
    edit = MarkAsOnePart(asset=ONE, hull=hull)
    edit.apply(project)
    assert list(project.single_parts().assets[ONE]) == [hull]
    assert edit.list_paths(project) == (project.layout.single_parts,)
    for path in (project.layout.single_parts, project.layout.spans):
        changes = changes_of(project, [str(path.relative_to(project.folder))])
        assert changes.questions and not changes.learning and not changes.assets
