"""The words of the language besides actions and labels: operators and directions."""

from __future__ import annotations

from typing import Literal, get_args

from meshforge.common import ProgramError

OPERATORS = ("All", "Is", "Attach", "Geo", "Union", "Intersect", "Diff")
Direction = Literal["+X", "-X", "+Y", "-Y", "+Z", "-Z"]
DIRECTIONS: tuple[Direction, ...] = get_args(Direction)


def check_direction(direction: str) -> None:
    """Raises ProgramError for what is no direction."""
    if direction not in DIRECTIONS:
        raise ProgramError(f"unknown direction {direction!r}", remedy=f"Directions are {', '.join(DIRECTIONS)}.")
