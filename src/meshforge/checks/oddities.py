"""Hulls that are slivers, oblong or inside of others, and pairs that overlap or gape."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from meshforge.checks.legality import Finding
from meshforge.checks.limits import measure_extents
from meshforge.common import join_names, pluralize
from meshforge.geometry import overlap_volume, rises_above
from meshforge.symbolic import Hull, SymbolicMesh

SLIVER = 0.02
"""A hull that is thinner than this share of its second extent is a sliver."""
OBLONG = 20.0
"""A hull that is longer than this many times its second extent is oblong."""
INNER = 1e-3
"""A hull that rises above another by no more than this share of its own size is inside of it."""
OVERLAP = 0.25
"""Hulls of one body that share more than this of the smaller one's volume overlap."""
_PAIRS = 20_000  # that are measured; the nearest come first, and how many were left out is reported


def find_oddities(mesh: SymbolicMesh, faulty: frozenset[str] = frozenset()) -> tuple[Finding, ...]:
    """Slivers, oblong and inner hulls, overlaps and gaps within bodies; `faulty` hulls are left out.

    A gap is one that is wider than the contact distance of the mesh, but not by more than three times.
    """
    hulls = [h for h in mesh.hulls if h.name not in faulty]
    if faulty:
        mesh = mesh.with_hulls(hulls)
    return (*_find_thin(hulls), *_find_overlaps(mesh), *_find_gaps(mesh))


def _find_thin(hulls: Sequence[Hull]) -> Iterator[Finding]:
    sizes = {h.name: measure_extents(h.vertices) for h in hulls}
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
        elif (share := overlap_volume(small.shape, large.shape) / small.volume) > OVERLAP:
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
    return not rises_above(small.vertices, large.vertices, large.faces, slack)


def _find_gaps(mesh: SymbolicMesh) -> Iterator[Finding]:
    rows = [row for row in mesh.near_misses if mesh.hulls[row[0]].body == mesh.hulls[row[1]].body]
    if rows:
        pairs = [(mesh.hulls[i].name, mesh.hulls[j].name, gap) for i, j, gap in rows]
        listed = join_names([f"{a} and {b} ({gap:.3g} m)" for a, b, gap in pairs])
        names = tuple(dict.fromkeys(name for a, b, _ in pairs for name in (a, b)))
        message = f"{pluralize(len(rows), 'narrow gap')}: {listed}"
        yield Finding("shape-gap", "warning", names, message, "Things catch in it: scale one until they touch.")
