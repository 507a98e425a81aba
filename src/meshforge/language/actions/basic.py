"""The actions without shapes of their own: Delete, Merge, Scale, Each; and the registry of all actions by name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from meshforge.geometry import convex_hull
from meshforge.language.actions.base import AXES, Action, ActionArgument, Axis, FactorArgument, WordArgument
from meshforge.language.actions.edit import GroupEdit, HullGroup, NewShape
from meshforge.language.actions.insert import Add, Replace
from meshforge.symbolic import SymbolicMesh, split_by_contact


@dataclass(frozen=True, slots=True)
class Delete(Action):
    """Removes the selected hulls."""

    @property
    def makes_hulls(self) -> bool:
        return False

    def edit(self, group: HullGroup) -> GroupEdit:
        return GroupEdit()


@dataclass(frozen=True, slots=True)
class Merge(Action):
    """Replaces the selected hulls of each body by the convex hull of all their points; a single hull stays as it is."""

    by_body: ClassVar[bool] = True

    def edit(self, group: HullGroup) -> GroupEdit:
        if len(group.hulls) == 1:
            return GroupEdit(removes=False)
        hull = convex_hull(group.points, name=group.largest.name, thicken=group.thickness)
        note = "round primitives were merged by their tessellated points" if group.has_round else None
        return GroupEdit.insert((hull,), group, note=note)


@dataclass(frozen=True, slots=True)
class Scale(Action):
    """Scales the selected hulls as one group about the centre of their bounding box, along one axis or all."""

    axis: Axis = field(metadata={"argument": WordArgument(AXES)})
    factor: float = field(metadata={"argument": FactorArgument()})

    def edit(self, group: HullGroup) -> GroupEdit:
        factors = np.array([self.factor if self.axis in ("all", axis) else 1.0 for axis in "XYZ"])
        offset = group.bounds.center * (1.0 - factors)
        linear = np.diag(factors)
        with np.errstate(all="ignore"):  # what grows beyond all numbers is refused where made shapes are verified
            return GroupEdit(
                tuple(NewShape(hull.shape.transform(linear, offset), hull, (hull,)) for hull in group.hulls)
            )


@dataclass(frozen=True, slots=True)
class Each(Action):
    """Does the action to every connected component of the selected hulls, body by body."""

    action: Action = field(metadata={"argument": ActionArgument()})

    def conflict(self) -> str | None:
        return "Each cannot stand inside Each" if isinstance(self.action, Each) else None

    def groups(self, mesh: SymbolicMesh, mask: int) -> list[int]:
        return split_by_contact(mesh, mask)

    def edit(self, group: HullGroup) -> GroupEdit:
        return self.action.edit(group)

    @property
    def templates(self) -> tuple[str, ...]:
        return self.action.templates

    @property
    def makes_hulls(self) -> bool:
        return self.action.makes_hulls


ACTIONS: Mapping[str, type[Action]] = {kind.__name__: kind for kind in (Delete, Replace, Add, Merge, Scale, Each)}
