"""Convex hulls by name as arrays, and back: how they are kept in a file of arrays."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from meshforge.geometry import Floats, Ints, Polytope
from meshforge.labels.descriptor_cache import Arrays

HULL_ARRAYS = ("names", "sizes", "vertices", "faces")
"""The arrays that `pack_hulls` makes, in the order in which `unpack_hulls` takes them."""


def pack_hulls(hulls: Mapping[str, Sequence[Polytope]]) -> Arrays:
    """Names (n,) of n hulls, sizes (n, 2), how many vertices and faces each has, and all vertices and faces (_, 3)."""
    rows = [(name, hull) for name, own in hulls.items() for hull in own]
    return {
        "names": np.array([name for name, _ in rows], dtype=np.str_),
        "sizes": np.array([(len(h.vertices), len(h.faces)) for _, h in rows], dtype=np.int64).reshape(-1, 2),
        "vertices": np.concatenate([np.zeros((0, 3)), *(hull.vertices for _, hull in rows)]),
        "faces": np.concatenate([np.zeros((0, 3), np.int64), *(hull.faces for _, hull in rows)]),
    }


def unpack_hulls(names: Iterable[str], sizes: Floats, vertices: Floats, faces: Ints) -> dict[str, list[Polytope]]:
    """The hulls by name that `pack_hulls` made arrays of."""
    found = dict[str, list[Polytope]]()
    points = triangles = 0
    for name, (count, sides) in zip(names, np.asarray(sizes, dtype=np.int64).tolist(), strict=True):
        hull = Polytope(vertices[points : points + count], faces[triangles : triangles + sides])
        found.setdefault(str(name), []).append(hull)
        points, triangles = points + count, triangles + sides
    return found
