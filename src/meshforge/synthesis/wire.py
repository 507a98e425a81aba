"""Outcomes as the JSON that scripts rely on."""

from __future__ import annotations

from typing import Any

from meshforge.language import show
from meshforge.synthesis.outcome import Nearest, Outcome, Reading


def outcome_json(outcome: Outcome) -> dict[str, Any]:
    """The outcome as `synthesize --json` prints it."""
    return {
        "status": outcome.status,
        "program": str(outcome.program) if outcome.program else None,
        "settled": outcome.settled,
        "readings": [_reading(reading) for reading in outcome.readings],
        "repairs": list(outcome.repairs),
        "question": outcome.question,
        "nearest": _nearest(outcome.nearest) if outcome.nearest else None,
        "seconds": dict(outcome.seconds),
    }


def _reading(reading: Reading) -> dict[str, Any]:
    return {
        "id": reading.id,
        "rule": reading.rule,
        "extractor": show(reading.extractor),
        "size": reading.size,
        "belief": reading.belief,
        "differs_on": list(reading.differs_on),
    }


def _nearest(nearest: Nearest) -> dict[str, Any]:
    return {
        "rule": nearest.rule,
        "extractor": show(nearest.extractor),
        "asset": nearest.asset,
        "extra": list(nearest.extra),
        "missing": list(nearest.missing),
    }
