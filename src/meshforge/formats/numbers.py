"""Numbers that rounding has touched, made ready to be written."""

from __future__ import annotations

import numpy as np

from meshforge.geometry import Floats

_ROUNDING = 1e-14  # as a share of the largest number; a few products of rotations make less


def tidy(values: Floats, scale: float | None = None) -> Floats:
    """The numbers without those that are but the rounding of larger ones; scale: of these, else of the largest."""
    largest = float(np.abs(values).max()) if scale is None else scale
    return np.where(np.abs(values) < _ROUNDING * largest, 0.0, values)
