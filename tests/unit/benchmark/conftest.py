"""What tests of the benchmark share, to work it out once: a task with few meshes, pictures, work in this process."""

from collections.abc import Callable, Sequence
from concurrent.futures import Future
from functools import cache
from typing import Any, Self

import pytest

from benchmark import journal
from benchmark.assets import family
from benchmark.baselines import prompts
from benchmark.baselines.replay import Replay
from benchmark.study import Bench
from benchmark.tasks import Task, task
from meshforge.language import Program

STEP = 2
"""Of every so many assets of a family one is taken."""


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
def few(name: str, setting: str = "medium", calibration: bool = False) -> Bench:
    """A task with half of its assets; the same for all tests, since what it remembers depends on nothing else."""
    one = task(name)
    return Bench(one, family(one.category, setting, calibration)[::STEP])


@pytest.fixture
def few_meshes(monkeypatch: pytest.MonkeyPatch, here: None) -> None:
    """Half of the assets of each category, and all work in this process."""
    for module in ("baselines.run", "baselines.verdicts", "evaluation.failures", "evaluation.sessions"):
        monkeypatch.setattr(f"benchmark.{module}.open_bench", few)
    samples = Task.samples
    monkeypatch.setattr(Task, "samples", lambda *given, **more: samples(*given, **more)[::4])


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
