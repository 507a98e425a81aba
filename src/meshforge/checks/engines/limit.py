"""What an engine is known by: its limits, and the native shapes that it has."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from meshforge.checks.finding import Severity
from meshforge.geometry import Polytope

Bound = Literal["most", "least"]


@dataclass(frozen=True, slots=True)
class Limit:
    """The most, or the least, that an engine takes of what `measure` gives of a hull that is a mesh.

    what: the thing measured, with its unit; problem: what becomes of a hull beyond; source: where the number stands.
    """

    rule: str
    measure: Callable[[Polytope], float]
    number: float
    what: str
    severity: Severity
    problem: str
    remedy: str
    source: str
    bound: Bound = "most"

    def is_broken(self, value: float) -> bool:
        return value > self.number if self.bound == "most" else value < self.number


@dataclass(frozen=True, slots=True)
class Engine:
    """A physics engine.

    primitives: the kinds of native shapes it has; instead: what becomes of others; hulls: how many a body may have,
    None where nothing is known; the sources say where these stand.
    """

    name: str
    title: str
    limits: tuple[Limit, ...]
    primitives: frozenset[str]
    instead: str
    primitives_source: str
    hulls: int | None = None
    hulls_problem: str = ""
    hulls_source: str = ""
