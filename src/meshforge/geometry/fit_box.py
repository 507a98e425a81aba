"""The smallest oriented box around points, the search that finds it, and the memo of fits."""

from __future__ import annotations

import itertools
from collections import OrderedDict
from collections.abc import Callable
from functools import wraps
from hashlib import blake2b
from typing import Protocol, TypeVar

import numpy as np

from meshforge.geometry.arrays import Floats
from meshforge.geometry.convex import convex_hull
from meshforge.geometry.pose import Pose, quaternions_of_rotations, rotations_of_quaternions
from meshforge.geometry.shape import Box, Polytope, Shape

_MOST_SIDES, _LEAST_SIDES = 48, 12  # faces and edges, the largest first, that a box is laid against
_SIDE_WORK = 5000  # these times the vertices; of more vertices, fewer sides
_STARTS = 24
_NO_BETTER = 1e-6  # a box that is smaller by less than this share is no better than an upright one

_DIRECTIONS_TRIED = 24  # directions tried from each start in a round
_ROUNDS = 120

AnyShape = TypeVar("AnyShape", bound=Shape, covariant=True)
_MEMO_SIZE = 4096  # fits, a few hundred bytes each


class FitFunction(Protocol[AnyShape]):
    """A function that fits a shape around points (n, 3); name: what messages call them."""

    def __call__(self, points: Floats, *, name: str = "points", thicken: float | None = None) -> AnyShape: ...


def memoize_fit(fit: Callable[..., AnyShape]) -> FitFunction[AnyShape]:
    """A fit that does the same points only once; failures are not remembered."""
    known: OrderedDict[tuple[bytes, float | None], AnyShape] = OrderedDict()

    @wraps(fit)
    def remembering(points: Floats, *, name: str = "points", thicken: float | None = None) -> AnyShape:
        key = blake2b(np.ascontiguousarray(points).data, digest_size=16).digest(), thicken
        fitted = known.pop(key, None) or fit(points, name=name, thicken=thicken)
        known[key] = fitted
        if len(known) > _MEMO_SIZE:
            known.popitem(last=False)
        return fitted

    return remembering


@memoize_fit
def tight_box(points: Floats, *, name: str = "points", thicken: float | None = None) -> Box:
    """The smallest box around points (n, 3), in any orientation; all points are inside to 1e-12 of its size.

    Boxes laid against a face and an edge of the hull, and the coordinate axes, are the starts of a descent. Measured on
    120 random hulls, each in six frames, its result was within 1% of the best known in 718 of 720, within 2% in all.
    Of its poses the one nearest to no turn is taken. Raises GeometryError as `convex_hull` does.
    """
    hull = convex_hull(points, name=name, thicken=thicken)
    middle = hull.vertices.mean(axis=0)
    corners = hull.vertices - middle
    size = float(np.abs(corners).max())
    rotation = _find_rotation(corners / size, hull)
    turned = (np.concatenate([points, hull.vertices]) - middle) @ rotation.T
    low, high = turned.min(axis=0), turned.max(axis=0)
    return Box(Pose(rotation.T, middle + rotation.T @ ((low + high) / 2)), (high - low) / 2)


def _find_rotation(corners: Floats, hull: Polytope) -> Floats:
    """The rows of (3, 3) are the axes of the box."""
    candidates = np.concatenate([np.eye(3)[None], _candidate_rotations(hull)])
    volumes = _box_volumes(corners, candidates)
    starts = candidates[np.argsort(volumes, kind="stable")[:_STARTS]]
    turn = descend(lambda q: _box_volumes(corners, rotations_of_quaternions(q)), quaternions_of_rotations(starts), 0.05)
    finalists = np.concatenate([starts[:1], rotations_of_quaternions(turn[None])])
    best = finalists[np.argmin(_box_volumes(corners, finalists) * [1 - _NO_BETTER, 1.0])]
    upright = np.eye(3)
    kept = volumes[0] <= _box_volumes(corners, best[None])[0] * (1 + _NO_BETTER)
    return upright if kept else _turn_least(best)


def _candidate_rotations(hull: Polytope) -> Floats:
    """The rotations (k, 3, 3) of boxes with one side on a face of the hull and another along an edge."""
    a, b, c = (hull.vertices[hull.faces[:, k]] for k in range(3))
    most = min(_MOST_SIDES, max(_LEAST_SIDES, _SIDE_WORK // len(hull.vertices)))
    normals, edges = _longest_directions(np.cross(b - a, c - a))[:most], _longest_directions(b - a)[:most]
    first = edges[None] - np.einsum("ik,jk->ij", normals, edges)[..., None] * normals[:, None]
    length = np.linalg.norm(first, axis=2)
    face, edge = np.nonzero(length > 1e-6)
    first = first[face, edge] / length[face, edge, None]
    return np.stack([first, np.cross(normals[face], first), normals[face]], axis=1)


def _longest_directions(vectors: Floats) -> Floats:
    """Unit vectors along the longest of some, each direction once, in either sense."""
    lengths = np.linalg.norm(vectors, axis=1)
    order = np.argsort(-lengths, kind="stable")
    units = vectors[order] / lengths[order, None]
    alike = np.abs(units @ units.T) > 1 - 1e-9
    first = ~np.tril(alike, -1).any(axis=1)
    distinct: Floats = units[first]
    return distinct


def _box_volumes(corners: Floats, rotations: Floats) -> Floats:
    """Volumes (k,) of the boxes around corners (n, 3) that are turned by rotations (k, 3, 3)."""
    volumes: Floats = np.prod(np.ptp(rotations @ corners.T, axis=2), axis=1)
    return volumes


def _turn_least(rotation: Floats) -> Floats:
    """The axes (3, 3) of a box in the order and the senses that turn least."""
    orders = [rotation[list(order)] * np.array(signs)[:, None] for order in itertools.permutations(range(3))
              for signs in itertools.product((1.0, -1.0), repeat=3)]  # fmt: skip
    proper = [axes for axes in orders if np.linalg.det(axes) > 0]
    return max(proper, key=lambda axes: round(float(np.trace(axes)), 9))


def descend(objective: Callable[[Floats], Floats], starts: Floats, step: float) -> Floats:
    """The arguments (d,) of the lowest value found from starts (k, d); the same for the same input.

    objective: values (m,) of arguments (m, d). Each round tries fixed scattered directions from every start; a step
    that helps grows, one that does not shrinks.
    """
    scatter = np.random.default_rng(0)
    points, values = starts.copy(), objective(starts)
    steps = np.full(len(points), step)
    each = np.arange(len(points))
    for _ in range(_ROUNDS):
        tried = points[:, None] + steps[:, None, None] * scatter.normal(size=(_DIRECTIONS_TRIED, points.shape[1]))
        found = objective(tried.reshape(-1, points.shape[1])).reshape(len(points), -1)
        best = np.argmin(found, axis=1)
        better = found[each, best] < values
        points = np.where(better[:, None], tried[each, best], points)
        values = np.where(better, found[each, best], values)
        steps = steps * np.where(better, 1.6, 0.6)
    lowest: Floats = points[int(np.argmin(values))]
    return lowest
