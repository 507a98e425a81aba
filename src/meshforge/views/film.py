"""Pixels in the making: colours with alpha that are laid over each other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from meshforge.geometry import Ints
from meshforge.views.camera import Singles


@dataclass(frozen=True, eq=False, slots=True)
class Painted:
    """A drawing: pixels (h, w, 4), premultiplied, in 0..1; items (h, w), the solid things seen, -1 for none."""

    pixels: Singles
    items: Ints


class Film:
    """Premultiplied pixels; black with the alpha (h, w) given, at first."""

    def __init__(self, alpha: Singles) -> None:
        self._shape = alpha.shape
        self._rgb = np.zeros((alpha.size, 3), np.float32)
        self._alpha = np.ascontiguousarray(alpha, np.float32).ravel()

    def blend(self, rows: Ints, columns: Ints, color: Singles, share: Singles | None = None) -> None:
        """Lays colours (n, 3) over pixels (n,), as much of them as `share` (n,) in 0..1 says, wholly by default."""
        at = rows * self._shape[1] + columns
        if share is None:
            self._rgb[at], self._alpha[at] = color, 1.0
            return
        keep = 1 - share
        self._rgb[at] = self._rgb[at] * keep[:, None] + color * share[:, None]
        self._alpha[at] = self._alpha[at] * keep + share

    def downsample(self, fine: int) -> Singles:
        """The mean (h, w, 4) of each block of `fine` times `fine` pixels."""
        height, width = self._shape
        out = np.empty((height // fine, width // fine, 4), np.float32)
        for part, values in ((slice(0, 3), self._rgb.reshape(height, width, 3)), (slice(3, 4), self._alpha)):
            blocks = values.reshape(height, width, -1)
            total = sum(blocks[r::fine, c::fine] for r in range(fine) for c in range(fine))
            out[..., part] = total / np.float32(fine * fine)
        return out


def spots(mask: Any) -> tuple[Ints, Ints]:
    """Rows and columns of the pixels (h, w) that are set; quicker than `nonzero`."""
    rows, columns = np.divmod(np.flatnonzero(mask), mask.shape[1])
    return rows, columns
