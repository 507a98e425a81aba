"""Structural: counts, coverage and distances of hulls by label, against the parts of the asset."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from manifold3d import Manifold
from scipy.optimize import linear_sum_assignment

from benchmark.criteria.case import Case
from benchmark.criteria.solid import near, solid
from meshforge.checks.physics.scene import describe_hull, mm
from meshforge.geometry import close_pairs
from meshforge.symbolic import Hull
from script.samples.part import Part
from script.samples.solids import union

_OWN = 0.9  # of a part's volume, in its own hull


def failure(case: Case, **fields: Any) -> str | None:
    """Why the hulls are not as they should be, by the first of the fields that does not hold; all must be known."""
    assert fields and fields.keys() <= _CHECKS.keys(), sorted(fields)
    for name, value in fields.items():
        why = _CHECKS[name](case, value)
        if why:
            return f"{name}: {why}"
    return None


def _of(case: Case, labels: Iterable[str]) -> list[Hull]:
    wanted = frozenset(labels)
    return [hull for hull in case.mesh.hulls if hull.label in wanted]


def _parts(case: Case, labels: Iterable[str]) -> list[Part]:
    wanted = frozenset(labels)
    return [part for part in case.asset.parts if part.label in wanted]


def _single(case: Case, labels: Sequence[str]) -> str | None:
    """Each part is one hull of its label."""
    for label in labels:
        parts, hulls = _parts(case, [label]), _of(case, [label])
        if len(parts) != len(hulls):
            return f"parts {label}: {len(parts)}, hulls: {len(hulls)}"
        bodies = [solid(hull) for hull in hulls]
        shares = np.array([[_share(part.solid, body) for body in bodies] for part in parts])
        if not shares.size:
            continue
        rows, columns = linear_sum_assignment((shares >= _OWN) + 0.001 * shares, maximize=True)
        own = shares[rows, columns]
        worst = int(own.argmin())
        if own[worst] < _OWN:
            return f"{parts[worst].name} has {own[worst]:.0%} of its volume in {describe_hull(hulls[columns[worst]])}"
    return None


def _share(part: Manifold, hull: Manifold) -> float:
    """What share of a part lies in a hull."""
    return float((part ^ hull).volume() / part.volume()) if near(part, hull) else 0.0


def _absent(case: Case, labels: Sequence[str]) -> str | None:
    left = _of(case, labels)
    return f"{_number(left)} left, such as {describe_hull(left[0])}" if left else None


def _present(case: Case, labels: Sequence[str]) -> str | None:
    lacking = [label for label in labels if not _of(case, [label])]
    return f"there is no hull {lacking[0]}" if lacking else None


def _primitives(case: Case, labels: Sequence[str]) -> str | None:
    others = [hull for hull in _of(case, labels) if not hull.primitive]
    return f"{_number(others)} of another kind, such as {describe_hull(others[0])}" if others else None


def _most(case: Case, most: int) -> str | None:
    hulls = case.mesh.hulls
    return f"{_number(hulls)}, {most} at most wanted" if len(hulls) > most else None


def _most_of(case: Case, most: Mapping[str, int]) -> str | None:
    for label, number in most.items():
        hulls = _of(case, [label])
        if len(hulls) > number:
            return f"{_number(hulls)} {label}, {number} at most wanted"
    return None


def _covers(case: Case, rule: Mapping[str, Any]) -> str | None:
    """So much of the parts lies in hulls, of whatever label."""
    parts = _parts(case, rule["labels"])
    if not parts:
        return None
    whole = union([part.solid for part in parts])
    bodies = [body for body in map(solid, case.mesh.hulls) if near(body, whole)]
    inside = float((whole ^ union(bodies)).volume() / whole.volume()) if bodies else 0.0
    share = rule["share"]
    return f"{inside:.1%} of {_name(rule)} lies in hulls, {share:.0%} wanted" if inside < share else None


def _within(case: Case, rule: Mapping[str, Any]) -> str | None:
    """Hulls lie in the convex hulls of the parts of their labels."""
    bodies = [solid(hull) for hull in _of(case, rule["labels"])]
    if not bodies:
        return None
    whole = union(bodies)
    room = [part.solid.hull() for part in _parts(case, rule["labels"])]
    outside = float((whole - union(room)).volume() / whole.volume()) if room else 1.0
    return f"{outside:.1%} of the hulls {_name(rule)} lies outside of the parts" if outside > rule["excess"] else None


def _gap(case: Case, rule: Mapping[str, Any]) -> str | None:
    """Hulls of some labels are so far from those of others."""
    one, other = _of(case, rule["of"]), _of(case, rule["to"])
    hulls = [*one, *other]
    pairs = close_pairs([hull.shape for hull in hulls], rule["least"])
    across = {pair: gap for pair, gap in pairs.items() if pair[0] < len(one) <= pair[1] and gap < rule["least"]}
    if not across:
        return None
    i, j = min(across, key=across.__getitem__)
    return f"{describe_hull(hulls[i])} is {mm(across[i, j])} from {describe_hull(hulls[j])}, {mm(rule['least'])} wanted"


def _number(hulls: Sequence[Hull]) -> str:
    return "1 hull" if len(hulls) == 1 else f"{len(hulls)} hulls"


def _name(rule: Mapping[str, Any]) -> str:
    return ", ".join(rule["labels"])


_CHECKS: dict[str, Callable[[Case, Any], str | None]] = {
    "single": _single,
    "absent": _absent,
    "present": _present,
    "primitives": _primitives,
    "most": _most,
    "most_of": _most_of,
    "covers": _covers,
    "within": _within,
    "gap": _gap,
}
