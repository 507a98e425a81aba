"""Leaves of doors: panelled, glazed, louvred, boarded, flush; each the same in front as behind."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
from manifold3d import Manifold

from benchmark.assets.draw import Draw
from script.samples.part import Part
from script.samples.solids import block, box, union

HAIRLINE = 0.0008
"""Between parts that are joined and yet no single solid [m]."""


@dataclass(frozen=True)
class Size:
    """Measures of a door [m]; the leaf: width, height, thick, from y = 0 backwards, its foot at height `foot`.

    jamb: width of a jamb; gap: beside the leaf; stop: how far the frame reaches behind the leaf, 0 for a plain frame;
    scale: of what is fastened to it.
    """

    width: float
    height: float
    thick: float
    foot: float
    jamb: float
    gap: float
    stop: float
    scale: float

    @property
    def head(self) -> float:
        """Height of the leaf's upper edge."""
        return self.foot + self.height

    @property
    def deep(self) -> float:
        """Depth of the frame."""
        return self.thick + (0.003 + 0.025 * self.scale if self.stop else 0.0)


def _panel_leaf(size: Size, stile: float, draw: Draw) -> list[Part]:
    """Stiles, rails and thinner panels."""
    rows, columns = draw.number(2, 3), draw.one((1, 1, 2))
    return _frame(size, stile, rows, columns, 0.5, solid=draw.chance(0.5))


def _glass_leaf(size: Size, stile: float, draw: Draw) -> list[Part]:
    """One solid with openings, and a pane in each."""
    rows = draw.number(1, 3)
    return _frame(size, stile, rows, 1, 0.15, solid=True)


def _frame(size: Size, stile: float, rows: int, columns: int, thin: float, solid: bool = False) -> list[Part]:
    """Stiles and rails, as one solid or jointed, and in every opening a pane of a share of their thickness."""
    w, h, t, f = size.width / 2, size.height, size.thick, size.foot
    rail = 0.8 * stile
    edges = np.linspace(rail / 2, h - rail / 2, rows + 1)
    posts = [block((x, 0, f), (x + stile, t, f + h)) for x in (-w, w - stile)]
    inner, tiny = w - stile, 0.0 if solid else HAIRLINE
    rails = [block((-inner + tiny, 0, f + z - rail / 2), (inner - tiny, t, f + z + rail / 2)) for z in edges]
    panes = list[Manifold]()
    across = np.linspace(-inner, inner, columns + 1)
    for low, high in itertools.pairwise(edges):
        for k in range(columns):
            left = across[k] + (rail / 4 if k else 0) + HAIRLINE
            right = across[k + 1] - (rail / 4 if k < columns - 1 else 0) - HAIRLINE
            z0, z1 = f + low + rail / 2 + HAIRLINE, f + high - rail / 2 - HAIRLINE
            panes.append(block((left, t * (0.5 - thin / 2), z0), (right, t * (0.5 + thin / 2), z1)))
        if columns == 2:
            bar = block((-rail / 4, 0, f + low + rail / 2 + HAIRLINE), (rail / 4, t, f + high - rail / 2 - HAIRLINE))
            rails.append(bar)
    bones = [union([*posts, *rails])] if solid else [*posts, *rails]
    return [Part(f"leaf_{k}", "leaf", piece) for k, piece in enumerate([*bones, *panes], 1)]


def _louvre_leaf(size: Size, stile: float, draw: Draw) -> list[Part]:
    """A frame with slanted slats in it."""
    bones = _frame(size, stile, 1, 1, 0.5, solid=draw.chance(0.5))[:-1]
    count, rail = draw.number(4, 8), 0.8 * stile
    inner, pitch = size.width / 2 - stile - HAIRLINE, (size.height - 2 * rail) / count
    middle = size.thick / 2
    slat = box((2 * inner, 0.012 * size.scale, min(0.8 * pitch, 1.3 * size.thick)), (0, 0, 0)).rotate((35, 0, 0))
    rise = [size.foot + rail + (k + 0.5) * pitch for k in range(count)]
    slats = [Part(f"slat_{k}", "leaf", slat.translate((0, middle, z))) for k, z in enumerate(rise, 1)]
    return [*bones, *slats]


def _board_leaf(size: Size, stile: float, draw: Draw) -> list[Part]:
    """Upright boards with a gap between them, on ledges in front and behind."""
    count, gap = draw.number(3, 5), draw.one((2 * HAIRLINE, 0.006 * size.width))
    each = (size.width - gap * (count - 1)) / count
    lows = [-size.width / 2 + k * (each + gap) for k in range(count)]
    t, f, h = size.thick, size.foot, size.height
    boards = [block((x, 0, f), (x + each, t, f + h)) for x in lows]
    half, slim = size.width / 2 - 0.02 * size.width - size.stop, 0.006 * size.scale
    boards += [
        block((-half, y, f + (z - 0.04) * h), (half, y + slim, f + (z + 0.04) * h))
        for z in (0.27, 0.73)
        for y in (-slim - HAIRLINE, t + HAIRLINE)
    ]
    return [Part(f"board_{k}", "leaf", board) for k, board in enumerate(boards, 1)]


def _flush(size: Size, stile: float, draw: Draw) -> list[Part]:
    """One board."""
    w, t = size.width / 2, size.thick
    return [Part("leaf", "leaf", block((-w, 0, size.foot), (w, t, size.head)))]


LEAVES = {
    "panelled": _panel_leaf,
    "boarded": _board_leaf,
    "louvred": _louvre_leaf,
    "glazed": _glass_leaf,
    "flush": _flush,
}
"""Makes the parts of a leaf, by style, from its size, the width of its stiles and a draw."""
