"""What a partial program selects at least and at most, however its holes are filled."""

from __future__ import annotations

from meshforge.language import Base, Diff, Intersect, Union
from meshforge.synthesis.paper.demo import Demo
from meshforge.synthesis.paper.partial import BaseHole, Hole, OpenAttach, OpenGeo, OpenJoint, Partial
from meshforge.synthesis.search.order import Joint

Bounds = tuple[int, int]
"""The hulls selected by every completion, and those selected by any, as bit sets."""


def feasible(partial: Partial, demo: Demo) -> bool:
    """Whether a completion may select what was shown, as far as bounds tell."""
    low, high = bounds(partial, demo)
    return not low & ~demo.target and not demo.target & ~high


def bounds(partial: Partial, demo: Demo) -> Bounds:
    """The bounds of a partial program on a demonstration; both are its selection where it has no holes.

    `Attach` grows with both its operands, so the bounds of these give its own; `Geo` does not grow with its base.
    """
    match partial:
        case Hole() | OpenGeo():
            return 0, demo.everything
        case OpenAttach(selected, anchor):
            (low, high), (anchor_low, anchor_high) = _base_bounds(selected, demo), _base_bounds(anchor, demo)
            return demo.attach(low, anchor_low), demo.attach(high, anchor_high)
        case OpenJoint(joint, left, right):
            return _joined(joint, bounds(left, demo), bounds(right, demo))
        case _:
            selection = demo.select(partial)
            return selection, selection


def _base_bounds(base: Base | BaseHole, demo: Demo) -> Bounds:
    return (0, demo.everything) if isinstance(base, BaseHole) else bounds(base, demo)


def _joined(joint: Joint, left: Bounds, right: Bounds) -> Bounds:
    if joint is Union:
        return left[0] | right[0], left[1] | right[1]
    if joint is Intersect:
        return left[0] & right[0], left[1] & right[1]
    assert joint is Diff
    return left[0] & ~right[1], left[1] & ~right[0]
