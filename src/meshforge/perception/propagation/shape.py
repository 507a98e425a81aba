"""What a hull itself is like, and how it lies in the whole: numbers that neither size nor a turn about Z changes."""

from __future__ import annotations

import numpy as np

from meshforge.geometry import Floats
from meshforge.perception.propagation.axes import along
from meshforge.perception.propagation.surroundings import Whole

_LEAST = 1e-6  # of the whole's size; what is thinner counts as so thick
WIDTH = 20
"""Columns of `shapes`."""


def shapes(whole: Whole, volumes: Floats) -> Floats:
    """A row for each hull (n, WIDTH): sizes in logarithms of shares of the whole's, how long, flat and full it is,
    how its axes lie, from where to where it reaches in height and from the upright axis.
    """
    size, corners, counts = whole.size, np.concatenate(whole.pieces), np.array([len(piece) for piece in whole.pieces])
    starts = np.cumsum(counts) - counts
    middle = np.add.reduceat(corners, starts) / counts[:, None]
    offsets = corners - np.repeat(middle, counts, axis=0)
    scatter = np.add.reduceat(offsets[:, :, None] * offsets[:, None, :], starts) / counts[:, None, None]
    values, axes = np.linalg.eigh(scatter)
    spread = np.maximum(2 * np.sqrt(np.maximum(values[:, ::-1], 0.0)), _LEAST * size)
    axes = axes[:, :, ::-1]
    box = spread.prod(axis=1)
    volumes = np.maximum(volumes, 1e-9 * box)
    low, high = np.minimum.reduceat(corners[:, 2], starts), np.maximum.reduceat(corners[:, 2], starts)
    out = np.linalg.norm(corners[:, :2] - whole.axis, axis=1)
    aside = middle[:, :2] - whole.axis
    away = np.linalg.norm(aside, axis=1)
    outward = aside / np.maximum(away, _LEAST * size)[:, None]
    outward = along(np.pad(outward, ((0, 0), (0, 1))), spread, axes)
    upward = along(np.broadcast_to([0.0, 0.0, 1.0], outward.shape), spread, axes)
    return np.column_stack(
        [
            np.log(volumes / size**3) / 3,
            np.log(spread / size),
            np.log(volumes / box) / 3,
            np.log(np.maximum(high - low, _LEAST * size) / size),
            ((low + high) / 2 - whole.foot) / whole.tall,
            away / size,
            upward,
            (spread[:, 0] - spread[:, 1]) / spread[:, 0],
            (spread[:, 1] - spread[:, 2]) / spread[:, 0],
            spread[:, 2] / spread[:, 0],
            (low - whole.foot) / whole.tall,
            (high - whole.foot) / whole.tall,
            np.minimum.reduceat(out, starts) / whole.wide,
            np.maximum.reduceat(out, starts) / whole.wide,
            outward[:, 0],
            outward[:, 2],
        ]
    )
