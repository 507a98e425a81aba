"""Points with a class each: those that were given, or points spread over faces by their area."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from meshforge.geometry import Floats, Ints

_COUNT = 50_000  # points spread over a mesh; every face gets one at least
_STEPS = np.array([0.7548776662466927, 0.5698402909980532])  # fill a square most evenly (Roberts 2018)


@dataclass(frozen=True, eq=False, slots=True)
class Samples:
    """points: (n, 3) [m]; classes: (n,), below zero for none; weights: (n,), what each stands for, an area."""

    points: Floats
    classes: Ints
    weights: Floats


def of_points(points: Floats, classes: Ints) -> Samples:
    """Points (n, 3) as they are."""
    return Samples(points, classes, np.ones(len(points)))


def of_faces(vertices: Floats, faces: Ints, classes: Ints, *, each: bool) -> Samples:
    """Points spread over faces (m, 3) by their area, each standing for an equal share of its face.

    classes: (m,) of the faces where `each`; else (n,) of the vertices (n, 3), of which the nearest corner counts.
    The same mesh gives the same points.
    """
    corners = vertices[faces]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    total = float(areas.sum())
    counts = np.maximum(np.ceil(areas / total * _COUNT), 1).astype(np.int64) if total > 0 else np.ones(len(faces), int)
    face = np.repeat(np.arange(len(faces)), counts)
    within = np.arange(len(face)) - np.repeat(np.cumsum(counts) - counts, counts)
    shares = _spread(within)
    points = np.einsum("nk,nkd->nd", shares, corners[face])
    own = classes[face] if each else classes[faces[face, shares.argmax(axis=1)]]
    return Samples(points, own, (areas / counts)[face])


def _spread(places: Ints) -> Floats:
    """The shares (n, 3) of the corners in the k-th of points that fill a triangle evenly, beginning at its middle."""
    share = (np.full(2, 1 / 3) + places[:, None] * _STEPS) % 1.0
    over = share.sum(axis=1) > 1.0
    share[over] = 1.0 - share[over]
    return np.column_stack([1.0 - share.sum(axis=1), share])
