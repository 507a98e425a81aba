"""Convex pieces that samples are built of, all from points: posts, bars, stacks of rings, walls, bent bars, slices."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Sequence

import numpy as np

from meshforge.geometry import Floats, Polytope, Pose, convex_hull, cut

DIGITS = 5
"""Of coordinates in the files: hundredths of a millimetre."""

Point = tuple[float, float, float]
Profile = Sequence[tuple[float, float]]
"""What a stack or a wall is like from below: half its width and the height there [m]."""
Cut = tuple[Point, int]
"""A direction, and into how many slices across it a piece is cut."""

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
"""Directions for cuts."""
Y_UP = Pose([[1, 0, 0], [0, 0, 1], [0, -1, 0]], [0, 0, 0])
"""What is built with Z up, as it lies in a file where Y is up."""


def superellipse(width: float, depth: float, power: float = 4.0, points: int = 40) -> Floats:
    """A closed outline (points, 2) about the origin [m]: an ellipse of power 2, ever more of a rectangle above."""
    turn = (np.arange(points) + 0.5) * 2 * np.pi / points
    c, s = np.cos(turn), np.sin(turn)
    outline = [width / 2 * np.sign(c) * abs(c) ** (2 / power), depth / 2 * np.sign(s) * abs(s) ** (2 / power)]
    return np.stack(outline, axis=1)


def post_points(low: Point, high: Point, low_size: float, high_size: float, sides: int = 4) -> Floats:
    """The corners (2 sides, 3) of a straight post between two points with level ends; sizes are widths [m]."""
    turn = (np.arange(sides) + 0.5) * 2 * np.pi / sides
    rim = np.stack([np.cos(turn), np.sin(turn), np.zeros(sides)], axis=1) / (2 * np.cos(np.pi / sides))
    return np.concatenate([rim * low_size + low, rim * high_size + high])


def bar_points(start: Point, end: Point, width: float, sides: int = 8) -> Floats:
    """The corners (2 sides, 3) of a straight bar between two points with square ends [m]."""
    a, b = np.array(start), np.array(end)
    along = (b - a) / np.linalg.norm(b - a)
    helper = np.eye(3)[int(np.argmin(abs(along)))]
    u = np.cross(along, helper)
    u /= np.linalg.norm(u)
    v = np.cross(along, u)
    turn = (np.arange(sides) + 0.5) * 2 * np.pi / sides
    rim = (np.outer(np.cos(turn), u) + np.outer(np.sin(turn), v)) * width / 2
    return np.concatenate([rim + a, rim + b])


def hull_of(points: Floats, pose: Pose | None = None) -> Polytope:
    """The hull of points (n, 3), put at a pose, its coordinates rounded to DIGITS."""
    return convex_hull(np.round(pose.apply(points) if pose else points, DIGITS), name="a piece of a sample")


def block(low: Point, high: Point) -> Polytope:
    """A box between two corners [m]."""
    return hull_of(np.array(list(itertools.product(*zip(low, high, strict=True)))))


def stack(outline: Floats, profile: Profile) -> list[Polytope]:
    """A solid for each two neighbours of a profile, all of one outline (n, 2), which is half a width of one wide."""
    rings = [np.column_stack([outline * half, np.full(len(outline), z)]) for half, z in profile]
    return [hull_of(np.concatenate(pair)) for pair in itertools.pairwise(rings)]


def wall(outline: Floats, profile: Profile, thickness: float, columns: int) -> list[Polytope]:
    """A hollow wall as rows of curved tiles, each row set off against the one below; rows from below.

    outline (n, 2): see `stack`; columns: tiles of a row, as wide as the corners of the outline allow.
    """
    tiles = []
    for row, pair in enumerate(itertools.pairwise(profile)):
        stops = np.linspace(0, len(outline), columns + 1).round().astype(int) + row
        for first, last in itertools.pairwise(stops.tolist()):
            corners = outline[np.arange(first, last + 1) % len(outline)]
            sizes = [(half - inset, z) for half, z in pair for inset in (0.0, thickness)]
            tiles.append(hull_of(np.concatenate([np.insert(corners * half, 2, z, axis=1) for half, z in sizes])))
    return tiles


def bend(path: Floats, width: float, thickness: float, sides: int = 6) -> list[Polytope]:
    """A bar bent along a path (n, 2) in the plane of X and Z, a piece for each two neighbours, mitred where they meet.

    width: along Y; thickness: across the path [m].
    """
    steps = np.diff(path, axis=0)
    steps /= np.linalg.norm(steps, axis=1, keepdims=True)
    along = np.concatenate([steps[:1], steps[:-1] + steps[1:], steps[-1:]])
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    across = np.stack([along[:, 1], np.zeros(len(path)), -along[:, 0]], axis=1)
    rim = superellipse(width, thickness, 2.0, sides)
    middles = np.insert(path, 1, 0.0, axis=1)
    rings = [
        m + np.outer(rim[:, 0], (0.0, 1.0, 0.0)) + np.outer(rim[:, 1], n) for m, n in zip(middles, across, strict=True)
    ]
    return [hull_of(np.concatenate(pair)) for pair in itertools.pairwise(rings)]


def slice_all(hulls: Iterable[Polytope], cuts: Iterable[Cut]) -> list[Polytope]:
    """Each hull cut into slices of equal width, by one cut after the other."""
    found = list(hulls)
    for direction, count in cuts:
        found = [part for hull in found for part in _slice(hull, np.array(direction), count)]
    return found


def _slice(hull: Polytope, normal: Floats, count: int) -> list[Polytope]:
    heights = hull.vertices @ normal
    parts, rest = [], hull
    for height in np.linspace(heights.min(), heights.max(), count + 1)[1:-1]:
        below, above = cut(rest, normal * (height / (normal @ normal)), normal)
        assert below is not None and above is not None  # it is within the hull
        parts.append(below)
        rest = above
    return [hull_of(part.vertices) for part in (*parts, rest)]
