"""Random shapes, poses and point clouds for the laws of geometry, the near-degenerate ones included."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from hypothesis import strategies as st

from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Floats, Pose, Shape, Sphere, convex_hull, spans_volume

KINDS = ("polytope", "box", "sphere", "cylinder", "capsule", "ellipsoid")


def rotation(rng: np.random.Generator) -> Floats:
    """A random rotation (3, 3)."""
    axes, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return np.asarray(axes * np.sign(np.linalg.det(axes)))


def make_shape(kind: str, pose: Pose, sides: Floats, draw_points: Callable[[], Floats]) -> Shape:
    """A shape of a kind; sides: its sizes (3,), of which it may have fewer; draw_points: (n, 3) of a polytope."""
    first, second = float(sides[0]), float(sides[1])
    match kind:
        case "box":
            return Box(pose, sides)
        case "sphere":
            return Sphere(pose, first)
        case "cylinder":
            return Cylinder(pose, first, second)
        case "capsule":
            return Capsule(pose, first, second)
        case "ellipsoid":
            return Ellipsoid(pose, sides)
        case _:
            return convex_hull(pose.apply(draw_points()))


def shape(kind: str, rng: np.random.Generator, spread: float = 1.0) -> Shape:
    """A random shape of a kind, sides from 1 cm to 1 m; one in three is square to the axes."""
    turn = rotation(rng) if rng.random() < 0.67 else np.eye(3)
    pose, sides = Pose(turn, rng.normal(size=3) * spread), 10.0 ** rng.uniform(-2, 0, size=3)
    return make_shape(kind, pose, sides, lambda: rng.normal(size=(int(rng.integers(8, 40)), 3)) * sides)


def posed(primitive: Shape) -> Pose:
    """The pose of a primitive."""
    assert isinstance(primitive, Box | Sphere | Cylinder | Capsule | Ellipsoid)
    return primitive.pose


@st.composite
def generators(draw: st.DrawFn) -> np.random.Generator:
    """A random number generator; hypothesis chooses its seed."""
    return np.random.default_rng(draw(st.integers(0, 2**32 - 1)))


@st.composite
def shapes(draw: st.DrawFn, kinds: tuple[str, ...] = KINDS, spread: float = 1.0) -> Shape:
    return shape(draw(st.sampled_from(kinds)), draw(generators()), spread)


@st.composite
def poses(draw: st.DrawFn) -> Pose:
    rng = draw(generators())
    return Pose(rotation(rng), rng.normal(size=3))


@st.composite
def directions(draw: st.DrawFn) -> Floats:
    """A direction (3,), not of unit length; often along an axis."""
    rng = draw(generators())
    way = rng.normal(size=3) if draw(st.booleans()) else np.eye(3)[rng.integers(3)] * rng.choice([-1, 1])
    return np.asarray(way * 10.0 ** rng.uniform(-3, 3))


CLOUDS = ("scattered", "lattice", "noisy lattice", "single precision", "two planes", "prism", "thin", "needle", "twins")


@st.composite
def clouds(draw: st.DrawFn, kinds: tuple[str, ...] = CLOUDS) -> Floats:
    """Points (n, 3) that span a volume, many of them made to be hard to hull; some far away, some tiny."""
    rng = draw(generators())
    points = _cloud(draw(st.sampled_from(kinds)), int(rng.integers(8, 120)), rng) @ rotation(rng).T
    points = points * 10.0 ** draw(st.sampled_from([0, 0, -6, 3])) + draw(st.sampled_from([0.0, 0.0, 10.0]))
    if not spans_volume(points):
        points = np.concatenate([points, points.mean(axis=0) + np.eye(3) * np.ptp(points), -points])
    return points


def _cloud(kind: str, count: int, rng: np.random.Generator) -> Floats:
    scattered = rng.normal(size=(count, 3))
    match kind:
        case "lattice":
            return rng.integers(0, 4, size=(count, 3)).astype(float)
        case "noisy lattice":
            return np.asarray(rng.integers(0, 3, size=(count, 3)) + scattered * 10.0 ** rng.uniform(-12, -4))
        case "single precision":
            return (rng.integers(0, 5, size=(count, 3)) @ rotation(rng)).astype(np.float32).astype(float)
        case "two planes":
            return np.column_stack([rng.random((count, 2)), rng.integers(0, 2, size=count) * 0.3])
        case "prism":
            turn = np.arange(count) * 2 * np.pi / count
            return np.column_stack([np.cos(turn), np.sin(turn), np.arange(count) % 2])
        case "thin":
            return scattered * [1, 1, 1e-4]
        case "needle":
            return scattered * [1, 1e-3, 1e-4]
        case "twins":
            return np.repeat(scattered, 4, axis=0) + rng.normal(size=(4 * count, 3)) * 1e-11
        case _:
            return scattered
