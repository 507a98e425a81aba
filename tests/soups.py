"""Small surfaces for tests: boxes and what is done to them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from meshforge.geometry import Floats, Ints, Polytope, Shape, convex_hull

Soup = tuple[Floats, Ints]

CORNERS = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
QUADS = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
TRIANGLES = np.array([t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))], dtype=np.int64)


def box(low: Sequence[float] = (0, 0, 0), size: Sequence[float] = (1, 1, 1)) -> Soup:
    """A closed box from its low corner, wound outwards: 8 vertices, 12 triangles, two a side in a row."""
    return np.asarray(low, dtype=float) + CORNERS * np.asarray(size, dtype=float), TRIANGLES.copy()


def together(*soups: Soup) -> Soup:
    """Soups as one, vertices of each their own."""
    starts = np.cumsum([0, *(len(v) for v, _ in soups)])
    faces = [f + start for (_, f), start in zip(soups, starts, strict=False)]
    return np.concatenate([v for v, _ in soups]), np.concatenate(faces)


def merge_solids(solids: Iterable[Shape]) -> Soup:
    """The surfaces of solids as one."""
    return together(*((solid.vertices, solid.faces) for solid in solids))


def ball(vertices: int, radius: float = 1.0) -> Polytope:
    """The hull of so many points at random on a sphere."""
    points = np.random.default_rng(0).normal(size=(vertices, 3))
    return convex_hull(radius * points / np.linalg.norm(points, axis=1, keepdims=True))


def unindexed(soup: Soup) -> Soup:
    """The same triangles, each with corners of its own, as an STL has them."""
    vertices, faces = soup
    return vertices[faces].reshape(-1, 3), np.arange(faces.size).reshape(-1, 3)


def welded(soup: Soup) -> Soup:
    """The same triangles with one vertex for each place."""
    vertices, faces = soup
    places, number = np.unique(vertices, axis=0, return_inverse=True)
    return places, number.reshape(-1)[faces]


def turned(soup: Soup) -> Soup:
    """The same triangles wound the other way."""
    return soup[0], soup[1][:, ::-1].copy()


def angle() -> Soup:
    """A closed prism over an L, wound outwards: connected, not convex."""
    outline = [(1, 1), (1, 3), (0, 3), (0, 0), (3, 0), (3, 1)]
    vertices = np.array([(x, y, z) for z in (0, 1) for x, y in outline], dtype=float)
    caps = [(0, k + 1, k) for k in range(1, 5)] + [(6, k + 6, k + 7) for k in range(1, 5)]
    sides = [side for k in range(6) for n in [(k + 1) % 6] for side in ((k, n, n + 6), (k, n + 6, k + 6))]
    return vertices, np.array(caps + sides, dtype=np.int64)
