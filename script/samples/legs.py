"""Legs of many kinds; each is a body of its own that becomes one convex hull when merged."""

from __future__ import annotations

import numpy as np
from manifold3d import CrossSection, Manifold

from script.samples.part import Part
from script.samples.solids import Point, block, box, revolve, taper, union


def leg(name: str, solid: Manifold) -> Part:
    """A solid as a part that is a leg."""
    return Part(name, "leg", solid)


def square(height: float, width: float, block_size: float, block_height: float) -> Manifold:
    """A square shaft under a wider block, on a wider foot."""
    return union(
        [
            block((-width / 2, -width / 2, 0.02), (width / 2, width / 2, height)),
            box((block_size, block_size, block_height), (0, 0, height - block_height / 2)),
            taper((0, 0, 0), (0, 0, 0.05), width * 1.2, width * 1.7),
        ]
    )


def lathe(height: float, width: float) -> Manifold:
    """A turned leg: foot, vase, ring and block."""
    r, h = width / 2, height
    shaft = revolve(
        [(0.5 * r, 0), (0.75 * r, 0.06 * h), (0.5 * r, 0.1 * h), (0.62 * r, 0.3 * h), (0.95 * r, 0.55 * h),
         (1.0 * r, 0.62 * h), (0.55 * r, 0.7 * h), (0.95 * r, 0.74 * h), (0.55 * r, 0.78 * h), (0.55 * r, 0.86 * h)]
    )  # fmt: skip
    return shaft + box((2.1 * r, 2.1 * r, 0.18 * h), (0, 0, 0.91 * h))


def sabre(height: float, width: float, sweep: float, heading: Point, steps: int = 5) -> Manifold:
    """A leg that curves outwards to its foot by `sweep` [m] along `heading`."""
    levels = [height * k / steps for k in range(steps, -1, -1)]
    out = [sweep * (1 - z / height) ** 2 for z in levels]
    at = [(heading[0] * s, heading[1] * s, z) for s, z in zip(out, levels, strict=True)]
    sizes = [width * (0.55 + 0.45 * z / height) for z in levels]
    return union([taper(at[k + 1], at[k], sizes[k + 1], sizes[k]) for k in range(steps)])


def splay_leg(height: float, width: float, splay: Point, sides: int = 4, collar: float = 0.0) -> Manifold:
    """A straight leg that leans outwards, tapered to its foot; collar: extra width of a ring in the middle."""
    shaft = taper(splay, (0, 0, height), width * 0.6, width, sides)
    if not collar:
        return shaft
    middle: Point = (splay[0] * 0.45, splay[1] * 0.45, height * 0.55)
    below: Point = (splay[0] * 0.55, splay[1] * 0.55, height * 0.45)
    return shaft + taper(below, middle, width + collar, width + collar, sides)


def lyre(height: float, width: float, thickness: float) -> Manifold:
    """An upright board across Y with hollowed sides, on a foot and under a head: one end of a trestle table."""
    w, h = width / 2, height
    outline = [(0.8 * w, 0.04), (0.62 * w, 0.3 * h), (0.55 * w, 0.5 * h), (0.62 * w, 0.7 * h), (0.85 * w, h - 0.05)]
    points = [*outline, *((-x, z) for x, z in reversed(outline))]
    board = CrossSection([np.array(points)]).extrude(thickness).translate((0, 0, -thickness / 2))
    upright = board.transform(np.array([[0.0, 0, 1, 0], [1, 0, 0, 0], [0, 1, 0, 0]]))
    foot = block((-thickness * 0.9, -w, 0), (thickness * 0.9, w, 0.05))
    head = block((-thickness * 0.9, -0.95 * w, h - 0.06), (thickness * 0.9, 0.95 * w, h))
    return union([upright, foot, head])


def drum(height: float, radius: float) -> Manifold:
    """A stout turned column with a plinth, a waist and a ring below the top."""
    r, h = radius, height
    return revolve(
        [(1.08 * r, 0), (1.08 * r, 0.08 * h), (0.95 * r, 0.1 * h), (0.95 * r, 0.2 * h), (0.82 * r, 0.35 * h),
         (0.82 * r, 0.65 * h), (0.95 * r, 0.8 * h), (0.95 * r, 0.9 * h), (1.05 * r, 0.92 * h), (1.05 * r, h)], 20
    )  # fmt: skip


def slab(height: float, depth: float, thickness: float) -> Manifold:
    """An upright board across Y on a plinth, with a ledge below the top."""
    d, t, h = depth / 2, thickness / 2, height
    return union(
        [
            block((-t, -d, 0), (t, d, h)),
            block((-t - 0.012, -d - 0.012, 0), (t + 0.012, d + 0.012, 0.07)),
            block((-t - 0.012, -d - 0.012, h - 0.05), (t + 0.012, d + 0.012, h)),
        ]
    )
