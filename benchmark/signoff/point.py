"""A session as a curve: what a family has come to after so many seconds of a person."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple


class Point(NamedTuple):
    """After so many seconds of a person. right: assets; signed_off, held: likewise; wrong: those signed off, yet not
    right though they could be; sure: those that are signed off and right."""

    seconds: float
    right: int
    signed_off: int = 0
    wrong: int = 0
    held: int = 0
    sure: int = 0


def right_at(points: Sequence[Point], seconds: float) -> int:
    """How many assets are right at a time; before the first point none, after the last as many as there."""
    past = [point.right for point in points if point.seconds <= seconds]
    return past[-1] if past else 0
