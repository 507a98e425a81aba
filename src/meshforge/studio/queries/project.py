"""The project as a whole and the cards of its assets, as the page shows them, and what its next step depends on."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from meshforge.common import pluralize
from meshforge.language import BaseExtractor, Is, Orient, explain, show_label
from meshforge.project import (
    NO_LABEL,
    AssetStatus,
    FamilyState,
    LastRun,
    NextStep,
    OpenQuestion,
    Project,
    PropagationState,
)
from meshforge.rendering import label_color
from meshforge.signoff import ResultState
from meshforge.studio.actions import view_action
from meshforge.studio.queries.assets import output_picture_digest, picture_digest
from meshforge.studio.queries.goals import list_goal_views
from meshforge.studio.wire import family as wire
from meshforge.studio.wire.asset import Fault
from meshforge.studio.wire.program import OutcomeView, ProgramView
from meshforge.symbolic import NO_PART, Label, is_class_name
from meshforge.synthesis import Step


def add_session(
    family: FamilyState,
    program: ProgramView,
    outcome: OutcomeView | None,
    assessment: wire.AssessmentView | None,
    propagation: PropagationState | None,
    problem: str | None,
) -> FamilyState:
    """Return what the next step depends on, with what this session knows; it learns by itself, so a program is
    outdated only where nothing is demonstrated any more."""
    rows = {row.asset: row for row in assessment.assets} if assessment else {}
    near = (outcome.nearest.rule, outcome.nearest.asset) if outcome and outcome.nearest else None
    return replace(
        family,
        assets=[_add_confidence(asset, rows.get(asset.id)) for asset in family.assets],
        has_program=bool(program.text) and not program.error,
        outdated=family.outdated and not any(asset.demonstrated for asset in family.assets),
        problem=problem,
        question=_find_question(assessment),
        last_run=LastRun(outcome.status, outcome.repairs, near) if outcome else None,
        propagation=propagation,
    )


def _add_confidence(asset: AssetStatus, row: wire.ConfidenceView | None) -> AssetStatus:
    if row is None or asset.review == "accepted":
        return asset
    states: Mapping[str, ResultState] = {"signed": "sure", "needs review": "needs review", "excluded": "excluded"}
    result_status = replace(asset.result_status, state=states[row.state], probability=row.probability)
    return replace(asset, result_status=result_status)


def _find_question(assessment: wire.AssessmentView | None) -> OpenQuestion | None:
    """The question that is worth most, as long as some results need review."""
    asked = assessment.question if assessment and assessment.need_review else None
    if asked is None:
        return None
    return OpenQuestion(asked.kind if asked.kind in ("result", "demonstrate") else "other", asked.asset)


def build_project_view(
    project: Project,
    next_step: NextStep,
    problem: str | None,
    lost: tuple[str, ...],
    propagated: PropagationState | None = None,
    new: wire.NewAssetsView | None = None,
    ask_up: str | None = None,
) -> wire.ProjectView:
    """Return the project as the page shows it. problem, lost, propagated, new, ask_up: as in `ProjectView`."""
    settings = project.settings
    return wire.ProjectView(
        name=settings.name,
        folder=str(project.folder),
        vocabulary=vocabulary_view(project.words),
        orient=_view_orientation(settings.orient, project.orientation),
        contact=settings.thresholds.contact,
        extremity=settings.thresholds.extremity,
        rules=_rule_lines(project),
        answers=tuple(_list_feedback(project)),
        templates=project.template_names(),
        goals=list_goal_views(project),
        propagation=propagated,
        next=next_step,
        new=new,
        problem=problem,
        lost=lost,
        left_out=tuple(asset for asset in project.every.ids if asset not in project.found.ids),
        up=settings.up,
        ask_up=ask_up,
    )


def _view_orientation(text: str, orient: Orient | None) -> wire.OrientView:
    if orient is None:
        return wire.OrientView(text=text)
    pairs = (
        wire.AxisLandmarks(axis=pair.axis, start=_label_of(pair.start), end=_label_of(pair.end))
        for pair in orient.pairs
    )
    return wire.OrientView(text=text, sentence=explain(orient), snap=orient.snap, pairs=tuple(pairs))


def _label_of(extractor: BaseExtractor) -> str | None:
    return extractor.label if isinstance(extractor, Is) else None


def _rule_lines(project: Project) -> tuple[wire.RuleLine, ...]:
    shown = set(project.layout.demonstration.ids)
    steps = [(asset, step) for asset in project.assets() if asset in shown for step in project.steps(asset)]
    count = max((step.rule for _, step in steps), default=0)
    return tuple(_rule_line(k, [row for row in steps if row[1].rule == k]) for k in range(1, count + 1))


def _rule_line(rule: int, steps: Sequence[tuple[str, Step]]) -> wire.RuleLine:
    first = min(steps, key=lambda row: not row[1].select)[1]  # of equals the one that comes first
    return wire.RuleLine(
        rule=rule,
        action=view_action(first.action, first.label),
        shown=tuple(asset for asset, step in steps if step.select),
        nothing=tuple(asset for asset, step in steps if step.select is not None and not step.select),
    )


def vocabulary_view(words: Sequence[str]) -> tuple[wire.VocabularyLabel, ...]:
    """Return the labels of the vocabulary, each with its color."""
    return tuple(
        wire.VocabularyLabel(name=word, text=show_label(word), color=label_color(k), is_class=is_class_name(word))
        for k, word in enumerate(words)
    )


def _list_feedback(project: Project) -> Iterator[wire.AnswerView]:
    answers = project.feedback()
    for answer in answers.answers.values():
        if answer.select is None:
            what = "neither of the choices"
        else:
            what = pluralize(len(answer.select), "hull") if answer.select else "nothing"
        text = f"rule {answer.rule} on {answer.asset} selects {what}"
        yield wire.AnswerView(id=answer.id, kind="answer", asset=answer.asset, text=text)
    for line in answers.fixes.values():
        is_or_not = f"is {line.to}, not {line.was or 'without a label'}" if line.accepted else f"is not {line.to}"
        text = f"{line.hull} of {line.asset} {is_or_not}"
        yield wire.AnswerView(
            id=line.id, kind="confirmed" if line.accepted else "rejected", asset=line.asset, text=text
        )


_SHARED = (
    *("hulls", "confidence", "demonstrated", "output", "after", "stale", "error", "flags", "review"),
    *("manual_edits", "sources", "prepared"),
)
"""What a card has as the status of an asset has it."""


def build_card(
    status: AssetStatus,
    vocabulary: Sequence[str],
    orient: str,
    up: str = "",
    check: str | None = None,
    faults: tuple[Fault, ...] | None = None,
) -> wire.Card:
    """Return the card of an asset; orient, up: the settings that say how it is drawn; check, faults: see `Card`."""
    places = {label: k for k, label in enumerate(vocabulary)}
    picture = None if status.hulls is None else picture_digest(status.geometry, status.labels, orient, up)
    output = status.output_digest
    return wire.Card(
        asset=status.id,
        labels=tuple(_place_of(label, places) for label in status.labels),
        after_labels=tuple(places.get(label, -1) if label else -1 for label in status.after_labels),
        note=status.review_note,
        excluded=status.result_status.excluded,
        picture=picture,
        edited_picture=output_picture_digest(picture, output) if output and picture else None,
        check=check,
        faults=faults,
        goals=tuple(map(wire.GoalResultView.model_validate, status.result_status.goals)),
        **{name: getattr(status, name) for name in _SHARED},
    )


def _place_of(label: Label | None, places: Mapping[str, int]) -> int:
    if label is None:
        return NO_LABEL
    return wire.NO_PART if label.name == NO_PART else places.get(label.name, NO_LABEL)
