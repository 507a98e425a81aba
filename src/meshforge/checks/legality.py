"""What a check finds, and what every hull and every mesh must be, whatever the engine."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from meshforge.common import join_names, pluralize
from meshforge.geometry import Polytope, Shape, digest, is_closed, is_convex, is_outward, spans_volume
from meshforge.symbolic import Hull, SymbolicMesh

Severity = Literal["error", "warning"]

_CONVEXITY = 1e-6  # relative to the hull's size; single precision leaves 1e-7

_REHULL = "Merge the hull by itself, which makes it anew, or delete it."


@dataclass(frozen=True, slots=True)
class Finding:
    """A rule that does not hold, for the hulls it names.

    error: engines or this program will refuse or misread the hulls; warning: allowed, but worth a look.
    """

    rule: str
    severity: Severity
    hulls: tuple[str, ...]
    message: str
    remedy: str


@dataclass(frozen=True, slots=True)
class HullRule:
    """A rule for one hull; problem completes `<names>: `."""

    name: str
    problem: str
    remedy: str
    is_broken: Callable[[Shape], bool]


HULL_RULES = (
    HullRule(
        "finite",
        "coordinates that are not finite numbers",
        "Fix the file's vertices.",
        lambda shape: not (np.isfinite(shape.vertices).all() and np.isfinite(shape.volume)),
    ),
    HullRule("solid", "too few vertices for a volume", "Delete the hull.", lambda shape: len(shape.vertices) < 4),
    HullRule(
        "flat",
        "no thickness",
        "Give it a thickness, replace it by a box, or delete it.",
        lambda shape: not spans_volume(shape.vertices),
    ),
    HullRule("closed", "not closed", _REHULL, lambda shape: isinstance(shape, Polytope) and not is_closed(shape.faces)),
    HullRule("volume", "no positive volume (inside out, or empty)", _REHULL, lambda shape: shape.volume <= 0),
    HullRule(
        "convex",
        "not convex",
        "Decompose it, or merge the hull by itself, which fills its hollows.",
        lambda shape: isinstance(shape, Polytope) and not is_convex(shape.vertices, shape.faces, _CONVEXITY),
    ),
    HullRule(
        "outward",
        "faces that look inwards",
        _REHULL,
        lambda shape: isinstance(shape, Polytope) and not is_outward(shape.vertices, shape.faces),
    ),
)
"""In this order: of a hull that breaks several, only the first is reported, since the others follow from it."""


def check_legality(mesh: SymbolicMesh) -> tuple[frozenset[str], tuple[Finding, ...]]:
    """The names of the hulls that are no hulls, and everything found."""
    faults: dict[str, list[str]] = {rule.name: [] for rule in HULL_RULES}
    for hull in mesh.hulls:
        rule = _find_broken_rule(hull.shape)
        if rule:
            faults[rule.name].append(hull.name)
    findings = [
        Finding(rule.name, "error", tuple(names), f"{join_names(names)}: {rule.problem}", rule.remedy)
        for rule in HULL_RULES
        if (names := faults[rule.name])
    ]
    faulty = frozenset(name for names in faults.values() for name in names)
    sound = [hull for hull in mesh.hulls if hull.name not in faulty]
    return faulty, (
        *findings,
        *_check_names(mesh),
        *_check_bodies(mesh),
        *_check_duplicates(sound),
        *_report_opaque(mesh),
    )


def _find_broken_rule(shape: Shape) -> HullRule | None:
    with np.errstate(all="ignore"):
        return next((rule for rule in HULL_RULES if rule.is_broken(shape)), None)


def _check_names(mesh: SymbolicMesh) -> Iterator[Finding]:
    names = [hull.name for hull in mesh.hulls]
    twice = [name for name in dict.fromkeys(names) if names.count(name) > 1]
    if twice:
        message = f"{join_names(twice)}: a name that several hulls have"
        yield Finding("name", "error", tuple(twice), message, "Give each hull a name of its own.")


def _check_bodies(mesh: SymbolicMesh) -> Iterator[Finding]:
    bodies = None if mesh.asset is None else {body.name for body in mesh.asset.bodies}
    astray = [h.name for h in mesh.hulls if (not h.body if bodies is None else h.body not in bodies)]
    if astray:
        yield Finding("body", "error", tuple(astray), f"{join_names(astray)}: of no body", "Put the hull into a body.")


def _check_duplicates(hulls: list[Hull]) -> Iterator[Finding]:
    """One finding for each set of hulls that are the same in single precision, in whatever body."""
    alike: dict[str, list[str]] = {}
    for hull in hulls:
        alike.setdefault(digest(hull.shape), []).append(hull.name)
    for names in alike.values():
        if len(names) > 1:
            message = f"{join_names(names)}: the same hull {pluralize(len(names), 'time')}"
            yield Finding("duplicate", "warning", tuple(names), message, "Delete all but one.")


def _report_opaque(mesh: SymbolicMesh) -> Iterator[Finding]:
    for piece in mesh.asset.opaque if mesh.asset else ():
        remedy = "A mesh can be decomposed into hulls; anything else is left as it is."
        yield Finding("opaque", "warning", (piece.name,), f"{piece.name}: no convex hull ({piece.reason})", remedy)
