"""Where things stand: legs at the corners, drawers in a row."""

from __future__ import annotations

import math
from collections.abc import Callable

from manifold3d import Manifold

from script.samples.drawers import Handle, drawer
from script.samples.legs import leg
from script.samples.part import Part


def legs_at(places: list[tuple[float, float]], make: Callable[[float, float], Manifold]) -> list[Part]:
    """A leg at each place (x, y), made by `make(x, y)` about the origin."""
    return [leg(f"leg_{k + 1}", make(x, y)).move(x, y) for k, (x, y) in enumerate(places)]


def corners(width: float, depth: float) -> list[tuple[float, float]]:
    """The four corners of a rectangle about the origin."""
    return [(-width / 2, -depth / 2), (width / 2, -depth / 2), (width / 2, depth / 2), (-width / 2, depth / 2)]


def ring(count: int, radius: float, first: float = 90.0) -> list[tuple[float, float]]:
    """Places on a circle; first: direction of the first one [degrees]."""
    turns = [math.radians(first + 360.0 * k / count) for k in range(count)]
    return [(radius * math.cos(t), radius * math.sin(t)) for t in turns]


def outward(x: float, y: float) -> tuple[float, float, float]:
    """The horizontal direction from the middle to (x, y)."""
    length = math.hypot(x, y) or 1.0
    return (x / length, y / length, 0.0)


def row(
    count: int, gap: float, size: tuple[float, float, float], handle: Handle, front: float, z: float, *,
    pulled: tuple[float, ...] = (), turn: float = 0.0, first: int = 1,
) -> list[Part]:  # fmt: skip
    """Drawers side by side, looking to -Y before the turn about the middle.

    front: how far their fronts are from the middle; pulled: how far each stands open [m]; first: number of the first.
    """
    parts: list[Part] = []
    for k in range(count):
        x = (k - (count - 1) / 2) * (size[0] + gap)
        out = pulled[k] if k < len(pulled) else 0.0
        parts += drawer(f"drawer_{first + k}", size, handle, x, -front - out, z)
    return [part.move(turn=turn) for part in parts]
