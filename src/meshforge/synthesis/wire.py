"""Outcomes as the JSON that scripts rely on."""

from __future__ import annotations

from typing import Any

from meshforge.language import show
from meshforge.synthesis.asking import Question, Repair
from meshforge.synthesis.outcome import Nearest, NoProgram, Outcome, Reading


def outcome_json(outcome: Outcome) -> dict[str, Any]:
    """The outcome as `synthesize --json` prints it."""
    return {
        "status": outcome.status,
        "program": str(outcome.program) if outcome.program else None,
        "settled": outcome.settled,
        "readings": [_reading(reading) for reading in outcome.readings],
        "repairs": [_repair(repair) for repair in outcome.repairs],
        "question": _question(outcome.question) if outcome.question else None,
        "nearest": _nearest(outcome.nearest) if outcome.nearest else None,
        "demonstrate_next": {"asset": outcome.hint.asset, "why": outcome.hint.why} if outcome.hint else None,
        "look_at": list(outcome.sample),
        "overruled": list(outcome.overruled),
        "stale_answers": [{"rule": answer.rule, "asset": answer.asset} for answer in outcome.stale],
        "followed": list(outcome.followed),
        **_failure(outcome),
        "seconds": dict(outcome.seconds),
    }


def _failure(outcome: Outcome) -> dict[str, Any]:
    if not isinstance(outcome, NoProgram):
        return {}
    orient = show(outcome.suggested.orient) if outcome.suggested else None
    return {"why": outcome.why, "advice": list(outcome.advice), "suggested_orientation": orient}


def _reading(reading: Reading) -> dict[str, Any]:
    return {
        "id": reading.id,
        "rule": reading.rule,
        "extractor": show(reading.extractor),
        "size": reading.size,
        "belief": round(reading.belief, 6),
        "differs_on": list(reading.differs_on),
    }


def _repair(repair: Repair) -> dict[str, Any]:
    wrong = repair.correction
    return {
        "rule": repair.rule,
        "asset": wrong.asset,
        "hull": wrong.hull,
        "from": wrong.was,
        "to": wrong.to,
        "belief": round(repair.belief, 6),
        "why": repair.why,
    }


def _question(question: Question) -> dict[str, Any]:
    return {
        "id": question.id,
        "asset": question.asset,
        "rule": question.rule,
        "choices": [{"reading": choice.reading, "select": list(choice.select)} for choice in question.choices],
    }


def _nearest(nearest: Nearest) -> dict[str, Any]:
    return {
        "rule": nearest.rule,
        "extractor": show(nearest.extractor),
        "asset": nearest.asset,
        "extra": list(nearest.extra),
        "missing": list(nearest.missing),
    }
