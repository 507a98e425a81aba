"""Labels of hulls from segmented points or faces: aligned with the asset, sampled, and put to the vote."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry import Aabb, Floats, Ints, Shape

AlignMode = Literal["check", "box", "off"]
Up = Literal["y", "z"]
_TO_Z = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])  # points as rows, Y up, to those with Z up
_TRIED_MODES: tuple[AlignMode, ...] = ("check", "box")
_AXES: tuple[Up | None, ...] = (None, "y", "z")
_SLACK = 0.05  # of the diagonal of an asset: how far its box and that of its points may be apart at any side

_COUNT = 50_000  # points spread over a mesh; every face gets one at least
_STEPS = np.array([0.7548776662466927, 0.5698402909980532])  # fill a square most evenly (Roberts 2018)

_HELD = 0.005  # of the diagonal: a point on the surface of what was decomposed is held though it sticks out so far
_NEAR = 0.02  # of the diagonal: how far from a hull that holds none points may be and still say something
_SURE_OF_NEAR = 0.4
_DOUBT = 2.0  # points of other classes that might have been there
_DIGITS = 3
_EQUAL = 1e-9  # shares that differ by less are the same, in whatever order they were summed
_BLOCK = 1 << 22  # distances of points to planes at once, to bound their memory
_ROUNDED = 6  # digits by which planes of one flat side are told to be the same


@dataclass(frozen=True, slots=True)
class PointAlignment:
    """How points come into the frame of an asset. align: as they are if they fit (`check`), scaled evenly and moved so
    that the boxes fit (`box`), or as they are in any case (`off`); up: the axis that points up among the points, None
    where that is the asset's."""

    align: AlignMode = "check"
    up: Up | None = None


def align_points(points: Floats, boxes: Sequence[Aabb], placing: PointAlignment, up: Up | None = None) -> Floats:
    """Points (n, 3) in the frame of an asset; boxes: of its hulls, and of what it shows; up: the axis that its format
    says points up, None where it says none: then it is the other one than that of the points.

    Raises GeometryError where the box of the points fits none of them, with what would make it fit.
    """
    own = _move(points, boxes, placing, up)
    if placing.align == "off" or _box_distance(own, boxes) <= _SLACK:
        return own
    ways = (PointAlignment(align, axis) for align in _TRIED_MODES for axis in _AXES)
    apart = {way: _box_distance(_move(points, boxes, way, up), boxes) for way in ways}
    best = min(apart, key=lambda way: apart[way])
    raise GeometryError(
        f"its points do not lie where the asset does: they are in a box {_describe_box(Aabb.of_points(own))}, "
        f"the hulls in a box {_describe_box(boxes[0])}",
        remedy=f"They would fit with {_describe_options(best)}."
        if apart[best] <= _SLACK
        else "Export them in the frame of the asset, in metres.",
    )


def _move(points: Floats, boxes: Sequence[Aabb], placing: PointAlignment, up: Up | None) -> Floats:
    turn = np.eye(3) if placing.up in (None, up) else _TO_Z if placing.up == "y" else _TO_Z.T
    turned = points @ turn
    if placing.align != "box":
        return turned
    return min([_fit_box(turned, box) for box in boxes], key=lambda own: _box_distance(own, boxes))


def _fit_box(points: Floats, box: Aabb) -> Floats:
    """Points scaled evenly and moved so that their box has the diagonal and the middle of another."""
    own = Aabb.of_points(points)
    scale = box.diagonal / own.diagonal if own.diagonal > 0 else 1.0
    return (points - own.center) * scale + box.center


def _box_distance(points: Floats, boxes: Sequence[Aabb]) -> float:
    """How far the box of points is from the nearest of some, as a share of its diagonal."""
    own = Aabb.of_points(points)
    return min(
        float(max(np.abs(own.min - box.min).max(), np.abs(own.max - box.max).max())) / box.diagonal for box in boxes
    )


def _describe_box(box: Aabb) -> str:
    size, middle = (" ".join(f"{x:.3g}" for x in values) for values in (box.size, box.center))
    return f"of {size} m around {middle}"


def _describe_options(placing: PointAlignment) -> str:
    given = [f"--points-up {placing.up}"] if placing.up else []
    given += [f"--align {placing.align}"] if placing.align == "box" else []
    return " ".join(given) or "neither --align nor --points-up"


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
