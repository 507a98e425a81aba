"""Large inputs: hulls of many points, pieces of many triangles."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from benchmark.clock import in_turns, medians
from benchmark.report import Result, Table, Tell
from meshforge.geometry import Floats, Ints, convex_hull, split_pieces

_ROUNDS = 3


def measure(tell: Tell, quick: bool) -> Result:
    """Time hulls against bare Qhull, which verifies nothing, and pieces."""
    size = 400 if quick else 40_000
    clouds = {
        f"{size} points on a ball": ball(size),
        f"{size} points in a cloud": np.random.default_rng(1).normal(size=(size, 3)),
        f"{size} points of a torus": torus(size)[0],
    }
    hulls, parts = [], []
    for name, points in clouds.items():
        tell(f"hulls: {name}")
        seconds = medians(
            in_turns({"ours": _run(partial(convex_hull, points)), "qhull": _run(partial(_qhull, points))}, _ROUNDS)
        )
        corners, ratio = len(convex_hull(points).vertices), seconds["ours"] / seconds["qhull"]
        hulls.append((name, corners, seconds["ours"], seconds["qhull"], ratio))
    many = size * 5 // 2
    for name, (vertices, faces) in {
        "a torus": torus(many // 2),
        "the same, no vertex shared": _soup(*torus(many // 2)),
    }.items():
        tell(f"pieces: {name}")
        work = partial(split_pieces, vertices, faces, name=name)
        parts.append((name, len(faces), medians(in_turns({"ours": _run(work)}, _ROUNDS))["ours"]))
    return Result(
        "geometry",
        "Large inputs",
        (
            Table("Convex hulls, s", ("", "corners", "MeshForge, verified", "Qhull (scipy)", "ratio"), tuple(hulls)),
            Table("Pieces of a surface, s", ("", "triangles", "MeshForge"), tuple(parts)),
        ),
    )


def ball(count: int) -> Floats:
    """Points (count, 3) on a sphere, in no order."""
    points = np.random.default_rng(0).normal(size=(count, 3))
    return np.asarray(points / np.linalg.norm(points, axis=1)[:, None])


def torus(count: int) -> tuple[Floats, Ints]:
    """Vertices of a torus, about so many, and its triangles, twice as many."""
    rows = max(3, int(np.sqrt(count)))
    around, along = np.meshgrid(*[np.arange(rows) * (2 * np.pi / rows)] * 2, indexing="ij")
    radius = 1 + 0.3 * np.cos(along)
    vertices = np.stack([radius * np.cos(around), radius * np.sin(around), 0.3 * np.sin(along)], axis=-1).reshape(-1, 3)
    at = np.arange(rows * rows).reshape(rows, rows)
    right, up = np.roll(at, -1, axis=0), np.roll(at, -1, axis=1)
    across = np.roll(right, -1, axis=1)
    faces = np.concatenate([np.stack([at, right, across], -1), np.stack([at, across, up], -1)]).reshape(-1, 3)
    return vertices, faces


def _soup(vertices: Floats, faces: Ints) -> tuple[Floats, Ints]:
    return vertices[faces].reshape(-1, 3), np.arange(faces.size).reshape(-1, 3)


def _qhull(points: Floats) -> object:
    from scipy.spatial import ConvexHull

    return ConvexHull(points)


def _run(work: Callable[[], object]) -> Callable[[], Callable[[], object]]:
    return lambda: work
