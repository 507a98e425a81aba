"""The contact graph: which hulls are near each other, by exact distances behind a broad phase."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from meshforge.geometry import Shape, close_pairs

ContactGraph = Mapping[tuple[int, int], float]
"""Distance [m] of each pair (i, j), i < j, that is within reach."""

NEAR_MISS = 3.0
"""Pairs within this many times the contact distance are kept, to be shown."""


def contact_graph(
    shapes: Sequence[Shape],
    reach: float,
    known: ContactGraph | None = None,
    kept: Mapping[int, int] | None = None,
) -> ContactGraph:
    """Distances of all pairs of shapes that are at most `reach` [m] apart, in the order of their indices.

    known, kept: distances of an earlier list of shapes, and for each shape that was in it, its index there;
    pairs of two kept shapes are taken over, all others are measured.
    """
    if known is None or not kept:
        return close_pairs(shapes, reach)
    back = {old: new for new, old in kept.items()}
    found = {
        (min(back[i], back[j]), max(back[i], back[j])): gap for (i, j), gap in known.items() if i in back and j in back
    }
    if len(kept) < len(shapes):
        found.update(close_pairs(shapes, reach, settled=frozenset(kept)))
    return dict(sorted(found.items()))
