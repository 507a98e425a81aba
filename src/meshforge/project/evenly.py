"""Some of very many things, evenly over all: the same ones each time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

Thing = TypeVar("Thing")


def evenly(things: Sequence[Thing], most: int) -> Sequence[Thing]:
    """The things in their order; of more than `most` so many, the first among them."""
    if len(things) <= most:
        return things
    return [things[place * len(things) // most] for place in range(most)]
