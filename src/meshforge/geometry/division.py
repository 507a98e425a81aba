"""A convex shape divided by planes, so that each part holds one kind of what lies in it: a decision tree over the
volumes that finer pieces have in it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry.arrays import Bools, Floats, Ints
from meshforge.geometry.convex import FLATNESS, convex_hull, spans_volume
from meshforge.geometry.shape import Polytope, Shape
from meshforge.geometry.solids import cut, intersect
from meshforge.geometry.surface import planes_of

_POINTS = 1500  # that stand for what lies in a shape
_LEAST_POINTS = 4  # of each piece
_LEAST = 0.01  # of the shape's volume: a smaller part is a sliver, and stays with its neighbour
_PURE = 0.98  # of what lies in a part that is of one kind: it is not divided
_GAIN = 0.002  # of what lies in the shape that a plane must set right
_NOTHING = 1e-9  # of what lies in a part: rounding
_ALL = 0.85  # of a piece that a part has, from which it has all of it
_PARTS = 16  # at most
_SAME = 1e-3  # planes whose normals and offsets (of the diagonal) differ by less are one


@dataclass(frozen=True, eq=False, slots=True)
class HullPart:
    """One part. shape: convex; shares: (kinds,) of what lies in it, zeros where nothing does."""

    shape: Polytope
    shares: Floats

    @property
    def kind(self) -> int:
        """The place of the kind that it holds most of."""
        return int(self.shares.argmax())


@dataclass(frozen=True, eq=False, slots=True)
class _Contents:
    """What lies in a shape, as points (n, 3) [m]; weights (n,) [m^3], kinds (n, k) their probabilities."""

    points: Floats
    weights: Floats
    kinds: Floats

    def take(self, chosen: Bools) -> _Contents:
        return _Contents(self.points[chosen], self.weights[chosen], self.kinds[chosen])

    @property
    def volumes(self) -> Floats:
        """The volume of each kind (k,) [m^3]."""
        found: Floats = self.weights @ self.kinds
        return found


def divide(shape: Shape, pieces: Sequence[Polytope], chances: Floats) -> tuple[HullPart, ...]:
    """The convex parts of a shape, each drawn tight around what lies in it; the shape alone where no plane sets kinds
    apart. Parts lie within the shape, to rounding, and hold all that it has of the pieces.

    pieces: convex, of what the shape stands for; chances: (pieces, kinds) the probability of each kind for each.
    """
    whole = shape.tessellate()
    commons = [(part, row) for piece, row in zip(pieces, chances, strict=True) if (part := intersect(whole, piece))]
    nothing = np.zeros(chances.shape[1])
    if not commons:
        return (HullPart(whole, nothing),)
    volumes = np.array([part.volume for part, _ in commons])
    counts = np.maximum(np.rint(_POINTS * volumes / volumes.sum()).astype(int), _LEAST_POINTS)
    held = _Contents(
        np.concatenate([sample_volume(part, count) for (part, _), count in zip(commons, counts, strict=True)]),
        np.repeat(volumes / counts, counts),
        np.repeat(np.array([row for _, row in commons]), counts, axis=0),
    )
    planes = _list_planes([part for part, _ in commons], whole)
    found = [(whole, held)]
    while len(found) < _PARTS:
        splits = [
            (gain, place, halves)
            for place, (part, own) in enumerate(found)
            if (best := _split(part, own, planes, held, whole.volume))
            for gain, halves in [best]
        ]
        if not splits:
            break
        _, place, halves = max(splits, key=lambda row: (row[0], -row[1]))
        found[place : place + 1] = halves
    if len(found) == 1:
        return (HullPart(whole, _to_shares(held.volumes)),)
    tight = _tighten([part for part, _ in found], [part for part, _ in commons], whole)
    return tuple(HullPart(part, _to_shares(own.volumes)) for part, (_, own) in zip(tight, found, strict=True))


def _tighten(parts: Sequence[Polytope], solids: Sequence[Polytope], whole: Polytope) -> list[Polytope]:
    """The convex hull of what solids have in each part; a solid that a part has nearly all of is all of that part."""
    inside = [[intersect(part, solid) for part in parts] for solid in solids]
    corners: list[list[Floats]] = [[np.zeros((0, 3))] for _ in parts]
    for solid, commons in zip(solids, inside, strict=True):
        volumes = [common.volume if common else 0.0 for common in commons]
        most = int(np.argmax(volumes))
        if volumes[most] >= _ALL * sum(volumes):
            corners[most].append(solid.vertices)
        else:
            for own, common in zip(corners, commons, strict=True):
                own += [common.vertices] if common else []
    points = [np.concatenate(rows) for rows in corners]
    thickness = FLATNESS * whole.aabb.diagonal
    return [
        convex_hull(own, name="a part of a hull", thicken=thickness) if len(own) > 3 and spans_volume(own) else part
        for part, own in zip(parts, points, strict=True)
    ]


def _to_shares(volumes: Floats) -> Floats:
    return volumes / max(float(volumes.sum()), np.finfo(float).tiny)


def sample_volume(shape: Polytope, count: int) -> Floats:
    """Points (count, 3) [m] that lie evenly in a convex shape, the same every time."""
    corners = shape.vertices[shape.faces]
    middle = shape.vertices.mean(axis=0)
    beyond = np.cross(corners[:, 1] - middle, corners[:, 2] - middle)
    sizes = np.abs(np.einsum("ij,ij->i", corners[:, 0] - middle, beyond))
    ends = np.cumsum(sizes)
    chosen = np.minimum(np.searchsorted(ends, (np.arange(count) + 0.5) / count * ends[-1]), len(ends) - 1)
    share = np.random.default_rng(0).exponential(size=(count, 4))
    share /= share.sum(axis=1, keepdims=True)
    points: Floats = np.einsum("ij,ijk->ik", share[:, :3], corners[chosen]) + share[:, 3:] * middle
    return points


_Halves = tuple[tuple[Polytope, _Contents], tuple[Polytope, _Contents]]


def _split(
    part: Polytope, own: _Contents, planes: tuple[Floats, Floats], all_held: _Contents, volume: float
) -> tuple[float, _Halves] | None:
    """How much the best plane through a part sets right [m^3], and its halves; None where none sets enough right."""
    volumes = own.volumes
    if not len(own.weights) or volumes.max() >= _PURE * volumes.sum():
        return None
    wrong = float(volumes.sum() - volumes.max())
    normals, offsets = _add_own_planes(own, planes)
    order, gains = _rank_planes(own, normals, offsets)
    for place in order[:6].tolist():
        if gains[place] < _GAIN * float(all_held.weights.sum()) or wrong <= 0:
            break
        try:
            below, above = cut(part, normals[place] * offsets[place], normals[place])
        except GeometryError:
            continue
        if below and above and min(below.volume, above.volume) >= _LEAST * volume:
            lower = own.points @ normals[place] < offsets[place]
            return float(gains[place]), ((below, own.take(lower)), (above, own.take(~lower)))
    return None


def _rank_planes(own: _Contents, normals: Floats, offsets: Floats) -> tuple[Ints, Floats]:
    """Planes from the best on, and by how much each lowers the Gini impurity times volume."""
    lower = (own.points @ normals.T < offsets).T.astype(np.float64)
    held = own.weights[:, None] * own.kinds
    below = lower @ held
    total = held.sum(axis=0)
    above = np.maximum(total - below, 0.0)
    gains = _purity(below) + _purity(above) - _purity(total[None])[0]
    gains[np.minimum(below.sum(axis=1), above.sum(axis=1)) <= _NOTHING * total.sum()] = 0.0
    return np.argsort(-gains.round(15), kind="stable"), gains


def _purity(volumes: Floats) -> Floats:
    """The sum over kinds of volume times share (n,) [m^3], of volumes (n, kinds)."""
    found: Floats = (volumes**2).sum(axis=1) / np.maximum(volumes.sum(axis=1), np.finfo(float).tiny)
    return found


def _list_planes(parts: Sequence[Polytope], whole: Polytope) -> tuple[Floats, Floats]:
    """The planes of the faces of parts, each once: unit normals (p, 3) and offsets (p,) [m]."""
    normals, offsets = list[Floats](), list[Floats]()
    for part in parts:
        planes = planes_of(part.vertices, part.faces)
        normals.append(planes.normals)
        offsets.append(planes.offsets + planes.normals @ planes.middle)
    n, d = np.concatenate(normals), np.concatenate(offsets)
    first = np.take_along_axis(n, np.abs(n).argmax(axis=1)[:, None], axis=1)[:, 0]
    n, d = n * np.sign(first)[:, None], d * np.sign(first)
    steps = np.column_stack([np.rint(n / _SAME), np.rint(d / (_SAME * whole.aabb.diagonal))])
    _, places = np.unique(steps, axis=0, return_index=True)
    return n[np.sort(places)], d[np.sort(places)]


def _add_own_planes(own: _Contents, planes: tuple[Floats, Floats]) -> tuple[Floats, Floats]:
    """Planes with those across the direction in which the kinds of points lie farthest apart."""
    extra = list(_find_directions(own))
    if not extra:
        return planes
    normals = np.concatenate([planes[0], *(np.tile(direction, (15, 1)) for direction in extra)])
    cuts = [np.quantile(own.points @ direction, np.linspace(0.05, 0.95, 15)) for direction in extra]
    return normals, np.concatenate([planes[1], *cuts])


def _find_directions(own: _Contents) -> Iterator[Floats]:
    """The direction between the two commonest kinds by linear discriminant analysis (Fisher 1936)."""
    held = own.weights[:, None] * own.kinds
    total = held.sum(axis=0)
    a, b = np.argsort(-total, kind="stable")[:2] if len(total) > 1 else (0, 0)
    if a == b or not total[b] > 0:
        return
    means = (held.T @ own.points) / np.maximum(total, np.finfo(float).tiny)[:, None]
    spread = np.zeros((3, 3))
    for kind in (a, b):
        away = own.points - means[kind]
        spread += (away * held[:, kind : kind + 1]).T @ away
    spread += np.eye(3) * max(float(np.trace(spread)), np.finfo(float).tiny) * 1e-6
    direction = np.linalg.solve(spread, means[b] - means[a])
    length = float(np.linalg.norm(direction))
    if length > 0 and np.isfinite(length):
        yield direction / length
