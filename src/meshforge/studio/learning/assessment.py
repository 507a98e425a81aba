"""How sure the edits of a project are: what is known of its family, judged, kept, and as the page shows it."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from meshforge.common import MeshForgeError
from meshforge.language import explain, parse_extractor
from meshforge.project import (
    AssessmentBasis,
    FamilyAssessment,
    Project,
    assess_family,
    program_by_hand,
    sees_whole_family,
)
from meshforge.signoff import THRESHOLD, Assessment, ReviewChoice, ReviewQuestion, ReviewState
from meshforge.studio.wire import signoff as wire
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import LearningOutcome


def assess_project(
    project: Project,
    meshes: Mapping[str, SymbolicMesh],
    outcome: LearningOutcome | None,
    basis: AssessmentBasis,
    stop: Callable[[], bool] = lambda: False,
) -> FamilyAssessment | None:
    """How sure the edits of a project are under its program, None where that was interrupted.

    meshes: those that were learned from; outcome: what that came to, which does not matter where a person wrote the
    program; basis: taken before the meshes were read.
    """
    by_hand, last = program_by_hand(project), project.assessment()
    threshold = last.threshold if last else THRESHOLD
    return assess_family(project, meshes, by_hand or outcome, basis, threshold, by_hand=by_hand is not None, stop=stop)


def keep_assessment(project: Project, made: FamilyAssessment) -> None:
    """Keep it as a review does, and renew sign-offs; nothing where there is no program, or where the studio looks at
    some assets only."""
    if made.program is not None and sees_whole_family(project) and made.keep(project):
        project.renew_sign_offs(keep_persons=True)


def view_assessment(
    assessment: Assessment, state: ReviewState, number: int, has_program: bool = True, unseen: int = 0
) -> wire.AssessmentView:
    """An assessment as the page shows it; without a program no edit has a probability. unseen: assets of the family
    that are not in it."""
    question = assessment.question
    asked = _view_question(question, state.meshes) if question else None
    if not has_program:
        return wire.AssessmentView(number=number, threshold=assessment.threshold, question=asked)
    signed = set(assessment.signed_off)
    rows = tuple(
        wire.ConfidenceView(
            asset=name,
            probability=round(one.probability, 4),
            reasons=tuple(wire.ReasonView(**reason.to_json()) for reason in one.reasons),
            state="excluded" if name in assessment.excluded else "signed" if name in signed else "needs review",
            remarks=name in assessment.looked_at,
        )
        for name, one in assessment.assets.items()
    )
    counts = {what: sum(row.state == what for row in rows) for what in ("signed", "needs review", "excluded")}
    return wire.AssessmentView(
        number=number,
        threshold=assessment.threshold,
        signed_off=counts["signed"],
        need_review=counts["needs review"],
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
        sentence=_explain_candidate(choice),
        orient=choice.orient_text,
    )


def _explain_candidate(choice: ReviewChoice) -> str:
    if choice.select is None:
        return ""
    try:
        return explain(parse_extractor(choice.text))
    except MeshForgeError:
        return ""
