"""What every hull and every mesh must be, whatever the engine; and what is legal but odd: slivers, oblong hulls, hulls
inside of others, pairs that overlap or gape."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from meshforge import geometry
from meshforge.common import join_names, pluralize
from meshforge.engines import Finding
from meshforge.symbolic import MISSING_REMEDY, Hull, SymbolicMesh

_REHULL = "Merge the hull by itself, which makes it anew, or delete it."
_SPLIT = "A mesh can be decomposed into hulls; anything else is left as it is."


_REMEDIES: Mapping[geometry.HullFault, str] = {
    "finite": "Fix the file's vertices.",
    "solid": "Delete the hull.",
    "flat": "Give it a thickness, replace it by a box, or delete it.",
    "closed": _REHULL,
    "volume": _REHULL,
    "convex": "Decompose it, or merge the hull by itself, which fills its hollows.",
    "outward": _REHULL,
}


def check_legality(mesh: SymbolicMesh) -> tuple[frozenset[str], tuple[Finding, ...]]:
    """Return the names of the hulls that are no hulls, and everything found."""
    faults: dict[geometry.HullFault, list[str]] = {fault: [] for fault in _REMEDIES}
    for hull in mesh.hulls:
        if fault := geometry.find_fault(hull.shape):
            faults[fault].append(hull.name)
    texts = {fault: geometry.describe_fault(fault).partition(" ")[2] for fault in faults}
    findings = [
        Finding(fault, "error", tuple(names), f"{join_names(names)}: {texts[fault]}", _REMEDIES[fault])
        for fault, names in faults.items()
        if names
    ]
    faulty = frozenset(name for names in faults.values() for name in names)
    return faulty, (
        *findings,
        *_check_files(mesh),
        *_check_names_and_bodies(mesh),
        *_check_duplicates([hull for hull in mesh.hulls if hull.name not in faulty]),
        *(
            Finding("non_convex", "warning", (piece.name,), f"{piece.name}: no convex hull ({piece.reason})", _SPLIT)
            for piece in (mesh.asset.non_convex if mesh.asset else ())
        ),
    )


def _check_files(mesh: SymbolicMesh) -> Iterator[Finding]:
    if mesh.asset is not None and mesh.asset.needed:
        message = f"not there: {join_names(mesh.asset.needed, 5)}"
        yield Finding("missing", "error", (), message, MISSING_REMEDY)


def _check_names_and_bodies(mesh: SymbolicMesh) -> Iterator[Finding]:
    names = [hull.name for hull in mesh.hulls]
    twice = [name for name in dict.fromkeys(names) if names.count(name) > 1]
    if twice:
        message = f"{join_names(twice)}: a name that several hulls have"
        yield Finding("name", "error", tuple(twice), message, "Give each hull a name of its own.")
    bodies = None if mesh.asset is None else {body.name for body in mesh.asset.bodies}
    astray = [h.name for h in mesh.hulls if (not h.body if bodies is None else h.body not in bodies)]
    if astray:
        yield Finding("body", "error", tuple(astray), f"{join_names(astray)}: of no body", "Put the hull into a body.")


def _check_duplicates(hulls: list[Hull]) -> Iterator[Finding]:
    """One finding for each set of hulls that are the same in single precision, in whatever body."""
    alike: dict[str, list[str]] = {}
    for hull in hulls:
        alike.setdefault(geometry.digest(hull.shape), []).append(hull.name)
    for names in alike.values():
        if len(names) > 1:
            message = f"{join_names(names)}: the same hull {pluralize(len(names), 'time')}"
            yield Finding("duplicate", "warning", tuple(names), message, "Delete all but one.")


SLIVER = 0.02
"""A hull that is thinner than this share of its second extent is a sliver."""
OBLONG = 20.0
"""A hull that is longer than this many times its second extent is oblong."""
INNER = 1e-3
"""A hull that rises above another by no more than this share of its own size is inside of it."""
OVERLAP = 0.25
"""Hulls of one body that share more than this of the smaller one's volume overlap."""
_PAIRS = 20_000  # that are measured; the nearest come first, and how many were left out is reported


def find_oddities(mesh: SymbolicMesh) -> tuple[Finding, ...]:
    """Return slivers, oblong and inner hulls, overlaps and gaps within bodies.

    A gap is one that is wider than the contact distance of the mesh, but not by more than three times.
    """
    return (*_find_thin(mesh.hulls), *_find_overlaps(mesh), *_find_gaps(mesh))


def _find_thin(hulls: Sequence[Hull]) -> Iterator[Finding]:
    sizes = {h.name: geometry.measure_extents(h.vertices) for h in hulls}
    slivers = {name: e[2] / e[1] for name, e in sizes.items() if e[2] < SLIVER * e[1]}
    oblong = {name: e[0] / e[1] for name, e in sizes.items() if e[0] > OBLONG * e[1]}
    if slivers:
        listed = join_names([f"{name} ({1 / max(share, 1e-12):.3g} to 1)" for name, share in slivers.items()])
        message = f"{listed}: a sliver, much thinner than wide"
        remedy = "Delete it, merge it with a neighbour, or give it a thickness."
        yield Finding("shape-sliver", "warning", tuple(slivers), message, remedy)
    if oblong:
        listed = join_names([f"{name} ({ratio:.3g} to 1)" for name, ratio in oblong.items()])
        message = f"{listed}: oblong, much longer than wide"
        yield Finding("shape-oblong", "warning", tuple(oblong), message, "Split it along its length.")


def _find_overlaps(mesh: SymbolicMesh) -> Iterator[Finding]:
    hulls = mesh.hulls
    touching = sorted(pair for pair, gap in mesh.graph.items() if gap == 0.0)
    same = [(i, j) for i, j in touching if hulls[i].body == hulls[j].body]
    inner: dict[str, str] = {}
    overlaps: list[tuple[float, str, str]] = []
    for i, j in same[:_PAIRS]:
        small, large = sorted((hulls[i], hulls[j]), key=lambda h: h.volume)
        if _is_within(small, large):
            inner.setdefault(small.name, large.name)
        elif (share := geometry.overlap_volume(small.shape, large.shape) / small.volume) > OVERLAP:
            overlaps.append((share, small.name, large.name))
    if inner:
        listed = join_names([f"{name} (in {other})" for name, other in inner.items()])
        yield Finding("shape-inner", "warning", tuple(inner), f"{listed}: inside of another hull", "Delete it.")
    if overlaps:
        overlaps.sort(key=lambda row: (-row[0], row[1], row[2]))
        listed = join_names([f"{a} and {b} ({100 * share:.0f}%)" for share, a, b in overlaps])
        names = tuple(dict.fromkeys(name for _, a, b in overlaps for name in (a, b)))
        message = f"{pluralize(len(overlaps), 'pair')} that share much of the smaller one's volume: {listed}"
        yield Finding("shape-overlap", "warning", names, message, "Merge them, or shrink one.")
    if len(same) > _PAIRS:
        message = f"only {_PAIRS:,} of {len(same):,} pairs of hulls were measured for overlaps"
        yield Finding("shape-overlap", "warning", (), message, "Merge small hulls.")


def _is_within(small: Hull, large: Hull) -> bool:
    slack = INNER * float(np.max(small.aabb.size))
    a, b = small.aabb, large.aabb
    if (a.min < b.min - slack).any() or (a.max > b.max + slack).any():
        return False
    return not geometry.rises_above(small.vertices, large.vertices, large.faces, slack)


def _find_gaps(mesh: SymbolicMesh) -> Iterator[Finding]:
    rows = [row for row in mesh.near_misses if mesh.hulls[row[0]].body == mesh.hulls[row[1]].body]
    if rows:
        pairs = [(mesh.hulls[i].name, mesh.hulls[j].name, gap) for i, j, gap in rows]
        listed = join_names([f"{a} and {b} ({gap:.3g} m)" for a, b, gap in pairs])
        names = tuple(dict.fromkeys(name for a, b, _ in pairs for name in (a, b)))
        message = f"{pluralize(len(rows), 'narrow gap')}: {listed}"
        yield Finding("shape-gap", "warning", names, message, "Things catch in it: scale one until they touch.")
