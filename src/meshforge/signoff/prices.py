"""What a reply costs a person [s], by the keystroke-level model (Card, Moran and Newell 1980)."""

from __future__ import annotations

from collections.abc import Iterable

from meshforge.synthesis import Demonstration

_THINK, _CLICK = 1.35, 1.3
READING = 2 * _THINK + _CLICK
"""Pictures compared, and one taken."""
YES_OR_NO = _THINK + _CLICK
"""A result or a label looked at, and one click."""
_OPEN, _STEP = _THINK + _CLICK, _THINK + _CLICK
_HULL_OF_GROUP = 0.5
_USUAL_DEMONSTRATION = (2.0, 4.0)  # steps and hulls, where nothing was demonstrated yet


def price_group(hulls: int, exceptions: float = 0.0) -> float:
    """A group of look-alike hulls looked at and confirmed, but for some that are clicked."""
    return _THINK + _HULL_OF_GROUP * hulls + _CLICK * (1 + exceptions)


def price_demonstration(demos: Iterable[Demonstration]) -> float:
    """An asset demonstrated, as those before were on average."""
    steps = [[step.select for step in demo.steps if step.select] for demo in demos]
    if not steps:
        count, hulls = _USUAL_DEMONSTRATION
    else:
        count = sum(map(len, steps)) / len(steps)
        hulls = sum(len(select) for some in steps for select in some) / len(steps)
    return _OPEN + _STEP * count + _CLICK * hulls
