"""The pytest plugin that tells quick tests from slow and long ones, and sees to it that each kind stays what it is.

| run | what it leaves out | how many examples a law tries |
| --- | --- | --- |
| `script/test` | what is marked `slow` or `long`, and `SLOW_FOLDERS` | 20, the same every time |
| `--all`, as CI does | what is marked `long`: at most a tenth of all cases | 20, the same every time |
| a path, `-k` or `-m` | nothing of what is named | 20, the same every time |
| `--long` | nothing | 200, new ones |

`--explore` lets laws draw new examples in any run. What fails then is printed, and is kept as an `@example`.

An `--all` run fails when more cases are marked `long`. It names the tests that take more than their marks allow, the
slowest first, and does not fail for those: what a test takes is the machine's doing too. CPU time counts rather than
the clock, so that a busy machine matters less; it is that of the test and its fixtures of scope "function", child
processes included, but for those that a server of worker processes started and those that tests share.
"""

from __future__ import annotations

import gc
import os
import sys
from collections import Counter
from collections.abc import Generator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import settings

from tests.corpus_path import ABSENT

LIMITS = {"slow": 1.0, "long": 10.0}
"""Seconds of CPU time from which a test needs a mark."""
SLOW_FOLDERS = ("tests/e2e/", "tests/loop/", "tests/unit/benchmark/")
MOST_LONG = 0.1
"""Share of all cases that CI may leave out."""

for name, fixed, count in (("fixed", True, 20), ("explore", False, 200)):
    settings.register_profile(name, deadline=None, database=None, derandomize=fixed, max_examples=count)


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("meshforge")
    group.addoption("--all", action="store_true", dest="all_tests", help="run the slow tests too, as CI does")
    group.addoption("--long", action="store_true", help="run all tests, laws on new examples")
    group.addoption("--explore", action="store_true", help="let laws draw new examples, ten times as many")
    group.addoption("--record-seconds", metavar="FILE", type=Path, help="write each test's seconds of CPU time")
    group.addoption("--quick", action="store_true", help="leave out slow tests even where paths are named")


@pytest.hookimpl(tryfirst=True)
def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "slow: takes more than a second of CPU time; left out of quick runs")
    config.addinivalue_line("markers", "long: takes more than ten; left out of CI too, script/test --long runs it")
    option = config.option
    if _is_worker(config):
        option.left_out = vars(config)["workerinput"]["left_out"]
    else:
        named = config.args_source is pytest.Config.ArgsSource.ARGS or bool(option.keyword or option.markexpr)
        quick = option.quick or not (option.all_tests or option.long or named)
        option.left_out = ["slow", "long"] if quick else ["long"] if option.all_tests and not option.long else []
        option.whole = option.all_tests and not named
    settings.load_profile("explore" if option.explore or option.long else "fixed")
    if option.long:
        os.environ[_LONG] = "1"  # for the workers of pytest-xdist, too
    config.pluginmanager.register(Cases(config))
    config.pluginmanager.register(Costs(config))


@pytest.hookimpl(optionalhook=True)
def pytest_configure_node(node: Any) -> None:
    """Tell a worker of pytest-xdist, which is given the words of the command line alone, what to leave out."""
    node.workerinput["left_out"] = node.config.option.left_out


def pytest_collection_finish() -> None:
    """Spare the garbage collector the thousands of tests, which it would look through again and again."""
    gc.collect()
    gc.freeze()


def pytest_unconfigure() -> None:
    gc.unfreeze()  # or what is left at the end counts as a leak


class Cases:
    """Which tests are run, and how many are marked long."""

    def __init__(self, config: pytest.Config) -> None:
        self._config = config
        self._all = self._long = 0

    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        for item in items:
            if item.nodeid.startswith(SLOW_FOLDERS):
                item.add_marker("slow")
        marked = [item for item in items if any(map(item.get_closest_marker, self._config.option.left_out))]
        self._all, self._long = len(items), sum(item.get_closest_marker("long") is not None for item in items)
        self._config.hook.pytest_deselected(items=marked)
        left_out = set(marked)
        items[:] = [item for item in items if item not in left_out]

    @pytest.hookimpl(optionalhook=True)
    def pytest_testnodedown(self, node: Any) -> None:
        """Take a worker's counts: under pytest-xdist only workers collect tests."""
        self._all, self._long = getattr(node, "workeroutput", {}).get("cases", (self._all, self._long))

    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        if _is_worker(self._config):
            vars(self._config)["workeroutput"]["cases"] = (self._all, self._long)
        elif self._too_many and session.exitstatus == pytest.ExitCode.OK:
            session.exitstatus = pytest.ExitCode.TESTS_FAILED

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        if "slow" in self._config.option.left_out:
            terminalreporter.write_line(
                "The slow tests were left out; script/test --all runs most of them, --long all."
            )
        elif self._config.option.left_out:
            line = f"{self._long} of {self._all} cases are marked long and were left out; script/test --long runs them."
            terminalreporter.write_line(line)
        if self._too_many:
            line = f"More than {MOST_LONG:.0%} of all cases are marked long: make some of them cheaper."
            terminalreporter.write_line(line, red=True)

    @property
    def _too_many(self) -> bool:
        return getattr(self._config.option, "whole", False) and self._long > MOST_LONG * self._all


class Costs:
    """What each test costs, and what the absence of the corpus costs."""

    def __init__(self, config: pytest.Config) -> None:
        self._config = config
        self._fixtures = 0.0
        self._seconds: dict[str, float] = {}
        self._marks: dict[str, str] = {}
        """The mark that each test has not, and would need if it took longer."""
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
            report.user_properties.append(("cpu_seconds", item.stash[_SECONDS]))
            if mark := next((mark for mark in LIMITS if not item.get_closest_marker(mark)), None):
                report.user_properties.append(("needs", mark))
        if report.skipped and isinstance(report.longrepr, tuple) and ABSENT in report.longrepr[2]:
            report.user_properties.append(("shows", _title(item)))
        return report

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        for name, value in report.user_properties:
            if name == "cpu_seconds":
                self._seconds[report.nodeid] = float(str(value))
            elif name == "needs":
                self._marks[report.nodeid] = str(value)
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
        for test, seconds in self._find_costly():
            mark = self._marks[test]
            say(f"{mark}: {test} takes {seconds:.1f} s of CPU time: make it cheaper, or mark it {mark}", yellow=True)
        say(f"All tests together took {sum(self._seconds.values()):.0f} s of CPU time.")
        if self._absent:
            shows = "; ".join(f"{title} ({count})" for title, count in sorted(self._absent.items()))
            say(f"{ABSENT}: {self._absent.total()} tests skipped, which show: {shows}")

    def _find_costly(self) -> list[tuple[str, float]]:
        """The tests that take more than their marks allow, and their seconds, in a run of CI; the slowest first."""
        tests = self._marks if self._config.option.all_tests else ()
        costly = {test: self._seconds[test] for test in tests if self._seconds[test] > LIMITS[self._marks[test]]}
        return sorted(costly.items(), key=lambda row: -row[1])


def is_long() -> bool:
    """Whether this run leaves nothing out, however long that takes."""
    return _LONG in os.environ


_LONG = "MESHFORGE_LONG_TESTS"
_SECONDS = pytest.StashKey[float]()


def _is_worker(config: pytest.Config) -> bool:
    """Whether this process is one of pytest-xdist's workers."""
    return hasattr(config, "workerinput")


def _cpu_seconds() -> float:
    """CPU time of this process and of all children that have ended."""
    return sum(os.times()[:4])


def _title(item: pytest.Item) -> str:
    """What a test's module shows: the first words of its docstring, up to a colon."""
    module = sys.modules[item.function.__module__] if isinstance(item, pytest.Function) else None
    lines = (getattr(module, "__doc__", None) or item.name).strip().splitlines()
    return lines[0].split(":")[0].rstrip(".")
