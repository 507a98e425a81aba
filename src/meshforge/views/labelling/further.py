"""Pictures of hulls that are not seen well where they are: drawn close, alone, or with all hulls pushed apart."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from meshforge.geometry import Aabb, Floats
from meshforge.views.camera import View
from meshforge.views.labelling.arrangement import Arrangement
from meshforge.views.labelling.sights import LIKED
from meshforge.views.labelling.sitter import Sitter

_PUSH = 1.2  # how far hulls are drawn apart
_NEAR = 0.12  # hulls this near each other, as a share of the diagonal, can share a picture from close up
_ROOM = 1.2  # how much is seen about hulls from close up, as a share of their size
_CLOSE = 0.6  # a picture is from close up if it holds at most this share of the whole
_FEW, _MOVED = 0.85, 0.81  # what a picture of some hulls only, or of moved ones, is worth beside one of all in place


def arrangements(sitter: Sitter, left: Sequence[int]) -> Iterator[tuple[Arrangement, float]]:
    """Ways to show hulls that are left, and how much each is liked."""
    group = tuple(_together(sitter, left))
    near = _about(sitter, group)
    every = tuple(range(len(sitter.render_meshes)))
    if near is not None:
        yield Arrangement(sitter, every, near, close=group), 1.0
        yield Arrangement(sitter, group, near, close=group), _FEW
    if near is None or len(group) < len(left):
        yield Arrangement(sitter, tuple(left), sitter.points), _FEW
    if len(every) > 1:
        yield Arrangement.explode(sitter, _PUSH), _MOVED


def alone(sitter: Sitter, hull: int) -> Arrangement:
    """One hull, as large as a picture can hold it."""
    frame = sitter.points_of([hull])
    small = Aabb.of_points(frame).diagonal < _CLOSE * sitter.diagonal
    return Arrangement(sitter, (hull,), frame, close=(hull,) if small else ())


def best(
    choices: Sequence[tuple[Arrangement, float]], left: Sequence[int], least: float, shape: float
) -> tuple[Arrangement, View]:
    """The arrangement, and the sight of it, that shows hulls best that are left."""
    values: list[tuple[float, int, View]] = []
    for k, (arrangement, liked) in enumerate(choices):
        for view in LIKED:
            quality = arrangement.preview(view, shape).quality(least)[list(left)]
            value = (quality > 0).sum() + quality.sum()  # that a hull is seen at all is half of what there is to gain
            values.append((float(value) * liked * LIKED[view], k, view))
    _, k, view = max(values, key=lambda row: row[0])
    return choices[k][0], view


def _together(sitter: Sitter, left: Sequence[int]) -> list[int]:
    """Those of some hulls that are near the first, or near one that is."""
    low, high = (corner[list(left)] for corner in sitter.mesh.corners)
    found = np.zeros(len(left), bool)
    fresh = found.copy()
    fresh[0] = True
    while fresh.any():
        found |= fresh
        gaps = np.maximum(low[:, None] - high[None, found], low[None, found] - high[:, None]).max(axis=2)
        fresh = ~found & (gaps.min(axis=1) < _NEAR * sitter.diagonal)
    return [k for k, one in zip(left, found, strict=True) if one]


def _about(sitter: Sitter, hulls: Sequence[int]) -> Floats | None:
    """The corners (8, 3) of what is seen of hulls and about them from close up; None if that is nearly all."""
    box = Aabb.of_points(sitter.points_of(hulls))
    room = _ROOM * box.diagonal / 2
    whole = Aabb.of_points(sitter.points)
    seen = Aabb(np.maximum(box.min - room, whole.min), np.minimum(box.max + room, whole.max))
    return seen.corners if 0 < seen.diagonal < _CLOSE * whole.diagonal else None
