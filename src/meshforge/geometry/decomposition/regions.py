"""Regions of a surface between its concave edges, each mostly of one part or of one side of a part; and the fine pieces
that are of each."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from meshforge.geometry import connectivity
from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.decomposition.creases import drop_degenerate, find_concave
from meshforge.geometry.shape import Polytope
from meshforge.geometry.surface import neighbour_faces, sample_surface

_POINTS, _OWN_POINTS = 20_000, 400  # that stand for the surface, and for that of a piece
_NEAR = 0.01  # of the surface's diagonal, within which a point of a piece lies on the surface


def find_regions(vertices: Floats, faces: Ints) -> Ints:
    """The number (m,) of the region of each of faces (m, 3) that have an area, of welded vertices (n, 3)."""
    pairs = neighbour_faces(faces)
    concave = find_concave(vertices[faces], pairs)
    return connectivity.component_roots(pairs[~concave, 0], pairs[~concave, 1], len(faces))


def group_by_region(pieces: Sequence[Polytope], vertices: Floats, faces: Ints) -> tuple[tuple[Polytope, ...], ...]:
    """Pieces by the region that has most of the surface at each, in the order in which regions first come."""
    from scipy.spatial import cKDTree  # lazy: 0.5 s, half of all imports

    faces = drop_degenerate(vertices, faces)
    regions = find_regions(vertices, faces)
    points, owner = sample_surface(vertices, faces, _POINTS)
    tree = cKDTree(points)
    near = _NEAR * float(np.linalg.norm(np.ptp(vertices, axis=0)))
    found = dict[int, list[Polytope]]()
    for piece in pieces:
        own, _ = sample_surface(piece.vertices, piece.faces, _OWN_POINTS)
        distances, places = map(np.asarray, tree.query(own))
        close = distances <= max(near, float(distances.min()))
        found.setdefault(int(np.bincount(regions[owner[places[close]]]).argmax()), []).append(piece)
    return tuple(map(tuple, found.values()))
