"""Blades of knives: an outline in the plane z = 0 from x = 0 on, thin at its edge."""

from __future__ import annotations

import numpy as np
from manifold3d import CrossSection, Manifold

from benchmark.assets.draw import Draw

EDGE = 0.0006
"""Half the thickness of an edge [m]."""
_WIDTHS = {"chef": (0.034, 0.055), "cleaver": (0.065, 0.1), "bread": (0.028, 0.038)}
_LENGTHS = {"cleaver": (0.13, 0.2), "bread": (0.2, 0.3)}
_ROWS = {
    "chef": "0 0, .02 -1, .5 -.97, .8 -.8, 1 -.5, .6 0",
    "cleaver": "0 0, 0 -.6, .03 -1, .5 -1, 1 -.97, 1 0",
    "bread": "0 0, 0 -1, .9 -1, 1 -.6, .92 0",
    "hunting": "0 0, 0 -.8, .1 -.8, .12 -1, .5 -1, .85 -.8, 1 -.3, .75 -.25, .5 0",
    "dagger": "0 -.2, 0 -.8, .25 -.83, .55 -1, .8 -.8, 1 -.5, .8 -.2, .55 0, .25 -.17",
    "folding": "-.1 -.25, -.07 -.75, .1 -.75, .12 -1, .6 -.95, 1 -.35, .55 -.05",
}
"""Outlines, along the blade and across it, from its back downwards."""

Extent = tuple[float, float, float]
"""The lowest and the highest y of a blade, and its length [m]."""


def blade(draw: Draw, shape: str, thick: float) -> tuple[Manifold, Extent]:
    """A blade of one of the shapes, and how far it reaches."""
    wide, long = draw.length(*_WIDTHS.get(shape, (0.024, 0.038))), draw.ratio(*_LENGTHS.get(shape, (0.1, 0.3)))
    top = (0.5 if shape == "dagger" else 0.3) * wide
    low = top - wide
    rows = [[float(x) for x in row.split()] for row in _ROWS[shape].split(",")]
    outline = CrossSection([np.array(rows) * (long, wide) + (0, top)])
    if shape == "cleaver" and draw.chance(0.6):
        outline -= CrossSection.circle(0.008, 10).translate((0.88 * long, top - 0.2 * wide))
    if shape == "bread":
        outline -= _teeth(draw.number(6, 14), long, low, draw.length(0.003, 0.005))
    solid = outline.extrude(thick).translate((0, 0, -thick / 2))
    return solid ^ _wedge((low, top, long), thick, shape == "dagger"), (low, top, long)


def _teeth(count: int, long: float, y: float, deep: float) -> CrossSection:
    """What is cut out of an edge."""
    step = 0.85 * long / count
    notch = CrossSection([np.array([(0.1 * step, -0.001), (0.9 * step, -0.001), (0.5 * step, deep)])])
    cuts = CrossSection()
    for k in range(count):
        cuts += notch.translate((0.02 + k * step, y))
    return cuts


def _wedge(extent: Extent, thick: float, double: bool) -> Manifold:
    """The thickness of a blade over its width."""
    low, top, long = extent
    half = thick / 2
    rows = [(low, EDGE), (0.0, half), (top, EDGE)] if double else [(low, EDGE), (top, half)]
    ends = (-0.1, long + 0.1)
    return Manifold.hull_points(np.array([(x, y, side * z) for x in ends for y, z in rows for side in (-1, 1)]))
