"""A baseline over the sessions that MeshForge was taught in: asked session by session, judged mesh by mesh."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import AbstractContextManager, closing, contextmanager
from dataclasses import dataclass
from functools import partial
from itertools import groupby
from pathlib import Path
from typing import Any, Protocol

from benchmark.baselines import agent, blender_model
from benchmark.baselines.agent import Agent
from benchmark.baselines.blender.process import Blender
from benchmark.baselines.blender_model import BlenderModel
from benchmark.baselines.refinement import Answer, Trial, refine
from benchmark.baselines.replay import Replay, replay_demonstrations
from benchmark.baselines.verdicts import judge_program, judge_script
from benchmark.journal import JOURNALS, run_units
from benchmark.report import Tell
from benchmark.study import Bench, Session, open_bench
from benchmark.tasks import Task
from meshforge.labels.vlm.client import Client
from meshforge.labels.vlm.endpoint import Endpoint, QuestionError
from meshforge.labels.vlm.question import Message
from meshforge.store.settings import VlmSettings

ANSWERS = "vlm"
"""Where answers are kept, below the journals."""


class Work(Protocol):
    """A model's work on one task and some demonstrations."""

    @property
    def opening(self) -> tuple[Message, ...]: ...

    def try_answer(self, answer: str) -> Trial: ...


@dataclass(frozen=True, slots=True)
class Baseline:
    """name; work: what a model is asked and how answers are tried; kind, judge: of the units of the journal.

    more: further fields of each unit; room: tokens for an answer, besides those of the settings.
    """

    name: str
    work: Callable[[Task, Sequence[Replay]], AbstractContextManager[Work]]
    kind: str
    judge: Callable[..., Any]
    more: tuple[str, ...] = ()
    room: int = 2000


@dataclass(frozen=True, slots=True)
class BaselineRun:
    """What came of a baseline. sessions: judged, and written: what came of asking in each.

    missing: sessions that were not come to, or whose question got no answer, and why: the first reason.
    """

    sessions: Sequence[Session] = ()
    written: Sequence[Answer] = ()
    missing: int = 0
    why: str = ""


def vlm_agent() -> Baseline:
    """A model that writes programs."""

    @contextmanager
    def work(one: Task, shown: Sequence[Replay]) -> Iterator[Work]:
        yield Agent(one, shown)

    return Baseline(agent.NAME, work, "vlm-agent", judge_program)


def vlm_blender(python: Path) -> Baseline:
    """A model that writes Blender scripts; python: one that has the module bpy."""

    @contextmanager
    def work(one: Task, shown: Sequence[Replay]) -> Iterator[Work]:
        with Blender(python) as blender:
            yield BlenderModel(one, shown, blender)

    return Baseline(blender_model.NAME, work, "vlm-blender", judge_script, (str(python),), room=5000)


def run_baseline(baseline: Baseline, taught: Sequence[Session], settings: VlmSettings, tell: Tell) -> BaselineRun:
    """Ask a model in all sessions, and judge what it wrote; nothing is judged where some session is missing."""
    taught = sorted(taught, key=lambda row: (row.task, row.setting))  # so that a task's meshes are read once
    client = Client(Endpoint(settings), JOURNALS / ANSWERS, max_cost=settings.max_cost)
    with closing(client):
        answers = list(_answers(baseline, taught, client, baseline.room + settings.room, tell))
    missing = [answer for answer in answers if isinstance(answer, QuestionError)]
    if missing:
        return BaselineRun(missing=len(missing), why=missing[0].sentence)
    written = [answer for answer in answers if isinstance(answer, Answer)]
    units = [
        (row.task, row.condition, row.seed, row.shown, one.text, *baseline.more)
        for row, one in zip(taught, written, strict=True)
    ]
    rows = run_units(
        baseline.kind, baseline.judge, units, lambda line: tell(line.partition(" [")[0])
    )  # without the text
    return BaselineRun([Session.of_json(row) for row in rows], written)


def _answers(
    baseline: Baseline, taught: Sequence[Session], client: Client, room: int, tell: Tell
) -> Iterator[Answer | QuestionError]:
    """What came of asking, session by session; task by task, so that meshes are read once."""
    count = 0
    with ThreadPoolExecutor(client.endpoint.settings.concurrency) as pool:
        for (name, setting), rows in groupby(taught, key=lambda row: (row.task, row.setting)):
            bench = open_bench(name, setting)
            for answer in pool.map(partial(_answer, baseline, bench, client, room), list(rows)):
                count += 1
                tell(f"{baseline.name}: asked in {count} of {len(taught)} sessions, {name}")
                yield answer


def _answer(baseline: Baseline, bench: Bench, client: Client, room: int, row: Session) -> Answer | QuestionError:
    if client.end:
        return client.end
    try:
        with baseline.work(bench.task, replay_demonstrations(bench, row)) as work:
            return refine(client, work.opening, work.try_answer, room)
    except QuestionError as error:
        return error
