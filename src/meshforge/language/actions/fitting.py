"""Shapes fitted to the hulls that they replace."""

from __future__ import annotations

import numpy as np

from meshforge.errors import ProgramError
from meshforge.geometry import Box, Shape
from meshforge.language.actions.edit import Group


def fitted_primitive(group: Group, primitive: str, *, tight: bool) -> tuple[Shape, str | None]:
    """The primitive that fills the bounding box of the group, or the smallest one around its points; with a note."""
    if primitive == "box" and not tight:
        return Box.filling(group.bounds), None
    raise ProgramError(f"no fit of a {primitive} yet")


def fitted_template(group: Group, name: str, *, turned: bool) -> tuple[Shape, ...]:
    """The shapes of a template, its bounding box mapped onto that of the group, axis by axis."""
    template = group.template(name)
    factors = group.bounds.size / template.aabb.size
    offset = group.bounds.min - template.aabb.min * factors
    return tuple(shape.mapped(np.diag(factors), offset) for shape in template.shapes)
