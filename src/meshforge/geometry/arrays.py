"""Array types, write protection for the arrays kept in frozen classes, and arithmetic on rows of points."""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]
Bools = npt.NDArray[np.bool_]
Number = TypeVar("Number", np.float64, np.int64)

_TINY = 1e-300


def freeze_floats(values: Any, shape: tuple[int, ...]) -> Floats:
    """A write-protected float64 copy of `values`; -1 in `shape` stands for any length.

    Raises: ValueError where the shape does not fit.
    """
    return _freeze(np.array(values, dtype=np.float64, order="C"), shape)


def freeze_ints(values: Any, shape: tuple[int, ...]) -> Ints:
    """A write-protected int64 copy of `values`, as `freeze_floats` makes one."""
    return _freeze(np.array(values, dtype=np.int64, order="C"), shape)


def _freeze(array: npt.NDArray[Number], shape: tuple[int, ...]) -> npt.NDArray[Number]:
    if array.size == 0 and -1 in shape:
        array = array.reshape([0 if n == -1 else n for n in shape])
    if len(array.shape) != len(shape) or not all(w in (-1, a) for a, w in zip(array.shape, shape, strict=True)):
        raise ValueError(f"an array of shape {shape} was expected, not {array.shape}")
    array.setflags(write=False)
    return array


def cross(a: Floats, b: Floats) -> Floats:
    """The cross products of rows (n, 3) and (n, 3); for few rows five times as fast as numpy's own, and the same."""
    out = np.empty((len(a), 3))
    for k, (i, j) in enumerate(((1, 2), (2, 0), (0, 1))):
        out[:, k] = a[:, i] * b[:, j] - a[:, j] * b[:, i]
    return out


def nearest_on_triangles(points: Floats, corners: Floats) -> Floats:
    """The point (n, 3) of each triangle, corners (n, 3, 3), that is nearest to a point (n, 3) each.

    Triangles may be needles or points.
    """
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    ab, ac, ap = b - a, c - a, points - a
    d1, d2, d3 = _dot(ab, ab), _dot(ab, ac), _dot(ac, ac)
    e1, e2 = _dot(ab, ap), _dot(ac, ap)
    area = d1 * d3 - d2 * d2
    safe = np.where(area > _TINY, area, 1.0)
    v, w = (d3 * e1 - d2 * e2) / safe, (d1 * e2 - d2 * e1) / safe
    inside = (area > _TINY) & (v >= 0) & (w >= 0) & (v + w <= 1)
    found = a + v[:, None] * ab + w[:, None] * ac
    if not inside.all():
        out = np.flatnonzero(~inside)
        found[out] = _nearest_on_edges(points[out], corners[out])
    return found


def _nearest_on_edges(points: Floats, corners: Floats) -> Floats:
    """The nearest point (n, 3) on the outline of each triangle."""
    start, along = corners, corners[:, [1, 2, 0]] - corners
    ahead = np.einsum("ikj,ikj->ik", points[:, None] - start, along)
    length = np.einsum("ikj,ikj->ik", along, along)
    share = np.clip(ahead / np.maximum(length, _TINY), 0.0, 1.0)
    places = start + share[..., None] * along
    gaps = np.einsum("ikj,ikj->ik", places - points[:, None], places - points[:, None])
    best: Floats = places[np.arange(len(points)), gaps.argmin(axis=1)]
    return best


def _dot(a: Floats, b: Floats) -> Floats:
    out: Floats = np.einsum("ij,ij->i", a, b)
    return out
