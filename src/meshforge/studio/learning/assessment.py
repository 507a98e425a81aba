"""How sure the edits of a project are: what is known of its family, judged, kept, and as the page shows it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from meshforge.common import MeshForgeError
from meshforge.label_model import model_family
from meshforge.language import Program, explain, parse_extractor, show
from meshforge.project import (
    AssessmentBasis,
    Project,
    add_demonstration_doubts,
    add_span_doubts,
    ask_about_spans,
    keep_assessment,
    list_span_questions,
    measure_results,
    sees_whole_family,
)
from meshforge.signoff import (
    BAR,
    Assessment,
    EditMeasures,
    ReviewChoice,
    ReviewQuestion,
    ReviewState,
    describe_odd_results,
    review_family,
)
from meshforge.studio.wire import signoff as wire
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Found, LearningOutcome


@dataclass(frozen=True, eq=False, slots=True)
class ProjectAssessment:
    """How sure the edits of a project are. program: the one that makes them, None where there is none; basis: what all
    that was computed from; measures: of the edits, by asset."""

    found: Assessment
    state: ReviewState
    program: Program | None
    basis: AssessmentBasis
    measures: Mapping[str, EditMeasures]

    def keep(self, project: Project) -> None:
        """Keep it as a review does, and renew sign-offs; nothing where something changed meanwhile, where there is no
        program, or where the studio looks at some assets only."""
        if self.program is None or not sees_whole_family(project):
            return
        if keep_assessment(project, self.found, self.basis.under(project, self.program), self.measures):
            project.renew_sign_offs(keep_persons=True)


def assess_project(
    project: Project,
    meshes: Mapping[str, SymbolicMesh],
    outcome: LearningOutcome | None,
    basis: AssessmentBasis,
    stop: Callable[[], bool] = lambda: False,
) -> ProjectAssessment | None:
    """How sure the edits of a project are under its program, None where that was interrupted.

    meshes: those that were learned from; outcome: what that came to, which does not matter where a person wrote the
    program; basis: taken before the meshes were read.
    """
    accepted = project.program() if project.program_state().by_hand else None
    judged = (
        outcome
        if accepted is None
        else Found(rules=accepted.rules, readings=(), tried=(), seconds={}, program=accepted)
    )
    program = judged.program if judged else None
    inputs = basis.under(project, program or project.program()).inputs
    state = project.build_review_state(meshes, inputs)
    measures = measure_results(project, program, meshes, inputs, stop) if program else {}
    model = model_family(list(meshes.values()))
    if stop():
        return None
    last = project.assessment()
    found = review_family(state, judged, model, last.bar if last else BAR, describe_odd_results(measures))
    found = add_span_doubts(project, meshes, found, state.reviewed_assets)
    if accepted is None:
        found = add_demonstration_doubts(project, found, state.accepted | state.corrected)
    found = ask_about_spans(project, meshes, found, program is not None)
    return ProjectAssessment(found, state, program, basis, measures)


def view_first_question(project: Project, meshes: Mapping[str, SymbolicMesh], number: int) -> wire.AssessmentView:
    """What is asked before anything is demonstrated, in an assessment of no asset.

    meshes: the assets that it may be about; number: of the learning run that was not needed.
    """
    questions = list_span_questions(project, meshes)
    asked = _view_question(questions[0], meshes) if questions else None
    return wire.AssessmentView(number=number, bar=BAR, question=asked)


def view_assessment(
    assessment: Assessment, state: ReviewState, number: int, has_program: bool = True, unseen: int = 0
) -> wire.AssessmentView:
    """An assessment as the page shows it; without a program no edit has a probability. unseen: assets of the family
    that are not in it."""
    question = assessment.question
    asked = _view_question(question, state.meshes) if question else None
    if not has_program:
        return wire.AssessmentView(number=number, bar=assessment.bar, question=asked)
    signed = set(assessment.signed_off)
    rows = tuple(
        wire.ConfidenceView(
            asset=name,
            probability=round(one.probability, 4),
            doubts=tuple(wire.DoubtView(**doubt.to_json()) for doubt in one.doubts),
            state="excluded" if name in assessment.excluded else "signed" if name in signed else "held",
            told=name in assessment.looked_at,
        )
        for name, one in assessment.assets.items()
    )
    counts = {what: sum(row.state == what for row in rows) for what in ("signed", "held", "excluded")}
    return wire.AssessmentView(
        number=number,
        bar=assessment.bar,
        signed_off=counts["signed"],
        held=counts["held"],
        excluded=counts["excluded"],
        unseen=unseen,
        assets=rows,
        question=asked,
    )


def _view_question(question: ReviewQuestion, meshes: Mapping[str, SymbolicMesh]) -> wire.ReviewQuestionView:
    return wire.ReviewQuestionView(
        id=question.id,
        kind=question.kind,
        text=question.text,
        seconds=round(question.seconds, 1),
        gain=round(question.gain, 3),
        asset=question.asset,
        rule=question.rule,
        hulls=tuple(
            wire.HullRef(asset=asset, hull=hull, place=meshes[asset].index[hull]) for asset, hull in question.hulls
        ),
        choices=tuple(map(_view_choice, question.choices)),
    )


def _view_choice(choice: ReviewChoice) -> wire.ReviewChoiceView:
    return wire.ReviewChoiceView(
        id=choice.id,
        text=choice.text,
        label=choice.label,
        select=choice.select,
        sentence=_explain_reading(choice),
        orient=show(choice.orient).removeprefix("orient ") if choice.orient else None,
    )


def _explain_reading(choice: ReviewChoice) -> str:
    """The extractor of a choice in words, empty where its text is none."""
    if choice.select is None:
        return ""
    try:
        return explain(parse_extractor(choice.text))
    except MeshForgeError:
        return ""
