"""Order among numbers that are equal but for rounding, which is another on each processor."""

import numpy as np

from meshforge.geometry import Floats, Ints

EQUAL = 1e-9
"""Numbers about one that differ by less differ by rounding; that of linear algebra is another on each processor."""


def first_greatest(values: Floats, within: float = EQUAL) -> Ints:
    """Return the place (...) of the first of those values (..., n) that are the greatest but for `within`."""
    found: Ints = np.argmax(values >= values.max(axis=-1, keepdims=True) - within, axis=-1)
    return found


def greatest_first(values: Floats) -> list[int]:
    """Return the places of values (n,), the greatest first; those that are equal in their order."""
    left, found = values.astype(float), list[int]()
    for _ in values:
        found.append(int(first_greatest(left)))
        left[found[-1]] = -np.inf
    return found


def share_ranks(values: Floats) -> Floats:
    """Return how many of some values (n,), none negative, are greater than each; of those that are equal, half."""
    greater = values[None] > values[:, None] * (1 + EQUAL)
    found: Floats = (len(values) - 1 + greater.sum(axis=1) - greater.sum(axis=0)) / 2
    return found


def pick_evenly(items: Ints, most: int) -> Ints:
    """Return of very many some, evenly."""
    return items if len(items) <= most else items[np.arange(most) * len(items) // most]
