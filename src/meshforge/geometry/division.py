"""A convex shape divided by planes, so that each part holds one kind of what lies in it: a decision tree over the
volumes that finer pieces have in it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from meshforge.common import GeometryError
from meshforge.geometry.arrays import Bools, Floats, Ints
from meshforge.geometry.convex import FLATNESS, convex_hull, spans_volume
from meshforge.geometry.piece_groups import merge_pieces
from meshforge.geometry.shape import Polytope, Shape
from meshforge.geometry.solids import cut, intersect, volume_of_union
from meshforge.geometry.surface import planes_of

_POINTS = 1500  # that stand for what lies in a shape
_LEAST_POINTS = 4  # of each piece
_LEAST = 0.01  # of the shape's volume: a smaller part is a sliver, and stays with its neighbour
_PURE = 0.98  # of what lies in a part that is of one kind: it is not divided
_GAIN = 0.002  # of what lies in the shape that a plane must set right
_NOTHING = 1e-9  # of what lies in a part: rounding
_ALL = 0.85  # of a piece that a part has, from which it has all of it
_SLIVER = 0.02  # of what lies in the shape: so little of a piece does not make a part
_HOLLOW = 0.4  # of what lies in a part that it may hold of nothing beside
_BETTER = 0.3  # of that which two parts must leave out
_TRIES = 8  # places where solids are put in two groups, along each direction
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
    inside = _share_out([part for part, _ in found], [part for part, _ in commons])
    thickness = FLATNESS * whole.aabb.diagonal
    tight = [
        (shape, own.volumes)
        for (part, own), solids in zip(found, inside, strict=True)
        if solids
        for shape in (enclose_closely(solids, thickness) or [part])
    ]
    kinds = np.array([int(volumes.argmax()) for _, volumes in tight])
    joined = merge_pieces([shape for shape, _ in tight], kinds, _LEAST * whole.volume)
    return tuple(
        HullPart(one.shape, _to_shares(np.sum([tight[place][1] for place in one.members], axis=0))) for one in joined
    )


def _share_out(parts: Sequence[Polytope], solids: Sequence[Polytope]) -> list[list[Polytope]]:
    """What each part has of solids: all of one that it has nearly all of, and slivers that others have of one that it
    has most of."""
    sliver = _SLIVER * sum(solid.volume for solid in solids)
    found: list[list[Polytope]] = [[] for _ in parts]
    for solid in solids:
        commons = [intersect(part, solid) for part in parts]
        volumes = np.array([common.volume if common else 0.0 for common in commons])
        most = int(np.argmax(volumes))
        large = np.flatnonzero(volumes > sliver).tolist()
        if volumes[most] >= _ALL * volumes.sum() or len(large) < 2:
            found[most].append(solid)
            continue
        for place, common in enumerate(commons):
            if common:
                found[place if place in large else most].append(common)
    return found


def enclose_closely(solids: Sequence[Polytope], thickness: float) -> list[Polytope]:
    """Few convex hulls around solids: where one would hold much of nothing, two that leave it out, and so on.

    Solids are not cut. thickness: [m] of what is flat. Nothing where they span no volume.
    """
    points = np.concatenate([np.zeros((0, 3)), *(solid.vertices for solid in solids)])
    if len(points) < 4 or not spans_volume(points):
        return []
    hull = convex_hull(points, name="a part of a hull", thicken=thickness)
    filled = volume_of_union(solids)
    if len(solids) < 2 or hull.volume - filled <= _HOLLOW * filled:
        return [hull]
    least, halves = min(_list_halves(solids, thickness), key=lambda row: row[0])
    if hull.volume - least <= _BETTER * (hull.volume - filled):
        return [hull]
    return [tight for half in halves for tight in enclose_closely(half, thickness)]


def _list_halves(
    solids: Sequence[Polytope], thickness: float
) -> Iterator[tuple[float, tuple[list[Polytope], list[Polytope]]]]:
    """Solids in two groups, beside each other along some direction, and the volume of both convex hulls [m^3]."""
    middles = np.array([solid.vertices.mean(axis=0) for solid in solids])
    _, _, axes = np.linalg.svd(middles - middles.mean(axis=0), full_matrices=False)
    for axis in [*np.eye(3), *axes]:
        order = np.argsort((middles @ axis).round(12), kind="stable")
        for end in sorted({*np.linspace(1, len(order) - 1, _TRIES).round().astype(int).tolist()}):
            halves = [solids[k] for k in order[:end]], [solids[k] for k in order[end:]]
            clouds = [np.concatenate([solid.vertices for solid in half]) for half in halves]
            hulls = [convex_hull(cloud, name="a part of a hull", thicken=thickness) for cloud in clouds]
            yield sum(hull.volume for hull in hulls), halves


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
