"""Simulated people who teach the tasks: what they see, show, answer and confirm, and what comes of it."""

from benchmark.study.condition import CONDITIONS, FLAT, MOST, REPORTED, SEEN, TRUE, TUNING, Condition
from benchmark.study.course import open_course, teach_task
from benchmark.study.desk import Bench, Desk, open_bench
from benchmark.study.session import Round, Session

__all__ = [
    "CONDITIONS",
    "FLAT",
    "MOST",
    "REPORTED",
    "SEEN",
    "TRUE",
    "TUNING",
    "Bench",
    "Condition",
    "Desk",
    "Round",
    "Session",
    "open_bench",
    "open_course",
    "teach_task",
]
