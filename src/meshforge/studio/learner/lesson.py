"""The outcome of a lesson as the page shows it."""

from __future__ import annotations

from collections import Counter

from meshforge.language import Program, explain, show
from meshforge.project.answers_file import repair_id
from meshforge.studio.showing.programs import rule_views
from meshforge.studio.wire.lesson import (
    ChoiceView,
    HintView,
    LessonView,
    NearestView,
    QuestionView,
    ReadingView,
    RepairView,
)
from meshforge.synthesis import Choice, NoProgram, Outcome, Question, Reading, Repair


def lesson_view(number: int, outcome: Outcome, looked_at: int, seconds: float) -> LessonView:
    """What a lesson came to; number: which one it is; looked_at: how many assets were; seconds: the time it took."""
    counts = Counter(reading.rule for reading in outcome.readings)
    failure = outcome if isinstance(outcome, NoProgram) else None
    suggested = failure.suggested if failure else None
    return LessonView(
        number=number,
        status=outcome.status,
        program=str(outcome.program) if outcome.program else None,
        looked_at=looked_at,
        rules=rule_views(outcome.program or Program(rules=outcome.rules), counts),
        settled=outcome.settled,
        readings=tuple(map(_reading, outcome.readings)),
        repairs=tuple(map(_repair, outcome.repairs)),
        question=_question(outcome.question, outcome) if outcome.question else None,
        nearest=_nearest(outcome),
        hint=HintView(asset=outcome.hint.asset, why=outcome.hint.why) if outcome.hint else None,
        why=failure.why if failure else None,
        advice=failure.advice if failure else (),
        suggested_orientation=show(suggested.orient).removeprefix("orient ") if suggested else None,
        stale=tuple(f"{answer.rule}:{answer.asset}" for answer in outcome.stale),
        sample=() if outcome.settled else outcome.sample,
        overruled=outcome.overruled,
        seconds=seconds,
    )


def _reading(reading: Reading) -> ReadingView:
    return ReadingView(
        id=reading.id,
        rule=reading.rule,
        extractor=show(reading.extractor),
        sentence=explain(reading.extractor),
        size=reading.size,
        belief=reading.belief,
        differs_on=reading.differs_on,
    )


def _repair(repair: Repair) -> RepairView:
    wrong = repair.correction
    return RepairView(
        id=repair_id(wrong),
        rule=repair.rule,
        asset=wrong.asset,
        hull=wrong.hull,
        was=wrong.was,
        to=wrong.to,
        belief=repair.belief,
        why=repair.why,
    )


def _question(question: Question, outcome: Outcome) -> QuestionView:
    readings = {reading.id: reading for reading in outcome.readings}
    return QuestionView(
        id=question.id,
        rule=question.rule,
        asset=question.asset,
        choices=tuple(_choice(choice, readings[choice.reading]) for choice in question.choices),
        harm=question.harm,
        left=question.left,
    )


def _choice(choice: Choice, reading: Reading) -> ChoiceView:
    return ChoiceView(
        reading=choice.reading,
        extractor=show(reading.extractor),
        sentence=explain(reading.extractor),
        select=choice.select,
    )


def _nearest(outcome: Outcome) -> NearestView | None:
    near = outcome.nearest
    if near is None:
        return None
    return NearestView(
        rule=near.rule, extractor=show(near.extractor), asset=near.asset, extra=near.extra, missing=near.missing
    )
