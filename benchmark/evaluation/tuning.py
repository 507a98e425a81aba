"""The figures of RQ1 on the calibration set with other demonstrators: what anything may be tuned on."""

from __future__ import annotations

from benchmark.evaluation.effectiveness import ASKED, summarize
from benchmark.evaluation.sessions import sessions
from benchmark.report import Result, Tell


def measure(tell: Tell, quick: bool) -> Result:
    """Teach all tasks on the calibration set."""
    return summarize(
        sessions(ASKED, tell, quick, tuning=True), "tuning", "Tuning: RQ1 on the calibration set, seeds 0 to 4"
    )
