"""Points with classes: segmented ones as they are, or spread over segmented faces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from meshforge.geometry import Floats, Ints

_COUNT = 50_000  # points spread over a mesh; every face gets one at least
_STEPS = np.array([0.7548776662466927, 0.5698402909980532])  # fill a square most evenly (Roberts 2018)


@dataclass(frozen=True, eq=False, slots=True)
class PointSamples:
    """points: (n, 3) [m]; classes: (n,), below zero for none; weights: (n,), what each stands for, an area."""

    points: Floats
    classes: Ints
    weights: Floats


def samples_of_points(points: Floats, classes: Ints) -> PointSamples:
    """Points (n, 3) as they are."""
    return PointSamples(points, classes, np.ones(len(points)))


def samples_of_faces(vertices: Floats, faces: Ints, classes: Ints, *, each: bool) -> PointSamples:
    """Points spread over faces (m, 3) by their area, each standing for an equal share of its face.

    classes: (m,) of the faces where `each`; else (n,) of the vertices (n, 3), of which the nearest corner counts.
    The same mesh gives the same points.
    """
    corners = vertices[faces]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    total = float(areas.sum())
    counts = np.maximum(np.ceil(areas / total * _COUNT), 1).astype(np.int64) if total > 0 else np.ones(len(faces), int)
    face = np.repeat(np.arange(len(faces)), counts)
    shares = _corner_shares(np.arange(len(face)) - np.repeat(np.cumsum(counts) - counts, counts))
    points = np.einsum("nk,nkd->nd", shares, corners[face])
    own = classes[face] if each else classes[faces[face, shares.argmax(axis=1)]]
    return PointSamples(points, own, (areas / counts)[face])


def _corner_shares(places: Ints) -> Floats:
    """The shares (n, 3) of the corners in the k-th of points that fill a triangle evenly, beginning at its middle."""
    share = (np.full(2, 1 / 3) + places[:, None] * _STEPS) % 1.0
    over = share.sum(axis=1) > 1.0
    share[over] = 1.0 - share[over]
    return np.column_stack([1.0 - share.sum(axis=1), share])
