"""Fits are remembered: a program is learned anew after every answer, and runs the same action on the same hulls."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from functools import wraps
from hashlib import blake2b
from typing import Protocol, TypeVar

import numpy as np

from meshforge.geometry.arrays import Floats
from meshforge.geometry.shapes import Shape

Fitted = TypeVar("Fitted", bound=Shape, covariant=True)
_MOST = 4096  # fits, a few hundred bytes each


class Fit(Protocol[Fitted]):
    """A function that fits a shape around points (n, 3); name: what messages call them."""

    def __call__(self, points: Floats, *, name: str = "points", thicken: float | None = None) -> Fitted: ...


def remembered(fit: Callable[..., Fitted]) -> Fit[Fitted]:
    """The same function, which does the same points only once; failures are not remembered."""
    known: OrderedDict[tuple[bytes, float | None], Fitted] = OrderedDict()

    @wraps(fit)
    def remembering(points: Floats, *, name: str = "points", thicken: float | None = None) -> Fitted:
        key = blake2b(np.ascontiguousarray(points).data, digest_size=16).digest(), thicken
        fitted = known.pop(key, None) or fit(points, name=name, thicken=thicken)
        known[key] = fitted
        if len(known) > _MOST:
            known.popitem(last=False)
        return fitted

    return remembering
