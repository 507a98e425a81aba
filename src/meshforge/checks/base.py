"""What every check is: it sees a mesh, what it was before an edit, and says what is wrong and what it measured; and
what an asset was held against where an engine was named: our table of its limits alone, or the engine itself."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal

from meshforge.checks.legality import check_legality
from meshforge.engines import Finding, find_engine
from meshforge.symbolic import SymbolicMesh

if TYPE_CHECKING:
    from PIL.Image import Image

    from meshforge.rendering import LengthUnit

LEAST_SIZE, MOST_SIZE = 0.005, 50.0
"""Diagonals of assets [m] at which gravity and grippers mean something; others are probably in another unit."""
VALIDATORS = MappingProxyType(
    {"simcheck": ("simcheck",), "simready": ("simready-validate", "simready-foundation-tier-core")}
)
"""Other validators that give a second opinion on a file, by name, with the packages that they are."""
NO_VISUAL_MESH = "nothing is shown (no visual mesh), so clearance and fit have nothing to be measured against"


@dataclass(frozen=True)
class CheckSubject:
    """What is checked. before: the mesh that it was edited from, if known; cell: of grids [m], None for the default."""

    mesh: SymbolicMesh
    before: SymbolicMesh | None = None
    cell: float | None = None

    @cached_property
    def legality(self) -> tuple[frozenset[str], tuple[Finding, ...]]:
        """The names of the hulls that are not legal, and what is wrong with them."""
        return check_legality(self.mesh)

    @cached_property
    def sound(self) -> SymbolicMesh:
        """The mesh without hulls that are not legal, with the visual mesh of before the edit: where collision geometry
        is what is shown, an edit changes that, too."""
        mesh, faulty = self.mesh, self.legality[0]
        if self.before is not None and self.before.asset is not None and mesh.asset is not None:
            mesh = replace(mesh, asset=replace(mesh.asset, visuals=self.before.asset.visuals))
        return _without(mesh, faulty)

    @cached_property
    def sound_before(self) -> SymbolicMesh | None:
        """The mesh before without hulls that are not legal."""
        return _without(self.before, check_legality(self.before)[0]) if self.before else None


def _without(mesh: SymbolicMesh, faulty: frozenset[str]) -> SymbolicMesh:
    return mesh.with_hulls(hull for hull in mesh.hulls if hull.name not in faulty) if faulty else mesh


class Measure(ABC):
    """What a check measured of a mesh. description: a sentence, empty where there is nothing to describe."""

    @property
    @abstractmethod
    def description(self) -> str: ...

    @abstractmethod
    def to_json(self) -> dict[str, Any]:
        """Return the measure as JSON-able data, in SI units, volumes in litres."""

    def draw(
        self, mesh: SymbolicMesh, name: str, size: tuple[int, int], unit: LengthUnit
    ) -> Iterator[tuple[str, str, Image]]:
        """Return a name for a file, a line of text and a picture each; unit: of legends; name: of the measure."""
        return iter(())


@dataclass(frozen=True, eq=False, slots=True)
class CheckFindings:
    """What a check found: findings; measures by their keys in JSON; notes on what could not be measured."""

    findings: tuple[Finding, ...] = ()
    measures: Mapping[str, Measure] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


class Check(ABC):
    """A check, built in or of a plug-in; it is made anew for each asset, without arguments.

    name: what `check --check` takes, for those that are built in; has_cells: whether it measures on a grid of cells;
    compares: whether the mesh before an edit matters to it.
    """

    name = ""
    has_cells = False
    compares = True

    @abstractmethod
    def examine(self, mesh: SymbolicMesh, before: SymbolicMesh | None) -> Iterable[Finding]:
        """Return what is wrong with a mesh, nothing where all is well; before: the mesh before the edit, if known."""

    def measure(self, subject: CheckSubject) -> CheckFindings:
        """Return what is wrong, with what was measured to find that out; by default what `examine` says."""
        return CheckFindings(tuple(self.examine(subject.mesh, subject.before)))


class MeasureCheck(Check):
    """A check that is all in its `measure`."""

    def examine(self, mesh: SymbolicMesh, before: SymbolicMesh | None) -> Iterable[Finding]:
        return self.measure(CheckSubject(mesh, before)).findings

    @abstractmethod
    def measure(self, subject: CheckSubject) -> CheckFindings:
        """Return what is wrong, with what was measured to find that out."""


Given = Literal["file", "conversion"]
"""The file itself, or what `meshforge convert` makes of it for the engine."""


@dataclass(frozen=True, slots=True)
class EngineLoad(Measure):
    """What an engine says of an asset, besides our table of its limits.

    engine, file: names; asked: the program and version that was run, None where none was; given: what it was given;
    refusal, warnings: in its own words; differing: where the shapes that it makes are not the hulls that were read;
    untried: why an engine that can be asked was not, empty for one that cannot;
    remedy: for a refusal, or for one that was not tried.
    """

    engine: str
    file: str = ""
    asked: str | None = None
    given: Given | None = None
    refusal: str | None = None
    warnings: tuple[str, ...] = ()
    differing: tuple[Finding, ...] = ()
    untried: str = ""
    remedy: str = ""

    @property
    def description(self) -> str:
        """What was asked, in a sentence; empty where findings say all."""
        title = find_engine(self.engine).title
        if self.refusal or self.untried:
            return ""
        return (
            f"{self.asked} takes {self._subject}"
            if self.asked
            else f"by the limits of {title}, which was not asked itself"
        )

    @property
    def findings(self) -> Iterator[Finding]:
        """What the engine said against the asset, or that it was not asked though it can be."""
        if self.untried:
            message = f"not tried in {find_engine(self.engine).title}: {self.untried}"
            yield Finding(f"{self.engine}-untried", "warning", (), message, self.remedy)
        if self.refusal:
            message = f"{self.asked} refuses {self._subject}: {self.refusal}"
            yield Finding(f"{self.engine}-refused", "error", (), message, self.remedy or "Fix what the message names.")
        yield from self.differing
        for warning in self.warnings:
            yield Finding(f"{self.engine}-warned", "warning", (), f"{self.asked} warns: {warning}", "")

    def to_json(self) -> dict[str, Any]:
        """Return the trial as JSON-able data; `against` is `engine` where that was asked, else `limits`."""
        return {
            "name": self.engine,
            "against": "engine" if self.asked else "limits",
            "asked": self.asked,
            "given": self.given,
            "refused": self.refusal,
            "warnings": list(self.warnings),
            "untried": self.untried or None,
        }

    @property
    def _subject(self) -> str:
        return self.file if self.given == "file" else f"what `meshforge convert` makes of {self.file}"
