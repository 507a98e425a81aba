"""The checks that are asked for by name: engines and measurements that are built in, and checks of plug-ins."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Sequence
from inspect import isabstract
from typing import Any

from meshforge.common import Plugin, PluginError, Registry, blame
from meshforge.engines import ENGINES, Finding
from meshforge.symbolic import SymbolicMesh

MEASURES = ("fit", "clearance", "physics")
"""What can be measured, by the names that the command line takes."""


class Check(ABC):
    """A check that a plug-in adds; it is made anew for each asset, without arguments."""

    @abstractmethod
    def examine(self, mesh: SymbolicMesh, before: SymbolicMesh | None) -> Iterable[Finding]:
        """What is wrong with a mesh, nothing where all is well; before: the mesh that it was edited from, if known."""


def _adopt(plugin: Plugin, kind: Any) -> type[Check]:
    """The class of a plug-in's check. Raises PluginError where it does not fit."""
    if not (isinstance(kind, type) and issubclass(kind, Check)):
        raise plugin.error("does not fit: it is no subclass of meshforge.checks.Check")
    if isabstract(kind):
        raise plugin.error("does not fit: it has no method examine")
    return kind


CHECKS: Registry[type[Check]] = Registry("checks", {}, _adopt, reserved=(*MEASURES, *ENGINES))
"""The checks of plug-ins; the names of engines and measurements are not theirs to take."""


def run_checks(names: Sequence[str], mesh: SymbolicMesh, before: SymbolicMesh | None = None) -> Iterator[Finding]:
    """What checks of plug-ins find; of one that fails, or is missing here, an error that says so."""
    for name in names:
        try:
            yield from _run_check(name, mesh, before)
        except PluginError as error:
            yield Finding(name, "error", (), error.problem, error.remedy or "")


def _run_check(name: str, mesh: SymbolicMesh, before: SymbolicMesh | None) -> tuple[Finding, ...]:
    plugin, kind = CHECKS.plugin(name), CHECKS[name]
    with blame(plugin):
        found = tuple(kind().examine(mesh, before))
        odd = next((one for one in found if not isinstance(one, Finding)), None)
        if plugin and odd is not None:
            raise plugin.error(f"found a {type(odd).__name__}, not a Finding")
        return found
