"""Simulated people who teach the tasks: what they see, show, answer and confirm, and what comes of it."""

from benchmark.study.condition import CONDITIONS, FULL, MOST, NOISY, REPORTED, SEEN, TUNING, Condition
from benchmark.study.desk import Bench, Desk
from benchmark.study.session import Round, Session, teach_task

__all__ = [
    "CONDITIONS",
    "FULL",
    "MOST",
    "NOISY",
    "REPORTED",
    "SEEN",
    "TUNING",
    "Bench",
    "Condition",
    "Desk",
    "Round",
    "Session",
    "teach_task",
]
