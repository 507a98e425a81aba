"""What a program reaches on an asset: positions of the asset's own hulls."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from meshforge.batch.assets.digests import template_digests
from meshforge.errors import MeshForgeError
from meshforge.language import Program, Template
from meshforge.studio.wire.lesson import Reach
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.remember import remembered


@dataclass(frozen=True, eq=False)
class Plan:
    """A program with the templates that it names."""

    program: Program
    templates: Mapping[str, Template]

    @cached_property
    def key(self) -> tuple[str, str]:
        """What it does on an asset follows from this."""
        return str(self.program), str(template_digests(self.templates))


class Origins:
    """Which of an asset's own hulls each hull is, or was made of, in the midst of a run."""

    def __init__(self, mesh: SymbolicMesh) -> None:
        self._own: dict[str, frozenset[int]] = {name: frozenset({k}) for name, k in mesh.index.items()}

    def of(self, names: Iterable[str]) -> tuple[int, ...]:
        """Positions of the asset's own hulls, sorted."""
        return tuple(sorted(frozenset[int]().union(*(self._own[name] for name in names))))

    def add(self, made: Sequence[str], sources: Sequence[Sequence[str]]) -> None:
        """Take note of hulls that were made, and of what."""
        for name, parts in zip(made, sources, strict=True):
            self._own[name] = frozenset(self.of(parts))


def reached(plan: Plan, asset: str, mesh: SymbolicMesh) -> Reach:
    """What a program does on an asset; worked out once for both."""
    return remembered(mesh, ("reach", asset, plan.key), Reach, lambda: _reached(plan, asset, mesh))


def _reached(plan: Plan, asset: str, mesh: SymbolicMesh) -> Reach:
    try:
        run = plan.program.run(mesh, plan.templates)
    except MeshForgeError as error:
        return Reach(asset=asset, before=len(mesh.hulls), after=len(mesh.hulls), error=error.message)
    origins, rules = Origins(mesh), []
    for line in run.trace:
        rules.append(origins.of(line.selected))
        origins.add(line.made, line.sources)
    return Reach(asset=asset, rules=tuple(rules), before=len(mesh.hulls), after=len(run.mesh.hulls))
