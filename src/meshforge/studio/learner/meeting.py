"""What an extractor selects on assets as a rule meets them."""

from __future__ import annotations

from dataclasses import dataclass
from weakref import WeakKeyDictionary

from meshforge.errors import MeshForgeError
from meshforge.language import EXTREMITY, Extractor, apply_rule, select_mask
from meshforge.studio.learner.reach import Origins, Plan
from meshforge.symbolic import SymbolicMesh, bits
from meshforge.synthesis import Demonstration
from meshforge.synthesis.replay import begun


@dataclass(frozen=True, eq=False, slots=True)
class _Met:
    """An asset after the rules of a plan, None where they cannot be done; origins: of its hulls, in their order."""

    key: tuple[str, str]
    mesh: SymbolicMesh | None
    origins: tuple[tuple[int, ...], ...] = ()


class Meetings:
    """Assets as a rule meets them, each after the rules that were asked for last: extractors are typed by letters."""

    def __init__(self) -> None:
        self._last: WeakKeyDictionary[SymbolicMesh, _Met] = WeakKeyDictionary()

    def select(self, plan: Plan, mesh: SymbolicMesh, extractor: Extractor) -> tuple[int, ...]:
        """Positions of an asset's own hulls that an extractor selects after the rules of a plan, or of which was made
        what it selects; nothing where these rules cannot be done."""
        met = self._last.get(mesh)
        if met is None or met.key != plan.key:
            met = self._last[mesh] = _met(plan, mesh)
        if met.mesh is None:
            return ()
        found = bits(select_mask(extractor, met.mesh, plan.program.extremity or EXTREMITY))
        return tuple(sorted({own for k in found for own in met.origins[k]}))


def _met(plan: Plan, mesh: SymbolicMesh) -> _Met:
    program, origins, used = plan.program, Origins(mesh), frozenset[str]()
    try:
        current = begun("", Demonstration(mesh, ()), program.orient, program.contact).mesh
        for rule in program.rules:
            _, applied = apply_rule(current, rule, plan.templates, program.extremity, used)
            origins.add(applied.made, applied.sources)
            current, used = applied.mesh, applied.used
    except MeshForgeError:
        return _Met(plan.key, None)
    return _Met(plan.key, current, tuple(origins.of([hull.name]) for hull in current.hulls))
