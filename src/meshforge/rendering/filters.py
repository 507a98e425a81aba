"""Filters of small pictures, as those of scipy.ndimage, whose import alone takes longer than most pictures."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
import numpy.typing as npt

from meshforge.geometry import Bools, Floats, component_roots

_REACH = 4.0  # standard deviations beyond which a Gaussian is nothing


def blur(picture: npt.NDArray[Any], sigma: float) -> npt.NDArray[Any]:
    """Return a picture (h, w) under a Gaussian of some standard deviation [px], mirrored at its sides."""
    reach = int(_REACH * sigma + 0.5)
    weights = np.exp(-0.5 / (sigma * sigma) * np.arange(-reach, reach + 1) ** 2)
    weights /= weights.sum()
    for axis in (0, 1):
        lines = np.moveaxis(picture, axis, 0).astype(np.float64)
        padded, count = np.pad(lines, ((reach, reach), (0, 0)), mode="symmetric"), len(lines)
        total = lines * weights[reach]
        for step in range(reach):
            total += (padded[step : step + count] + padded[2 * reach - step :][:count]) * weights[step]
        picture = np.moveaxis(total, 0, axis).astype(picture.dtype)
    return picture


def sample(picture: npt.NDArray[Any], places: Floats) -> npt.NDArray[Any]:
    """Return what a picture (h, w) shows at places (n, 2) between its pixels, rows first; 0 beyond the outer ones'
    middles."""
    last = np.array(picture.shape) - 1
    inside = ((places >= 0) & (places <= last)).all(axis=1)
    low = np.floor(places[inside]).astype(np.int64)
    above = places[inside] - low
    total = np.zeros(len(low))
    for steps in product((0, 1), repeat=2):
        rows, columns = np.minimum(low + steps, last).T
        first, second = (above[:, k] if step else 1.0 - above[:, k] for k, step in enumerate(steps))
        total += picture[rows, columns].astype(np.float64) * first * second
    found = np.zeros(len(places), picture.dtype)
    found[inside] = total
    return found


def keep_reached(low: Bools, high: Bools) -> Bools:
    """Return the pixels (h, w) of `low` that hang together, by corners too, with one that is `high` besides."""
    number = np.full((low.shape[0] + 2, low.shape[1] + 2), -1)
    inner = number[1:-1, 1:-1]
    count = int(np.count_nonzero(low))
    inner[low] = np.arange(count)
    rows, columns = np.nonzero(low)
    own = np.arange(count)
    pairs = []
    for down, right in ((0, 1), (1, -1), (1, 0), (1, 1)):
        other = number[rows + 1 + down, columns + 1 + right]
        pairs.append((own[other >= 0], other[other >= 0]))
    first, second = (np.concatenate(side) for side in zip(*pairs, strict=True))
    roots = component_roots(first, second, count)
    kept = np.zeros(count, bool)
    kept[roots[high[low]]] = True
    found = np.zeros(low.shape, bool)
    found[low] = kept[roots]
    return found
