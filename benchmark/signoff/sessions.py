"""Sessions one by one: each is kept when it ends, by the code, the task, the labels, the person and the client."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from time import process_time
from typing import Any, NamedTuple

from benchmark.journal import run_units
from benchmark.report import Tell
from benchmark.signoff.client import Client
from benchmark.signoff.conditions import open_bench_of
from benchmark.signoff.queue import Review, sign_off
from benchmark.signoff.terminal import AnswersClient, ProcessClient, TerminalClient, WrongClient
from benchmark.study import CONDITIONS
from meshforge.project import Project

CLIENTS: Mapping[str, Callable[[Project], Client]] = {
    one.name: one for one in (Client, TerminalClient, AnswersClient, WrongClient, ProcessClient)
}
"""What a person does it with, by its name."""


class Unit(NamedTuple):
    """One session. folder: of families to tune on, None for those that are reported; client: its name."""

    task: str
    condition: str
    seed: int
    folder: str | None = None
    client: str = Client.name


def run_sessions(units: Sequence[Unit], tell: Tell, workers: int | None = None) -> list[dict[str, Any]]:
    """What `run_session` gives for each; those that are kept already are not run again. workers: processes, None for
    one a processor."""
    return run_units("signoff-session", run_session, units, tell, workers)


def run_session(task: str, condition: str, seed: int, folder: str | None, client: str) -> dict[str, Any]:
    """The review of one session, and the seconds that the computer worked for it."""
    one, began = CONDITIONS[condition], process_time()
    review = sign_off(open_bench_of(task, one, seed, folder), one, seed, CLIENTS[client])
    return {"review": asdict(review), "computer": round(process_time() - began, 2)}


def read_reviews(rows: Sequence[Mapping[str, Any]]) -> list[Review]:
    """The reviews of sessions."""
    return [Review.of_json(row["review"]) for row in rows]
