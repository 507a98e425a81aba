"""The pytest plugin that tells quick tests from slow ones, and sees to it that the quick ones stay quick.

A plain run (`script/test`) leaves out what is marked `slow`, the loops on real families, the browser and the benchmark,
and tries a fifth of the examples of each law. `--all` runs all of them; so does naming a path, `-k` or `-m`, for what
is named. Laws are tried on the same examples every time; `--explore` draws new ones.

An `--all` run names the tests that are not marked and take more than `WARNING`, the slowest first. None fails for it:
what a test takes is the machine's doing too. CPU time counts rather than the clock, so that a busy machine matters
less; it is that of the test and its fixtures of scope "function", child processes included, but for those that a server
of worker processes started. A law may take as much longer as it tries more examples than in a quick run.
"""

from __future__ import annotations

import os
import sys
from collections import Counter
from collections.abc import Generator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import is_hypothesis_test, settings

from tests.corpus_path import ABSENT

WARNING = 1.0
"""Seconds of CPU time from which a test is named that is not marked."""
SLOW_FOLDERS = ("tests/e2e/", "tests/loop/", "tests/unit/benchmark/")
QUICK_EXAMPLES = 20
ALL_EXAMPLES = 100
"""How many examples a law tries that does not say; the others scale likewise, see `tests/examples.py`."""

for name, derandomize, count in (
    ("quick", True, QUICK_EXAMPLES),
    ("all", True, ALL_EXAMPLES),
    ("explore", False, ALL_EXAMPLES),
):
    settings.register_profile(name, deadline=None, database=None, derandomize=derandomize, max_examples=count)


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("meshforge")
    group.addoption("--all", action="store_true", dest="all_tests", help="run the slow tests too, with all examples")
    group.addoption("--explore", action="store_true", help="let laws draw new examples")
    group.addoption("--record-seconds", metavar="FILE", type=Path, help="write each test's seconds of CPU time")
    group.addoption("--quick", action="store_true", help="leave out the slow tests even where paths are named")


@pytest.hookimpl(tryfirst=True)
def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "slow: takes more than a second of CPU time; left out of quick runs")
    option = config.option
    named = config.args_source is pytest.Config.ArgsSource.ARGS or option.keyword or option.markexpr
    quick = option.quick or not (option.all_tests or named)
    option.quick = vars(config)["workerinput"]["quick"] if _is_worker(config) else quick
    settings.load_profile("explore" if option.explore else "quick" if option.quick else "all")
    config.pluginmanager.register(Costs(config))


@pytest.hookimpl(optionalhook=True)
def pytest_configure_node(node: Any) -> None:
    """Tell a worker of pytest-xdist, which is given the words of the command line alone, what kind of run it is."""
    node.workerinput["quick"] = node.config.option.quick


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    for item in items:
        if item.nodeid.startswith(SLOW_FOLDERS):
            item.add_marker("slow")
    if config.option.quick:
        slow = [item for item in items if item.get_closest_marker("slow")]
        config.hook.pytest_deselected(items=slow)
        items[:] = [item for item in items if not item.get_closest_marker("slow")]


class Costs:
    """What each test costs, and what the absence of the corpus costs."""

    def __init__(self, config: pytest.Config) -> None:
        self._config = config
        self._fixtures = 0.0
        self._seconds: dict[str, float] = {}
        self._quick: dict[str, float] = {}
        """Seconds of the tests that are not marked, those of a law by as many times as it tries more examples less."""
        self._absent: Counter[str] = Counter()

    @pytest.hookimpl(wrapper=True)
    def pytest_fixture_setup(
        self, fixturedef: pytest.FixtureDef[object], request: pytest.FixtureRequest
    ) -> Generator[None, object, object]:
        before = _cpu_seconds()
        try:
            return (yield)
        finally:
            if fixturedef.scope == "function":
                self._fixtures += _cpu_seconds() - before

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Generator[None, object, object]:
        self._fixtures = 0.0
        return (yield)

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_call(self, item: pytest.Item) -> Generator[None, None, None]:
        before = _cpu_seconds()
        try:
            yield
        finally:
            item.stash[_SECONDS] = _cpu_seconds() - before + self._fixtures

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_makereport(
        self, item: pytest.Item, call: pytest.CallInfo[None]
    ) -> Generator[None, pytest.TestReport, pytest.TestReport]:
        report = yield
        if call.when == "call":
            seconds, scale = item.stash[_SECONDS], settings().max_examples / QUICK_EXAMPLES if _is_law(item) else 1.0
            report.user_properties.append(("cpu_seconds", seconds))
            if not item.get_closest_marker("slow"):
                report.user_properties.append(("quick_seconds", seconds / scale))
        if report.skipped and isinstance(report.longrepr, tuple) and ABSENT in report.longrepr[2]:
            report.user_properties.append(("shows", _title(item)))
        return report

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        for name, value in report.user_properties:
            if name == "cpu_seconds":
                self._seconds[report.nodeid] = float(str(value))
            elif name == "quick_seconds":
                self._quick[report.nodeid] = float(str(value))
            elif name == "shows":
                self._absent[str(value)] += 1

    def pytest_sessionfinish(self) -> None:
        if _is_worker(self._config):
            return
        if path := self._config.option.record_seconds:
            rows = sorted(self._seconds.items(), key=lambda row: -row[1])
            path.write_text("".join(f"{seconds:.3f}\t{test}\n" for test, seconds in rows), encoding="utf-8")

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        say = terminalreporter.write_line
        for test, seconds in self._find_slow():
            say(f"slow: {test} takes {seconds:.1f} s of CPU time: make it cheaper, or mark it slow", yellow=True)
        if self._absent:
            shows = "; ".join(f"{title} ({count})" for title, count in sorted(self._absent.items()))
            say(f"{ABSENT}: {self._absent.total()} tests skipped, which show: {shows}")
        if self._config.option.quick:
            say("The slow tests were left out; script/test --all runs them.")

    def _find_slow(self) -> list[tuple[str, float]]:
        """The tests that should be marked, and their seconds, in a run of all tests; the slowest first."""
        rows = self._quick.items() if self._config.option.all_tests else ()
        return sorted(((test, seconds) for test, seconds in rows if seconds > WARNING), key=lambda row: -row[1])


_SECONDS = pytest.StashKey[float]()


def _is_worker(config: pytest.Config) -> bool:
    """Whether this process is one of pytest-xdist's workers."""
    return hasattr(config, "workerinput")


def _is_law(item: pytest.Item) -> bool:
    return isinstance(item, pytest.Function) and is_hypothesis_test(item.obj)


def _cpu_seconds() -> float:
    """CPU time of this process and of all children that have ended."""
    return sum(os.times()[:4])


def _title(item: pytest.Item) -> str:
    """What a test's module shows: the first words of its docstring, up to a colon."""
    module = sys.modules[item.function.__module__] if isinstance(item, pytest.Function) else None
    lines = (getattr(module, "__doc__", None) or item.name).strip().splitlines()
    return lines[0].split(":")[0].rstrip(".")
