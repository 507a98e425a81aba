"""The checks by the names that `check --check` takes: those that are built in, one line each, engines, and plug-ins."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from inspect import isabstract
from typing import Any

from meshforge.checks.base import Check, CheckFindings, CheckSubject, MeasureCheck
from meshforge.checks.clearance import ClearanceCheck
from meshforge.checks.fit import FitCheck
from meshforge.checks.physics.simulation import PhysicsCheck
from meshforge.common import Plugin, PluginError, Registry, blame
from meshforge.engines import ENGINES, Finding, check_limits, find_engine

MEASURES: tuple[type[Check], ...] = (FitCheck, ClearanceCheck, PhysicsCheck)
"""The checks of what can be measured, besides engines."""


class EngineCheck(MeasureCheck):
    """The limits of an engine."""

    compares = False

    def __init__(self, engine: str) -> None:
        self.name = engine

    def measure(self, subject: CheckSubject) -> CheckFindings:
        return CheckFindings(tuple(check_limits(find_engine(self.name), subject.mesh, subject.legality[0])))


def _adopt(plugin: Plugin, kind: Any) -> Callable[[], Check]:
    """The class of a plug-in's check. Raises PluginError where it does not fit."""
    if not (isinstance(kind, type) and issubclass(kind, Check)):
        raise plugin.error("does not fit: it is no subclass of meshforge.checks.Check")
    if isabstract(kind):
        raise plugin.error(f"does not fit: it has no method {min(kind.__abstractmethods__)}")
    return kind


CHECKS: Registry[Callable[[], Check]] = Registry(
    "checks",
    {kind.name: kind for kind in MEASURES} | {name: partial(EngineCheck, name) for name in ENGINES},
    _adopt,
)


def run_checks(names: Sequence[str], subject: CheckSubject) -> Iterator[CheckFindings]:
    """Yield what checks find; of a plug-in's that fails, or is missing here, an error that says so."""
    for name in names:
        try:
            yield _run_check(name, subject)
        except PluginError as error:
            yield CheckFindings((Finding(name, "error", (), error.problem, error.remedy or ""),))


def _run_check(name: str, subject: CheckSubject) -> CheckFindings:
    plugin, kind = CHECKS.plugin(name), CHECKS[name]
    with blame(plugin):
        result = kind().measure(subject)
        wrong = next((one for one in result.findings if not isinstance(one, Finding)), None)
        if plugin and wrong is not None:
            raise plugin.error(f"found a {type(wrong).__name__}, not a Finding")
        return result
