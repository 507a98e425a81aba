"""Scale."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from meshforge.language.actions.arguments import AXES, Axis, Factor, Words
from meshforge.language.actions.base import Action
from meshforge.language.actions.edit import Edit, Group, Made


@dataclass(frozen=True, slots=True)
class Scale(Action):
    """Scales the selected hulls as one group about the centre of their bounding box, along one axis or all."""

    axis: Axis = field(metadata={"argument": Words(AXES)})
    factor: float = field(metadata={"argument": Factor()})

    def edit(self, group: Group) -> Edit:
        factors = np.array([self.factor if self.axis in ("all", axis) else 1.0 for axis in "XYZ"])
        offset = group.bounds.center * (1.0 - factors)
        linear = np.diag(factors)
        with np.errstate(all="ignore"):  # what grows beyond all numbers is refused where made shapes are verified
            return Edit(tuple(Made(hull.shape.transform(linear, offset), hull, (hull,)) for hull in group.hulls))
