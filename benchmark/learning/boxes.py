"""Meshes of boxes at random, with labels at random: as large as one likes, and no rule is easier than it looks."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np

from benchmark.learning.cases import Case
from meshforge.geometry import Aabb, Box
from meshforge.language import Extractor, parse_extractor, select_mask, size_of
from meshforge.symbolic import Hull, Label, SymbolicMesh

LABELS = tuple("abcdefghijkl")
SIZED: dict[int, Extractor] = {
    size_of(extractor): extractor
    for extractor in map(
        parse_extractor,
        (
            "Is(a)",
            "Geo(Is(a), +Z)",
            "Attach(Is(a), Is(b))",
            "Diff(Is(a), Geo(Is(a), -Z))",
            "Union(Is(c), Attach(Is(a), Is(b)))",
            "Union(Geo(Is(c), +Z), Attach(Is(a), Is(b)))",
            "Union(Attach(Is(a), Is(b)), Attach(Is(d), Is(e)))",
            "Union(Attach(Is(a), Is(b)), Union(Is(c), Geo(Is(d), +Z)))",
            "Union(Attach(Is(a), Is(b)), Union(Is(c), Attach(Is(d), Is(e))))",
            "Union(Attach(Is(a), Is(b)), Union(Geo(Is(c), +Z), Attach(Is(d), Is(e))))",
            "Union(Intersect(Attach(Is(a), Is(b)), Attach(Is(a), Is(c))), Attach(Is(d), Is(e)))",
        ),
    )
}
"""An extractor of each size; up to 6 nodes over three labels, then over five."""
_SIDE, _HULLS = 12, 40  # a cube of this side holds so many boxes; larger meshes are as dense


@cache
def boxes(count: int, hulls: int = _HULLS, labels: int = 8, seed: int = 0) -> tuple[SymbolicMesh, ...]:
    """So many meshes, their contacts known; a longer row begins with the shorter one."""
    return tuple(_mesh(np.random.default_rng([seed, k, hulls, labels]), hulls, LABELS[:labels]) for k in range(count))


def _mesh(draw: np.random.Generator, hulls: int, labels: Sequence[str]) -> SymbolicMesh:
    side = round(_SIDE * (hulls / _HULLS) ** (1 / 3))
    lows, sizes = draw.integers(0, side, (hulls, 3)), draw.integers(1, 4, (hulls, 3))
    names = draw.integers(0, len(labels), hulls)
    mesh = SymbolicMesh(
        tuple(
            Hull(f"h{k}", "body", Box.of_bounds(Aabb(low, low + sides)), Label(labels[name], 1.0, "file"))
            for k, (low, sides, name) in enumerate(zip(lows.astype(float), sizes.astype(float), names, strict=True))
        )
    )
    assert mesh.contacts is not None
    return mesh


def boxes_case(nodes: int, meshes: int, shown: int, hulls: int = _HULLS, labels: int = 8, seed: int = 0) -> Case:
    """An extractor of so many nodes, shown on the meshes where it selects most hulls: they tell most about it."""
    batch, hidden = boxes(meshes, hulls, labels, seed), SIZED[nodes]
    masks = tuple(select_mask(hidden, mesh) for mesh in batch)
    most = sorted(range(meshes), key=lambda k: (-masks[k].bit_count(), k))[:shown]
    return Case(f"boxes {nodes}", hidden, LABELS[:labels], batch, masks, tuple(sorted(most)))
