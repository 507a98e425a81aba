"""Lamp shades, hollow, and the wires that hold them."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
from manifold3d import Manifold

from benchmark.assets.draw import Draw
from meshforge.geometry import Floats
from script.samples.solids import Point, bar, block, revolve

GAP, SUNK = 0.0006, 0.002  # between parts that are fitted together; how far glued ones reach into each other [m]
Row = tuple[float, float]
_STYLES = ("drum", "cone", "empire", "square")


@dataclass(frozen=True)
class Shade:
    """A shade that stands on z = 0 about the axis.

    outline: rows of outer radius and height [m]; wires, crossing: how many hold it from below, cross it;
    glued: these are one solid with it.
    """

    style: str
    radius: float
    height: float
    wall: float
    outline: tuple[Row, ...]
    solid: Manifold
    wires: int
    crossing: int
    glued: bool

    def inner(self, share: float) -> float:
        """The inner radius at a share of the height."""
        radii, heights = zip(*self.outline, strict=True)
        return float(np.interp(share * self.height, heights, radii)) - self.wall


def draw_shade(draw: Draw, radius: float, glued: bool, closed: bool = False) -> Shade:
    """A shade of some style; closed: above."""
    style, height, wall = draw.one(_STYLES), radius * draw.ratio(0.7, 1.7), 0.045 * radius + 0.0015
    above = {"cone": draw.length(0.5, 0.75), "empire": draw.length(0.55, 0.75)}.get(style, 1.0)
    outline = [(radius, 0.0), (above * radius, height)]
    if style == "empire":
        outline.insert(1, (radius * (0.9 * above + 0.1), 0.45 * height))
    top = height - wall if closed else height + 1e-3
    if style == "square":
        side, hole = radius, radius - wall
        solid = block((-side, -side, 0), (side, side, height)) - block((-hole, -hole, -1), (hole, hole, top))
    else:
        inside = [(r - wall, z) for r, z in outline]
        inside = [_on(inside[0], inside[1], -1e-3), *inside[1:-1], _on(inside[-2], inside[-1], top)]
        solid = (revolve(outline, 16) - revolve(inside, 16)).rotate((0, 0, 11.25))  # flat where wires end
    return Shade(style, radius, height, wall, tuple(outline), solid, draw.one((2, 4)), draw.number(1, 2), glued)


def struts(shade: Shade, count: int, start: float, foot: float, low: float, wire: float) -> list[Manifold]:
    """Straight wires from the rim of a socket out to the wall of a shade that stands at height `low`."""
    high, room = low + 0.22 * shade.height, _room(shade, 0.22).translate((0, 0, low))
    a, b = np.array((start, 0, foot + 1.2 * wire)), np.array((shade.inner(0.22), 0, high))
    solid = bar(_point(a), _point(b + (b - a) * 0.3), 2 * wire, 6) ^ room
    return [solid.rotate((0, 0, 90 + k * 360 / count)) for k in range(count)]


def bars(shade: Shade, count: int, share: float, low: float, wire: float) -> list[Manifold]:
    """One or two wires from wall to wall through the axis, the second above the first."""
    room, z = _room(shade, share), share * shade.height
    solids = [bar((-shade.radius, 0, z + d), (shade.radius, 0, z + d), 2 * wire, 6) ^ room for d in (0, 4 * wire)]
    turned_by = [solid.rotate((0, 0, 90 * k)).translate((0, 0, low)) for k, solid in enumerate(solids)]
    return turned_by[:count]


def _room(shade: Shade, share: float) -> Manifold:
    """What wires that are fitted at a share of the height must keep to: convex, the inside there and straight on."""
    rows = next(pair for pair in itertools.pairwise(shade.outline) if pair[1][1] > share * shade.height)
    off = shade.wall + (-SUNK if shade.glued else GAP)
    below = rows[0][1] - (shade.height if rows[0][1] == 0 else 0.0)
    ends = [(r - off, z) for r, z in (_on(*rows, below), rows[1])]
    if shade.style == "square":
        side = ends[0][0]
        return block((-side, -side, below), (side, side, ends[1][1]))
    return revolve(ends, 16).rotate((0, 0, 11.25))


def _on(low: Row, high: Row, z: float) -> Row:
    """The point at height z of the line through two."""
    return (low[0] + (high[0] - low[0]) * (z - low[1]) / (high[1] - low[1]), z)


def _point(row: Floats) -> Point:
    return (float(row[0]), float(row[1]), float(row[2]))
