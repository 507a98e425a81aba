"""Shapes fitted to the hulls that they replace."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from meshforge.geometry import (
    Aabb,
    Floats,
    Shape,
    aabb_box,
    aabb_capsule,
    aabb_cylinder,
    aabb_sphere,
    longest_axis,
    mapped_to,
    tight_box,
    tight_capsule,
    tight_cylinder,
)
from meshforge.language.actions.edit import Group

_FILLING: Mapping[str, Callable[[Aabb], Shape]] = {
    "box": aabb_box,
    "cylinder": aabb_cylinder,
    "capsule": aabb_capsule,
    "sphere": aabb_sphere,
}
_TIGHT = {
    "box": tight_box,
    "cylinder": tight_cylinder,
    "capsule": tight_capsule,
}


def fitted_primitive(group: Group, primitive: str, *, tight: bool) -> tuple[Shape, str | None]:
    """The primitive that fills the bounding box of the group, or the smallest one around its points; with a note."""
    if tight:
        note = "round primitives were fitted by their tessellated points" if group.has_round else None
        return _TIGHT[primitive](group.points, name=group.largest.name, thicken=group.thickness), note
    shape = _FILLING[primitive](group.bounds)
    if shape.is_primitive:
        return shape, None
    return shape, f"sides of the {primitive} differ by more than 1%, so it is a hull mesh"


def fitted_template(group: Group, name: str, *, turned: bool) -> tuple[Shape, ...]:
    """The shapes of a template, its bounding box mapped onto that of the group, axis by axis.

    turned: whether its longest axis is first turned onto that of the group.
    """
    template = group.template(name)
    if not turned:
        return mapped_to(template.shapes, template.aabb, group.bounds)
    turn = _onto(longest_axis(template.aabb), longest_axis(group.bounds))
    shapes = [shape.transform(turn, np.zeros(3)) for shape in template.shapes]
    return mapped_to(shapes, Aabb.union(shape.aabb for shape in shapes), group.bounds)


def _onto(start: int, end: int) -> Floats:
    """The quarter turn (3, 3) that takes one coordinate axis to another, the identity where they are one."""
    turn = np.eye(3)
    if start != end:
        turn[[start, end]] = 0.0
        turn[end, start], turn[start, end] = 1.0, -1.0
    return turn
