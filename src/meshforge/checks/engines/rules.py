"""What the rules of limits measure, and what to do about a hull that breaks one."""

from __future__ import annotations

from collections.abc import Callable

from meshforge.checks.engines import measures
from meshforge.checks.engines.limit import Bound, Limit
from meshforge.checks.finding import Severity
from meshforge.geometry import Polytope

_SIMPLER = "Reduce it (check --fix), replace it by a primitive, or split it."
_THICKER = "Give it a thickness, replace it by a box, or merge it with a neighbour."
_SHORTER = "Split it along its length."
_KINDS: dict[str, tuple[Callable[[Polytope], float], str, Bound, str]] = {
    "vertices": (measures.vertices, "vertices", "most", _SIMPLER),
    "polygons": (measures.polygons, "flat faces", "most", _SIMPLER),
    "face-vertices": (measures.largest_polygon, "vertices on one flat face", "most", _SIMPLER),
    "vertex-faces": (measures.polygons_at_a_vertex, "flat faces at one vertex", "most", _SIMPLER),
    "oblong": (measures.slenderness, "times as long as the sphere inside is wide", "most", _SHORTER),
    "thin": (measures.thickness, "m thick", "least", _THICKER),
    "volume": (measures.volume, "m³", "least", _THICKER),
}


def limit(rule: str, number: float, severity: Severity, problem: str, source: str) -> Limit:
    """A limit of one of the rules that there are; number: the most, or the least, as the rule has it."""
    measure, what, bound, remedy = _KINDS[rule]
    return Limit(rule, measure, number, what, severity, problem, remedy, source, bound)
