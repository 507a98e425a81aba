"""How sure the edits of a project are: what is known of its family, judged, and as the page shows it."""

from __future__ import annotations

from collections.abc import Mapping

from meshforge.common import MeshForgeError
from meshforge.label_model import model_family
from meshforge.language import Program, explain, parse_extractor
from meshforge.project import Project
from meshforge.signoff import Assessment, ReviewChoice, ReviewQuestion, ReviewState, review_family
from meshforge.studio.wire import signoff as wire
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Ambiguous, Demonstration, Found, LearningOutcome


def assess_project(
    project: Project,
    meshes: Mapping[str, SymbolicMesh],
    outcome: LearningOutcome | None,
    number: int,
    later: frozenset[str] = frozenset(),
) -> wire.AssessmentView:
    """How sure the edits of a project are. meshes: those that were learned from; outcome: what that came to; number: of
    the learning run; later: ids of questions that were put off."""
    state = build_review_state(project, meshes, outcome, later)
    assessment = review_family(state, outcome, model_family(list(meshes.values())))
    return view_assessment(assessment, state, number, isinstance(outcome, Found | Ambiguous))


def build_review_state(
    project: Project,
    meshes: Mapping[str, SymbolicMesh],
    outcome: LearningOutcome | None,
    later: frozenset[str] = frozenset(),
) -> ReviewState:
    """All that is known of a project's family; arguments: see `assess_project`.

    A result that was accepted counts while its output is up to date; one that was flagged is set aside.
    """
    limits, program = project.settings.thresholds, outcome.program if outcome else None
    frame = Program(project.vocabulary, project.orientation, (), limits.contact, limits.extremity)
    shown = [asset for asset in project.layout.ids_with("demonstrations") if asset in meshes]
    stale = set(outcome.stale) if outcome else set()
    reviews = [asset for asset in project.reviews() if asset in meshes]
    verdicts = project.status(reviews).assets if reviews else ()
    return ReviewState(
        dict(meshes),
        frame,
        project.templates(program.templates if program else ()),
        {asset: Demonstration(meshes[asset], project.steps(asset), asset) for asset in shown},
        tuple(line.answer for line in project.answers().answers if line.answer not in stale),
        {row.id: () for row in verdicts if row.review == "accepted" and row.is_done},
        aside=frozenset(row.id for row in verdicts if row.review == "flagged"),
        later=later,
    )


def view_assessment(
    assessment: Assessment, state: ReviewState, number: int, has_program: bool = True
) -> wire.AssessmentView:
    """An assessment as the page shows it; without a program no edit has a probability."""
    question = assessment.question
    asked = _view_question(question, state) if question else None
    if not has_program:
        return wire.AssessmentView(number=number, bar=assessment.bar, question=asked)
    signed = set(assessment.signed_off)
    rows = tuple(
        wire.ConfidenceView(
            asset=name,
            probability=round(one.probability, 4),
            doubts=tuple(wire.DoubtView(**doubt.to_json()) for doubt in one.doubts),
            state="aside" if name in assessment.aside else "signed" if name in signed else "held",
            told=name in assessment.looked_at,
        )
        for name, one in assessment.assets.items()
    )
    counts = {what: sum(row.state == what for row in rows) for what in ("signed", "held", "aside")}
    return wire.AssessmentView(
        number=number,
        bar=assessment.bar,
        signed_off=counts["signed"],
        held=counts["held"],
        aside=counts["aside"],
        assets=rows,
        question=asked,
    )


def _view_question(question: ReviewQuestion, state: ReviewState) -> wire.ReviewQuestionView:
    first = next(iter(question.hulls), None)
    return wire.ReviewQuestionView(
        id=question.id,
        kind=question.kind,
        text=question.text,
        seconds=round(question.seconds, 1),
        gain=round(question.gain, 3),
        asset=question.asset,
        rule=question.rule,
        hulls=tuple(
            wire.HullRef(asset=asset, hull=hull, place=state.meshes[asset].index[hull])
            for asset, hull in question.hulls
        ),
        was=state.meshes[first.asset].hull_of(first.hull).label if first else None,
        choices=tuple(map(_view_choice, question.choices)),
    )


def _view_choice(choice: ReviewChoice) -> wire.ReviewChoiceView:
    return wire.ReviewChoiceView(
        text=choice.text, label=choice.label, select=choice.select, sentence=_explain_reading(choice)
    )


def _explain_reading(choice: ReviewChoice) -> str:
    """The extractor of a choice in words, empty where its text is none."""
    if choice.select is None:
        return ""
    try:
        return explain(parse_extractor(choice.text))
    except MeshForgeError:
        return ""
