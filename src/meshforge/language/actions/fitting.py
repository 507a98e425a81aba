"""Shapes fitted to the hulls that they replace."""

from __future__ import annotations

import numpy as np

from meshforge.errors import ProgramError
from meshforge.geometry import Aabb, Box, Floats, Shape
from meshforge.language.actions.edit import Group

_EQUAL = 1e-9  # sides that differ by less are equal


def fitted_primitive(group: Group, primitive: str, *, tight: bool) -> tuple[Shape, str | None]:
    """The primitive that fills the bounding box of the group, or the smallest one around its points; with a note."""
    if primitive == "box" and not tight:
        return Box.filling(group.bounds), None
    raise ProgramError(f"no fit of a {primitive} yet")


def fitted_template(group: Group, name: str, *, turned: bool) -> tuple[Shape, ...]:
    """The shapes of a template, its bounding box mapped onto that of the group, axis by axis.

    turned: whether its longest axis is first turned onto that of the group.
    """
    template = group.template(name)
    turn = _onto(longest_axis(template.aabb), longest_axis(group.bounds)) if turned else np.eye(3)
    shapes = [shape.mapped(turn, np.zeros(3)) for shape in template.shapes] if turned else template.shapes
    box = Aabb.union(shape.aabb for shape in shapes)
    factors = group.bounds.size / box.size
    offset = group.bounds.min - box.min * factors
    return tuple(shape.mapped(np.diag(factors), offset) for shape in shapes)


def longest_axis(box: Aabb) -> int:
    """The axis of the longest side; of equal ones Z, then Y, then X."""
    longest = float(box.size.max())
    return max(axis for axis in range(3) if box.size[axis] >= longest * (1 - _EQUAL))


def _onto(start: int, end: int) -> Floats:
    """The quarter turn (3, 3) that takes one coordinate axis to another, the identity where they are one."""
    turn = np.eye(3)
    if start != end:
        turn[[start, end]] = 0.0
        turn[end, start], turn[start, end] = 1.0, -1.0
    return turn
