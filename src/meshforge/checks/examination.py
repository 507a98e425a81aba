"""The checks by the names that `check --check` takes: built in, engines, plug-ins; and all of one mesh that are asked
for, with their pictures; `check` costs little, the others measure."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from inspect import isabstract
from typing import TYPE_CHECKING, Any, TypeVar

from meshforge.checks.base import VALIDATORS, Check, CheckFindings, CheckSubject, EngineLoad, Measure, MeasureCheck
from meshforge.checks.clearance import ClearanceCheck
from meshforge.checks.fit import FitCheck
from meshforge.checks.legality import check_legality
from meshforge.checks.physics.pairs import PairsCheck
from meshforge.checks.physics.simulation import PhysicsCheck
from meshforge.checks.physics.speed import SpeedCheck
from meshforge.common import Plugin, PluginError, Registry, UsageError, blame, suggest_among
from meshforge.engines import ENGINES, Finding, check_limits, find_engine
from meshforge.rendering import LengthUnit
from meshforge.symbolic import SymbolicMesh

if TYPE_CHECKING:
    from PIL.Image import Image


REFUSED = "MuJoCo refuses this file"
"""How a note begins on an MJCF that was read for its collision geometry only."""
ENGINE_LOAD = "engine"
"""The key of what an engine itself said."""

MeasureKind = TypeVar("MeasureKind", bound=Measure)


@dataclass(frozen=True, slots=True)
class CheckOptions:
    """What is checked besides legality: checks by name, an engine's first; cell: of the grids of measures [m]."""

    names: tuple[str, ...] = ()
    cell: float | None = None

    @staticmethod
    def of(names: Iterable[str], cell: float | None = None) -> CheckOptions:
        """Return the checks of some names. Raises UsageError for a name that is not known, or a second engine;
        PluginError for a plug-in that cannot be loaded."""
        known = tuple(dict.fromkeys(names))
        for name in known:
            if CHECKS.get(name) is None:
                raise UsageError(f"there is no check {name!r}", remedy=suggest_among(name, CHECKS, "There are"))
        engines = [name for name in known if name in ENGINES]
        if len(engines) > 1:
            raise UsageError(f"two engines: {', '.join(engines)}", remedy="Choose one of them.")
        return CheckOptions((*engines, *(name for name in known if name not in ENGINES)), cell)

    @property
    def engine(self) -> str | None:
        """The engine whose limits are checked."""
        return next((name for name in self.names if name in ENGINES), None)

    @property
    def validators(self) -> tuple[str, ...]:
        """The other validators that are asked."""
        return tuple(name for name in self.names if name in VALIDATORS)

    @property
    def is_costly(self) -> bool:
        """Whether anything is measured that takes its time."""
        return any(name not in ENGINES for name in self.names)

    @property
    def checks(self) -> tuple[Check, ...]:
        """The checks."""
        return tuple(CHECKS[name]() for name in self.names)


@dataclass(frozen=True, eq=False, slots=True)
class Examination:
    """What was found of a mesh; measures: by their keys in JSON, in the order in which they are described; unmeasured:
    what a check could not measure, by its name."""

    findings: tuple[Finding, ...]
    measures: Mapping[str, Measure] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    unmeasured: Mapping[str, str] = field(default_factory=dict)

    def get(self, key: str, kind: type[MeasureKind]) -> MeasureKind | None:
        """Return a measure, None where it was not asked for or could not be measured."""
        found = self.measures.get(key)
        return found if isinstance(found, kind) else None

    @property
    def loaded(self) -> EngineLoad | None:
        """What the hulls were held against, where the limits of an engine were asked for."""
        return self.get(ENGINE_LOAD, EngineLoad)

    def add_engine_load(self, loaded: EngineLoad) -> Examination:
        """Return the same with what an engine itself said."""
        return self.add_result(loaded.engine, CheckFindings(tuple(loaded.findings), {ENGINE_LOAD: loaded}))

    def add_result(self, check: str, result: CheckFindings) -> Examination:
        """Return the same with what a check found that is none of the mesh alone."""
        findings = (replace(finding, check=check) for finding in result.findings)
        return replace(self, findings=(*findings, *self.findings), measures={**self.measures, **result.measures})

    def add_notes(self, notes: Iterable[str]) -> Examination:
        """Return the same with more notes, but for what its trial has said in a finding."""
        refused = self.loaded is not None and self.loaded.refusal is not None
        more = (note for note in notes if not (refused and note.startswith(REFUSED)))
        return replace(self, notes=(*self.notes, *more))

    @property
    def has_failed(self) -> bool:
        """Whether a finding is an error."""
        return any(finding.severity == "error" for finding in self.findings)

    def __str__(self) -> str:
        """What was measured and what is wrong, line by line; `legal` where there is nothing else to say."""
        lines = [*self.descriptions, *map(str, self.findings)]
        if not self.findings and len(lines) == bool(self.loaded):
            return f"legal{f' ({self.loaded.description})' if self.loaded else ''}"
        return "\n".join(lines)

    @property
    def descriptions(self) -> tuple[str, ...]:
        """What was measured, a sentence each."""
        titles = {key: key.removesuffix("_of_edit").replace("_", " ") for key in self.measures}
        texts = (f"{titles[key]}: {one.description}" for key, one in self.measures.items() if one.description)
        return (*texts, *(f"note: {note}" for note in self.notes))

    def to_json(self) -> dict[str, Any]:
        """Return the measures as JSON-able data, without the findings; what was not measured is left out."""
        notes = {"notes": list(self.notes)} if self.notes else {}
        return {key: one.to_json() for key, one in self.measures.items()} | notes


def examine_mesh(mesh: SymbolicMesh, wanted: CheckOptions, before: SymbolicMesh | None = None) -> Examination:
    """Check a mesh; before: the mesh that it was edited from, whose visual mesh counts then.

    Hulls that are not legal are left out of all but the first findings. Raises UsageError for an unknown engine.
    """
    subject = CheckSubject(mesh, before, wanted.cell)
    results = list(run_checks(wanted.names, subject))
    findings = (*subject.legality[1], *(finding for one in results for finding in one.findings))
    measures = {key: measure for one in results for key, measure in one.measures.items()}
    notes = tuple(dict.fromkeys(note for one in results for note in one.notes))
    unmeasured = {name: "; ".join(one.notes) for name, one in zip(wanted.names, results, strict=True) if one.notes}
    return Examination(findings, measures, notes, unmeasured)


def check(mesh: SymbolicMesh, engine: str | None = None) -> tuple[Finding, ...]:
    """Return what is not legal in a mesh, and with an engine, what is beyond its limits; empty where all is well.

    Raises UsageError for an engine that is not known.
    """
    known = None if engine is None else find_engine(engine)
    faulty, findings = check_legality(mesh)
    return findings if known is None else (*findings, *check_limits(known, mesh, faulty))


def draw_examination(
    mesh: SymbolicMesh, found: Examination, size: tuple[int, int] = (640, 480), unit: LengthUnit = "m"
) -> Iterator[tuple[str, str, Image]]:
    """Yield a name for a file, a line of text and a picture each: heat maps of the fit, and what was closed and opened.

    unit: of the legends; the lines have metres and litres.
    """
    for key, one in found.measures.items():
        yield from one.draw(mesh, key.replace("_", "-"), size, unit)


MEASURES: tuple[type[Check], ...] = (FitCheck, ClearanceCheck, PhysicsCheck, PairsCheck)
"""The checks of what can be measured, besides engines and speed."""


class EngineCheck(MeasureCheck):
    """The limits of an engine."""

    compares = False

    def __init__(self, engine: str) -> None:
        self.name = engine

    def measure(self, subject: CheckSubject) -> CheckFindings:
        return CheckFindings(tuple(check_limits(find_engine(self.name), subject.mesh, subject.legality[0])))


class ValidatorCheck(EngineCheck):
    """Another validator, which is asked where the file is known: of a mesh alone it says nothing."""

    def measure(self, subject: CheckSubject) -> CheckFindings:
        return CheckFindings()


def _adopt(plugin: Plugin, kind: Any) -> Callable[[], Check]:
    """The class of a plug-in's check. Raises PluginError where it does not fit."""
    if not (isinstance(kind, type) and issubclass(kind, Check)):
        raise plugin.error("does not fit: it is no subclass of meshforge.checks.Check")
    if isabstract(kind):
        raise plugin.error(f"does not fit: it has no method {min(kind.__abstractmethods__)}")
    return kind


CHECKS: Registry[Callable[[], Check]] = Registry(
    "checks",
    {kind.name: kind for kind in MEASURES}
    | {"speed": SpeedCheck}
    | {name: partial(EngineCheck, name) for name in ENGINES}
    | {name: partial(ValidatorCheck, name) for name in VALIDATORS},
    _adopt,
)


def run_checks(names: Sequence[str], subject: CheckSubject) -> Iterator[CheckFindings]:
    """Yield what checks find; of a plug-in's that fails, or is missing here, an error that says so."""
    for name in names:
        try:
            yield _run_check(name, subject)
        except PluginError as error:
            yield CheckFindings((Finding(name, "error", (), error.problem, error.remedy or "", name),))


def _run_check(name: str, subject: CheckSubject) -> CheckFindings:
    plugin, kind = CHECKS.plugin(name), CHECKS[name]
    with blame(plugin):
        result = kind().measure(subject)
        wrong = next((one for one in result.findings if not isinstance(one, Finding)), None)
        if plugin and wrong is not None:
            raise plugin.error(f"found a {type(wrong).__name__}, not a Finding")
        own = next((one.rule for one in result.findings if plugin and one.code), None)
        if plugin and own is not None:
            raise plugin.error(f"calls a rule {own!r}, which MeshForge has itself", remedy="Give it another name.")
        return replace(result, findings=tuple(replace(one, check=name) for one in result.findings))
