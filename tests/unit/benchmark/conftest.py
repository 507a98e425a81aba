"""What tests of the benchmark share, to work it out once: a task with few meshes, pictures, work in this process."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Future
from functools import cache
from typing import Any, Self

import pytest

from benchmark import journal
from benchmark.assets import SEPARATE
from benchmark.baselines import prompts
from benchmark.baselines.replay import Replay
from benchmark.study import Bench
from benchmark.tasks import Task, task
from meshforge.language import Program

STEP = 4
"""Of every so many meshes of a category one is taken: of most assets one, coarse, medium and fine by turns."""
_samples = Task.samples


class Here:
    """An executor that works in this process at once, where what was read and judged before is remembered."""

    def __init__(self, workers: int | None = None) -> None:
        pass

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *raised: object) -> None:
        pass

    def submit(self, work: Callable[..., Any], *unit: Any) -> Future[Any]:
        future: Future[Any] = Future()
        try:
            future.set_result(work(*unit))
        except Exception as error:
            future.set_exception(error)
        return future

    def shutdown(self, wait: bool = True, cancel_futures: bool = False) -> None:
        pass


@pytest.fixture
def here(monkeypatch: pytest.MonkeyPatch) -> None:
    """Units of work are worked out in this process."""
    monkeypatch.setattr(journal, "ProcessPoolExecutor", Here)


@cache
def few(name: str, calibration: bool = False) -> Bench:
    """A task with a quarter of its meshes; the same for all tests, since what it remembers depends on nothing else."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Task, "samples", _few_samples)
        return Bench(task(name), calibration)


def _few_samples(one: Task, calibration: bool = False, settings: Sequence[str] = SEPARATE) -> tuple[Any, ...]:
    return _samples(one, calibration, settings)[::STEP]


@pytest.fixture
def few_meshes(monkeypatch: pytest.MonkeyPatch, here: None) -> None:
    """A quarter of the meshes of each category, and all work in this process."""
    monkeypatch.setattr("benchmark.evaluation.sessions._bench", few)
    monkeypatch.setattr("benchmark.baselines.verdicts._bench", few)
    monkeypatch.setattr("benchmark.baselines.run.Bench", lambda one: few(one.name))
    monkeypatch.setattr("benchmark.learning.task_cases.Bench", lambda one, calibration: few(one.name, calibration))


_drawn: dict[str, list[Any]] = {}
_describe = prompts.describe_demonstrations


def _describe_once(shown: Sequence[Replay], frame: Program) -> list[Any]:
    key = "\n".join(
        [str(frame), *(f"{one.name}\n{prompts.describe_mesh(one.before)}\n{prompts.steps(one)}" for one in shown)]
    )
    if key not in _drawn:
        _drawn[key] = list(_describe(shown, frame))
    return _drawn[key]


@pytest.fixture
def small_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pictures for models that write programs are as small as may be, and each is drawn once."""
    monkeypatch.setattr(prompts, "_SIZE", 256)
    monkeypatch.setattr(prompts, "_PAIR", (160, 140))
    monkeypatch.setattr(prompts, "describe_demonstrations", _describe_once)
