"""Labels of hulls from segmented points or faces, put to the vote."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from meshforge.formats import PointSamples
from meshforge.geometry import Aabb, Floats, Ints, Shape

_HELD = 0.005  # of the diagonal: a point on the surface of what was decomposed is held though it sticks out so far
_NEAR = 0.02  # of the diagonal: how far from a hull that holds none points may be and still say something
_SURE_OF_NEAR = 0.4
_DOUBT = 2.0  # points of other classes that might have been there
_DIGITS = 3
_EQUAL = 1e-9  # shares that differ by less are the same, in whatever order they were summed
_BLOCK = 1 << 22  # distances of points to planes at once, to bound their memory
_ROUNDED = 6  # digits by which planes of one flat side are told to be the same


@dataclass(frozen=True, slots=True)
class HullVote:
    """kind: the class; confidence: its share, less where few points say so; points: how many there are of any class."""

    kind: int
    confidence: float
    points: int


@dataclass(frozen=True, eq=False, slots=True)
class HullVotes:
    """What points say: of each hull, None where there are none near it; held: the share of points that hulls hold."""

    of_hulls: tuple[HullVote | None, ...]
    held: float


def vote_by_points(hulls: Sequence[Shape], samples: PointSamples) -> HullVotes:
    """The class of each hull by the points in it, else by those near it, which is much less sure.

    Points without a class count as a class of their own, below zero. Of classes with as many points the lowest counts.
    The order of the points does not matter.
    """
    diagonal = Aabb.union(hull.aabb for hull in hulls).diagonal if hulls else 0.0
    longest = int(np.ptp(samples.points, axis=0).argmax()) if len(samples.points) else 0
    order = np.argsort(samples.points[:, longest], kind="stable")
    sorted_ = PointSamples(samples.points[order], samples.classes[order], samples.weights[order])
    found, held = [], np.zeros(len(order), dtype=bool)
    for hull in hulls:
        near, gaps = _find_near_points(hull, sorted_.points, longest, _NEAR * diagonal)
        held[near] = True
        within = near[gaps <= _HELD * diagonal]
        found.append(_find_majority(sorted_, within, 1.0) or _find_majority(sorted_, near, _SURE_OF_NEAR))
    weight = float(sorted_.weights.sum())
    return HullVotes(tuple(found), float(sorted_.weights[held].sum()) / weight if weight > 0 else 0.0)


def _find_majority(samples: PointSamples, within: Ints, trust: float) -> HullVote | None:
    kinds, places = np.unique(samples.classes[within], return_inverse=True)
    weights = np.bincount(places.reshape(-1), samples.weights[within])
    if not len(kinds) or not weights.sum() > 0:
        return None
    shares = weights / weights.sum()
    best = int(np.flatnonzero(shares >= shares.max() - _EQUAL)[0])
    sure = trust * float(shares[best]) * len(within) / (len(within) + _DOUBT)
    return HullVote(int(kinds[best]), round(sure, _DIGITS), len(within))


def _find_near_points(hull: Shape, points: Floats, axis: int, reach: float) -> tuple[Ints, Floats]:
    """The places (k,) of points (n, 3), sorted along an axis, within reach of a hull, and how far outside each is [m]:
    below zero within, at edges and corners of the hull somewhat less."""
    low, high = hull.aabb.min - reach, hull.aabb.max + reach
    start, stop = np.searchsorted(points[:, axis], [low[axis], high[axis]]).tolist()
    part = points[start:stop]
    near: Ints = start + np.flatnonzero(((part >= low) & (part <= high)).all(axis=1))
    gaps = np.full(len(near), -np.inf)
    normals, offsets = _planes_of(hull)
    while len(normals) and len(near):
        some = max(1, _BLOCK // len(near))
        gaps = np.maximum(gaps, (points[near] @ normals[:some].T - offsets[:some]).max(axis=1))
        near, gaps = near[gaps <= reach], gaps[gaps <= reach]
        normals, offsets = normals[some:], offsets[some:]
    return near, gaps


def _planes_of(hull: Shape) -> tuple[Floats, Floats]:
    """The outward planes that a hull lies between, normals (k, 3) and offsets (k,); round ones lie within theirs."""
    corners = hull.vertices[hull.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    normals = normals[lengths > 0] / lengths[lengths > 0, None]
    _, first = np.unique(normals.round(_ROUNDED), axis=0, return_index=True)
    normals = normals[first]
    if hull.is_primitive:
        return normals, np.array([float(hull.support(normal) @ normal) for normal in normals])
    return normals, (hull.vertices @ normals.T).max(axis=0)
