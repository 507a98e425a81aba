"""Watertight solids that tables are built of, by manifold3d: boxes, plates, turned profiles, bars between points."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np
from manifold3d import CrossSection, JoinType, Manifold, OpType

from script.families import pieces

Point = pieces.Point


def box(size: Point, center: Point) -> Manifold:
    """A box by its side lengths and its centre [m]."""
    return Manifold.cube(size, True).translate(center)


def block(low: Point, high: Point) -> Manifold:
    """A box between two corners [m]."""
    return Manifold.cube(tuple(b - a for a, b in zip(low, high, strict=True))).translate(low)


def union(solids: Sequence[Manifold]) -> Manifold:
    """All solids as one."""
    return Manifold.batch_boolean(list(solids), OpType.Add)


def plate(outline: CrossSection, top: float, thickness: float) -> Manifold:
    """An outline in the plane as a plate whose upper face is at height `top`."""
    return outline.extrude(thickness).translate((0, 0, top - thickness))


def rectangle(width: float, depth: float, radius: float = 0.0, segments: int = 16) -> CrossSection:
    """A rectangle about the origin, its corners rounded."""
    if not radius:
        return CrossSection.square((width, depth), True)
    inner = CrossSection.square((width - 2 * radius, depth - 2 * radius), True)
    return inner.offset(radius, JoinType.Round, circular_segments=segments)


def chamfer(width: float, depth: float, cut: float) -> CrossSection:
    """A rectangle about the origin without its corners."""
    w, d = width / 2, depth / 2
    corners = [(w, d - cut), (w - cut, d), (cut - w, d), (-w, d - cut), (-w, cut - d), (cut - w, -d), (w - cut, -d)]
    return CrossSection([np.array([*corners, (w, cut - d)])])


def superellipse(width: float, depth: float, power: float = 4.0, points: int = 40) -> CrossSection:
    """A rectangle about the origin with softly rounded sides."""
    return CrossSection([pieces.superellipse(width, depth, power, points)])


def revolve(profile: Sequence[tuple[float, float]], segments: int = 12) -> Manifold:
    """A solid of revolution about Z: (radius, height) from below."""
    points = [(0.0, profile[0][1]), *profile, (0.0, profile[-1][1])]
    return CrossSection([np.array(points)]).revolve(segments)


def taper(low: Point, high: Point, low_size: float, high_size: float, sides: int = 4) -> Manifold:
    """A straight post between two points with level ends, of `sides` sides; sizes are widths [m]."""
    return Manifold.hull_points(pieces.post_points(low, high, low_size, high_size, sides))


def bar(start: Point, end: Point, width: float, sides: int = 8) -> Manifold:
    """A straight bar between two points with square ends, of `sides` sides."""
    return Manifold.hull_points(pieces.bar_points(start, end, width, sides))


def tube(path: Sequence[Point], width: float, sides: int = 8) -> Manifold:
    """A bent bar along points, with round joints."""
    joints = [Manifold.sphere(width / 2, sides).translate(p) for p in path[1:-1]]
    return union([bar(a, b, width, sides) for a, b in itertools.pairwise(path)] + joints)


def pebble(center: Point, size: float, rng: np.random.Generator, points: int = 14) -> Manifold:
    """An irregular convex lump."""
    cloud = rng.normal(size=(points, 3))
    cloud *= size / 2 / np.linalg.norm(cloud, axis=1, keepdims=True) * rng.uniform(0.6, 1.0, (points, 1))
    return Manifold.hull_points(cloud + center)
