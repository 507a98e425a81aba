"""Handles that are on no drawer, and what a scan or an untidy room leaves on and around a table."""

from __future__ import annotations

import numpy as np
from manifold3d import Manifold

from script.samples.part import Part
from script.samples.solids import Point, bar, box, pebble, revolve, tube, union

LIFT = 0.0006  # what lies on a surface touches it without being fused with it [m]


def towel_bar(name: str, x: float, y: float, z: float, length: float, reach: float, turn: float = 0.0) -> Part:
    """A rod on two posts, mounted in the plane y = 0 and standing out along -Y before the turn."""
    posts = [bar((s * length * 0.4, 0.006, 0), (s * length * 0.4, -reach, 0), 0.014, 6) for s in (-1, 1)]
    rod = bar((-length / 2, -reach, 0), (length / 2, -reach, 0), 0.018, 8)
    return Part(name, "handle", union([rod, *posts])).move(x, y, z, turn)


def grip(name: str, x: float, y: float, z: float, width: float, reach: float, turn: float = 0.0) -> Part:
    """A carrying grip: a flat loop standing out along -Y before the turn."""
    w = width / 2
    path: list[Point] = [
        (-w, 0.006, 0),
        (-w, -reach * 0.6, 0),
        (-w * 0.7, -reach, 0),
        (w * 0.7, -reach, 0),
        (w, -reach * 0.6, 0),
        (w, 0.006, 0),
    ]
    return Part(name, "handle", tube(path, 0.018, 6)).move(x, y, z, turn)


def book(x: float, y: float, z: float, turn: float, size: Point = (0.21, 0.15, 0.03)) -> Part:
    """A closed book: two covers and a block of pages set back."""
    w, d, h = size
    covers = [
        box((w, d, 0.003), (0, 0, 0.0015)),
        box((w, d, 0.003), (0, 0, h - 0.0015)),
        box((0.004, d, h), (-w / 2 + 0.002, 0, h / 2)),
    ]
    pages = box((w - 0.012, d - 0.012, h - 0.004), (-0.004, 0, h / 2))
    return Part("book", "misc", union([*covers, pages])).move(x, y, z + LIFT, turn)


def mug(x: float, y: float, z: float, turn: float) -> Part:
    """A mug with an ear, which is nobody's drawer handle."""
    body = revolve([(0.032, 0), (0.04, 0.01), (0.042, 0.095)], 14) - revolve([(0.036, 0.008), (0.038, 0.2)], 14)
    ear = tube([(0.038, 0, 0.075), (0.062, 0, 0.07), (0.066, 0, 0.045), (0.055, 0, 0.028), (0.037, 0, 0.025)], 0.009, 6)
    return Part("mug", "misc", body + ear).move(x, y, z + LIFT, turn)


def bowl(x: float, y: float, z: float) -> Part:
    """A shallow bowl."""
    outer = revolve([(0.05, 0), (0.1, 0.025), (0.13, 0.06)], 16)
    inner = revolve([(0.045, 0.008), (0.094, 0.032), (0.13, 0.07)], 16)
    return Part("bowl", "misc", outer - inner).move(x, y, z + LIFT)


def lamp(x: float, y: float, z: float, turn: float) -> Part:
    """A small desk lamp."""
    base = revolve([(0.07, 0), (0.07, 0.015), (0.02, 0.022)], 12)
    arm = tube([(0, 0, 0.01), (0, 0, 0.2), (0.1, 0, 0.36), (0.16, 0, 0.34)], 0.016, 6)
    shade = revolve([(0.03, 0), (0.07, -0.09)][::-1], 12).translate((0.18, 0, 0.34))
    return Part("lamp", "misc", union([base, arm, shade])).move(x, y, z + LIFT, turn)


def crumbs(around: list[Point], size: float, rng: np.random.Generator) -> list[Part]:
    """Lumps that a scan left floating or lying about."""
    return [
        Part(f"crumb_{k}", "misc", pebble(p, size * float(rng.uniform(0.6, 1.4)), rng)) for k, p in enumerate(around)
    ]


def cable(path: list[Point], thickness: float = 0.014) -> Part:
    """A cable that lies on the floor or hangs."""
    return Part("cable", "misc", tube(path, thickness, 6))


def offcut(x: float, y: float, turn: float, size: Point) -> Part:
    """A forgotten strip of wood on the floor."""
    solid: Manifold = box(size, (0, 0, size[2] / 2))
    return Part("offcut", "misc", solid).move(x, y, 0.0, turn)
