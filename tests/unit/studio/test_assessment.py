"""How sure edits are, as pages are told; and labels of a group."""

from meshforge.language import Program
from meshforge.project import Project
from meshforge.signoff import (
    THRESHOLD,
    Assessment,
    HullPlace,
    Reason,
    ResultStatus,
    ReviewChoice,
    ReviewQuestion,
    ReviewState,
)
from meshforge.signoff.question import QuestionKind
from meshforge.studio.edits.assets import LabelHulls
from meshforge.studio.learning.results import view_assessment

ONE, OTHER = "table_01.obj", "table_02.obj"


def assessment_of(*questions: ReviewQuestion) -> Assessment:
    rows = {
        ONE: ResultStatus(0.999),
        OTHER: ResultStatus(0.62, (Reason("alarm", "nearly one solid block", share=0.3),)),
        "wrong": ResultStatus(0.99),
        "away": ResultStatus(0.1),
    }
    wrong, looked_at = frozenset({"wrong"}), frozenset({ONE})
    return Assessment(rows, looked_at=looked_at, wrong=wrong, excluded={"away": "not solved"}, questions=questions)


def test_each_asset_is_signed_off_held_or_excluded_and_counted() -> None:
    view = view_assessment(assessment_of(), ReviewState({}, Program()))
    assert (view.threshold, view.signed_off, view.need_review, view.excluded) == (THRESHOLD, 1, 2, 1)
    assert [(row.asset, row.state, row.reviewed) for row in view.assets] == [
        (ONE, "signed", True),
        (OTHER, "needs review", False),
        ("wrong", "needs review", False),
        ("away", "excluded", False),
    ]
    assert view.assets[1].probability == 0.62
    assert [doubt.text for doubt in view.assets[1].reasons] == ["nearly one solid block"]


def test_without_a_program_no_edit_has_a_probability() -> None:
    view = view_assessment(assessment_of(), ReviewState({}, Program()), has_program=False)
    assert (view.assets, view.signed_off, view.need_review) == ((), 0, 0)


def test_a_question_says_where_its_hulls_are_and_what_its_readings_mean(project: Project) -> None:
    mesh = project.mesh(ONE)
    hull = mesh.hulls[2].name
    choices = (ReviewChoice("a", "Is(leg)", select=(hull,)), ReviewChoice("right", "right"))
    state = ReviewState({ONE: mesh}, Program())
    kinds: tuple[QuestionKind, ...] = ("group", "candidate")
    for kind in kinds:
        question = ReviewQuestion(kind, "?", 4.0, 1.2, ONE, 1, (HullPlace(ONE, hull),), choices, "q")
        asked = view_assessment(assessment_of(question), state).question
        assert asked and asked.kind == question.kind
        assert [(one.hull, one.place) for one in asked.hulls] == [(hull, 2)]
        assert [(choice.id, choice.sentence) for choice in asked.choices] == [("a", "the leg hulls"), ("right", "")]


def test_a_group_gets_its_label_in_one_edit(project: Project) -> None:
    edit = LabelHulls(hulls={asset: (project.mesh(asset).hulls[0].name,) for asset in (ONE, OTHER)}, label="drawer")
    assert edit.describe(project) == "2 hulls of 2 assets labelled drawer"
    assert edit.list_paths(project) == tuple(project.layout.labels(asset) for asset in (ONE, OTHER))
    edit.apply(project)
    for asset, (hull,) in edit.hulls.items():
        label = project.mesh(asset).hull_of(hull).annotation
        assert label and (label.name, label.source) == ("drawer", "user")
