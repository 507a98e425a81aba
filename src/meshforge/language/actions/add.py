"""Add."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from meshforge.geometry import Aabb, Floats
from meshforge.language.actions.arguments import DIRECTION, File, Flag
from meshforge.language.actions.base import Action
from meshforge.language.actions.edit import Edit, Group
from meshforge.language.syntax import Direction


@dataclass(frozen=True, slots=True)
class Add(Action):
    """Puts a template against the side of the selected hulls' bounding box, as large as fits it or at its own size."""

    by_body: ClassVar[bool] = True
    direction: Direction = field(metadata={"argument": DIRECTION})
    template: str = field(metadata={"argument": File()})
    keep: bool = field(default=False, metadata={"argument": Flag("keep")})

    @property
    def templates(self) -> tuple[str, ...]:
        return (self.template,)

    def edit(self, group: Group) -> Edit:
        template = group.template(self.template)
        axis, sign = "XYZ".index(self.direction[1]), 1.0 if self.direction[0] == "+" else -1.0
        factor = 1.0 if self.keep else _largest_fit(template.aabb, group.bounds, axis)
        offset = _flush(template.aabb, group.bounds, axis, sign, factor)
        shapes = tuple(shape.transform(np.eye(3) * factor, offset) for shape in template.shapes)
        return Edit.insert(shapes, group, removes=False)


def _largest_fit(part: Aabb, bounds: Aabb, axis: int) -> float:
    """The factor that makes `part` as large as fits the side of `bounds` across `axis`."""
    across = [k for k in range(3) if k != axis]
    return float((bounds.size[across] / part.size[across]).min())


def _flush(part: Aabb, bounds: Aabb, axis: int, sign: float, factor: float) -> Floats:
    """Where to move the scaled `part`, so that it touches the middle of that side from outside."""
    target = bounds.center.copy()
    target[axis] += sign * (bounds.size[axis] + part.size[axis] * factor) / 2
    return target - part.center * factor
