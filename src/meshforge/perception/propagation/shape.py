"""What a hull itself is like, and how it lies in the whole: numbers that neither size nor a turn about Z changes."""

from __future__ import annotations

import numpy as np

from meshforge.geometry import Floats
from meshforge.perception.propagation.surroundings import Whole

_LEAST = 1e-6  # of the whole's size; what is thinner counts as so thick
WIDTH = 20
"""Columns of `shapes`."""


def shapes(whole: Whole, volumes: Floats) -> Floats:
    """A row for each hull (n, WIDTH): sizes in logarithms of shares of the whole's, how long, flat and full it is,
    how its axes lie, from where to where it reaches in height and from the upright axis.
    """
    return np.array([_row(whole, piece, volume) for piece, volume in zip(whole.pieces, volumes, strict=True)])


def _row(whole: Whole, piece: Floats, volume: float) -> list[float]:
    size, middle = whole.size, piece.mean(axis=0)
    values, axes = np.linalg.eigh(np.cov(piece.T, bias=True))
    spread = np.maximum(2 * np.sqrt(np.maximum(values[::-1], 0.0)), _LEAST * size)
    axes = axes[:, ::-1]
    box = float(spread.prod())
    volume = max(volume, 1e-9 * box)
    low, high = piece[:, 2].min(), piece[:, 2].max()
    out = np.linalg.norm(piece[:, :2] - whole.axis, axis=1)
    aside = middle[:2] - whole.axis
    outward = aside / max(float(np.linalg.norm(aside)), _LEAST * size)
    return [
        np.log(volume / size**3) / 3,
        *np.log(spread / size),
        np.log(volume / box) / 3,
        np.log(max(high - low, _LEAST * size) / size),
        ((low + high) / 2 - whole.foot) / whole.tall,
        float(np.linalg.norm(aside)) / size,
        *np.abs(axes[2]),
        (spread[0] - spread[1]) / spread[0],
        (spread[1] - spread[2]) / spread[0],
        spread[2] / spread[0],
        (low - whole.foot) / whole.tall,
        (high - whole.foot) / whole.tall,
        float(out.min()) / whole.wide,
        float(out.max()) / whole.wide,
        abs(float(axes[:2, 0] @ outward)),
        abs(float(axes[:2, 2] @ outward)),
    ]
