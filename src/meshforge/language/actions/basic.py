"""The actions besides Replace: Add, Delete, Merge, Scale, Shrink and Each."""

from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from meshforge import geometry
from meshforge.common import Plugin
from meshforge.geometry import Aabb, Floats, convex_hull
from meshforge.language import arguments
from meshforge.language.actions.base import AXES, Action, ActionArgument, ActionIcon, Axis
from meshforge.language.actions.edit import GroupEdit, HullGroup, NewShape
from meshforge.language.words import DIRECTIONS, Direction
from meshforge.symbolic import SymbolicMesh, split_by_contact


@dataclass(frozen=True, slots=True)
class Add(Action):
    """Puts a template against the side of the selected hulls' bounding box, as large as fits it or at its own size."""

    by_body: ClassVar[bool] = True
    key: ClassVar[str] = "Shift+A"
    icon: ClassVar[ActionIcon] = "add"
    direction: Direction = field(
        metadata={"argument": arguments.WordArgument(DIRECTIONS, "direction"), "title": "At the side"}
    )
    template: str = field(metadata={"argument": arguments.FileArgument()})
    keep: bool = field(
        default=False, metadata={"argument": arguments.FlagArgument("keep"), "title": "Keep the template's own size"}
    )

    @classmethod
    def title(cls) -> str:
        return "Add a template beside the selection"

    @property
    def templates(self) -> tuple[str, ...]:
        return (self.template,)

    @property
    def depends_on_frame(self) -> bool:
        return True

    def edit(self, group: HullGroup) -> GroupEdit:
        template = group.template(self.template)
        axis, sign = "XYZ".index(self.direction[1]), 1.0 if self.direction[0] == "+" else -1.0
        across = [k for k in range(3) if k != axis]
        factor = 1.0 if self.keep else float((group.bounds.size[across] / template.aabb.size[across]).min())
        offset = _flush_offset(template.aabb, group.bounds, axis, sign, factor)
        shapes = tuple(shape.transform(np.eye(3) * factor, offset) for shape in template.shapes)
        return GroupEdit.insert(shapes, group, removes=False)

    def phrase(self, whose: str) -> str:
        size = "in its own size" if self.keep else "as large as fits"
        return f"given “{self.template}” at {whose} {self.direction} side, {size}"


def _flush_offset(part: Aabb, bounds: Aabb, axis: int, sign: float, factor: float) -> Floats:
    """Where to move the scaled `part`, so that it touches the middle of that side from outside."""
    target = bounds.center.copy()
    target[axis] += sign * (bounds.size[axis] + part.size[axis] * factor) / 2
    return target - part.center * factor


@dataclass(frozen=True, slots=True)
class Delete(Action):
    """Removes the selected hulls."""

    key: ClassVar[str] = "X"
    icon: ClassVar[ActionIcon] = "delete"

    @property
    def makes_hulls(self) -> bool:
        return False

    def edit(self, group: HullGroup) -> GroupEdit:
        return GroupEdit()

    def phrase(self, whose: str) -> str:
        return "deleted"


@dataclass(frozen=True, slots=True)
class Merge(Action):
    """Replaces the selected hulls of each body by the convex hull of all their points; a single hull stays as it is."""

    by_body: ClassVar[bool] = True
    key: ClassVar[str] = "M"
    icon: ClassVar[ActionIcon] = "merge"

    def edit(self, group: HullGroup) -> GroupEdit:
        if len(group.hulls) == 1:
            return GroupEdit(removes=False)
        hull = convex_hull(group.points, name=group.largest.name, thicken=group.thickness)
        note = "round primitives were merged by their tessellated points" if group.has_round else None
        return GroupEdit.insert((hull,), group, note=note)

    def phrase(self, whose: str) -> str:
        return "merged into one convex hull"


@dataclass(frozen=True, slots=True)
class Scale(Action):
    """Scales the selected hulls as one group about the centre of their bounding box, along one axis or all."""

    key: ClassVar[str] = "S"
    icon: ClassVar[ActionIcon] = "scale"
    axis: Axis = field(
        metadata={"argument": arguments.WordArgument(AXES), "title": "Along", "words": {"all": "all axes"}}
    )
    factor: float = field(metadata={"argument": arguments.FactorArgument()})

    def note_on(self, mesh: SymbolicMesh, mask: int) -> str | None:
        parts = len(split_by_contact(mesh, mask))
        if parts < 2:
            return None
        moved = f"{parts} parts that do not touch were scaled as one group, which moves them"
        return f"{moved} (Each({self}) scales each in place)"

    @property
    def depends_on_frame(self) -> bool:
        """Scaling about the centre of the bounding box in all directions alike moves it by little only."""
        return self.axis != "all"

    def edit(self, group: HullGroup) -> GroupEdit:
        factors = np.array([self.factor if self.axis in ("all", axis) else 1.0 for axis in "XYZ"])
        offset = group.bounds.center * (1.0 - factors)
        linear = np.diag(factors)
        with np.errstate(all="ignore"):  # what grows beyond all numbers is refused where made shapes are verified
            return GroupEdit(tuple(NewShape(one.shape.transform(linear, offset), one, (one,)) for one in group.hulls))

    def phrase(self, whose: str) -> str:
        where = "in every direction" if self.axis == "all" else f"along {self.axis}"
        return f"scaled by {arguments.show_number(self.factor)} {where}, about {whose} common centre"


@dataclass(frozen=True, slots=True)
class Shrink(Action):
    """Moves the surface of each selected hull inwards by a distance."""

    key: ClassVar[str] = "Shift+S"
    icon: ClassVar[ActionIcon] = "shrink"
    distance: float = field(metadata={"argument": arguments.LengthArgument(), "title": "By [m]"})

    def edit(self, group: HullGroup) -> GroupEdit:
        return GroupEdit(
            tuple(NewShape(geometry.shrink(one.shape, self.distance, one.name), one, (one,)) for one in group.hulls)
        )

    def phrase(self, whose: str) -> str:
        return f"made smaller all round by {arguments.show_number(self.distance)} m"


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
    def plugin(self) -> Plugin | None:
        return self.action.plugin

    @property
    def templates(self) -> tuple[str, ...]:
        return self.action.templates

    @property
    def depends_on_frame(self) -> bool:
        return self.action.depends_on_frame

    @property
    def makes_hulls(self) -> bool:
        return self.action.makes_hulls
