"""How the axes of a spread of points lie, also where some are equally long, so that no one knows which is which."""

from __future__ import annotations

import numpy as np

from meshforge.geometry import Floats

_SAME = 0.01  # of their sum: lengths that differ by less count as mostly the same


def along(direction: Floats, lengths: Floats, axes: Floats) -> Floats:
    """How much each axis of n spreads points along a direction (n, 3), or against it: (n, 3), from 0 to 1.

    lengths: (n, 3), positive; axes: (n, 3, 3), of unit length, in columns. Axes of the same length share what they
    have, for any other axes in their plane are as good; those of nearly the same do so partly, so that nothing leaps.
    """
    squares = np.einsum("nij,ni->nj", axes, direction) ** 2
    one, other = lengths[:, :, None], lengths[:, None]
    shares = np.exp(-(((one - other) / (one + other) / _SAME) ** 2))
    found: Floats = np.sqrt(np.einsum("nij,nj->ni", shares / shares.sum(axis=2, keepdims=True), squares))
    return found
