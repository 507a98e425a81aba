"""The actions: Replace and Add, which insert shapes; Delete, Merge, Scale and Each."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import ClassVar, Literal, get_args

import numpy as np

from meshforge import geometry
from meshforge.geometry import Aabb, Floats, Shape, convex_hull
from meshforge.language.actions import base
from meshforge.language.actions.base import (
    AXES,
    Action,
    ActionArgument,
    Axis,
    FactorArgument,
    WordArgument,
    join_alternatives,
)
from meshforge.language.actions.edit import GroupEdit, HullGroup, NewShape
from meshforge.language.words import Direction
from meshforge.symbolic import SymbolicMesh, split_by_contact

_FILL_SHAPES: Mapping[str, Callable[[Aabb], Shape]] = {
    "box": geometry.aabb_box,
    "cylinder": geometry.aabb_cylinder,
    "capsule": geometry.aabb_capsule,
    "sphere": geometry.aabb_sphere,
}
_TIGHT_FITS = {"box": geometry.tight_box, "cylinder": geometry.tight_cylinder, "capsule": geometry.tight_capsule}
_NATIVE_FITS: Mapping[str, Callable[[Iterable[Shape], Aabb], Shape]] = {
    "cylinder": geometry.native_cylinder,
    "capsule": geometry.native_capsule,
    "sphere": geometry.native_sphere,
}
_FITS = (("native", _NATIVE_FITS), ("tight", _TIGHT_FITS))
Fit = Literal["native", "tight", "longest"]


@dataclass(frozen=True, slots=True)
class Replace(base.Action):
    """Replaces the selected hulls of each body by a primitive or a template that fills their bounding box."""

    by_body: ClassVar[bool] = True
    geometry: str = field(metadata={"argument": base.PrimitiveOrFileArgument()})
    fit: Fit | None = field(default=None, metadata={"argument": base.WordArgument(get_args(Fit))})

    def conflict(self) -> str | None:
        if self.fit == "native" and self.geometry == "box":
            return "native is for cylinder, capsule and sphere: a box always is a native one"
        if self.fit == "native" and self.geometry not in _NATIVE_FITS:
            return f"native is for cylinder, capsule and sphere, not {self.geometry}"
        if self.fit == "tight" and self.geometry not in _TIGHT_FITS:
            return f"tight is for box, cylinder and capsule, not {self.geometry}"
        if self.fit == "longest" and self.geometry in base.PRIMITIVES:
            return f"longest is for template files, not {self.geometry}"
        return None

    @property
    def templates(self) -> tuple[str, ...]:
        return () if self.geometry in base.PRIMITIVES else (self.geometry,)

    @property
    def depends_on_frame(self) -> bool:
        return self.fit != "tight" and (self.geometry, self.fit) != ("sphere", "native")

    def edit(self, group: HullGroup) -> GroupEdit:
        if self.templates:
            return GroupEdit.insert(fit_template(group, self.geometry, turned=self.fit == "longest"), group)
        shape, note = fit_primitive(group, self.geometry, self.fit)
        return GroupEdit.insert((shape,), group, note=note)


def fit_primitive(group: HullGroup, primitive: str, fit: Fit | None) -> tuple[Shape, str | None]:
    """The primitive that replaces a group, and a note on what a user should know.

    fit: None fills the bounding box; native: along the longest side of that box, of the least radius around the
    hulls; tight: the smallest one around their points.
    """
    if fit == "native":
        return _NATIVE_FITS[primitive]((hull.shape for hull in group.hulls), group.bounds), None
    if fit == "tight":
        note = "round primitives were fitted by their tessellated points" if group.has_round else None
        return _TIGHT_FITS[primitive](group.points, name=group.largest.name, thicken=group.thickness), note
    shape = _FILL_SHAPES[primitive](group.bounds)
    if shape.is_primitive:
        return shape, None
    others = [f"Replace({primitive}, {word})" for word, fits in _FITS if primitive in fits]
    made = f"{join_alternatives(others)} makes a native {primitive}"
    return shape, f"sides of the {primitive} differ by more than 1%, so it is a hull mesh ({made})"


def fit_template(group: HullGroup, name: str, *, turned: bool) -> tuple[Shape, ...]:
    """The shapes of a template, its bounding box mapped onto that of the group, axis by axis.

    turned: whether its longest axis is first turned onto that of the group.
    """
    template = group.template(name)
    if not turned:
        return geometry.map_to_box(template.shapes, template.aabb, group.bounds)
    turn = _quarter_turn(geometry.longest_axis(template.aabb), geometry.longest_axis(group.bounds))
    shapes = [shape.transform(turn, np.zeros(3)) for shape in template.shapes]
    return geometry.map_to_box(shapes, Aabb.union(shape.aabb for shape in shapes), group.bounds)


def _quarter_turn(start: int, end: int) -> Floats:
    """The quarter turn (3, 3) that takes one coordinate axis to another, the identity where they are one."""
    turn = np.eye(3)
    if start != end:
        turn[[start, end]] = 0.0
        turn[end, start], turn[start, end] = 1.0, -1.0
    return turn


@dataclass(frozen=True, slots=True)
class Add(base.Action):
    """Puts a template against the side of the selected hulls' bounding box, as large as fits it or at its own size."""

    by_body: ClassVar[bool] = True
    direction: Direction = field(metadata={"argument": base.DIRECTION})
    template: str = field(metadata={"argument": base.FileArgument()})
    keep: bool = field(default=False, metadata={"argument": base.FlagArgument("keep")})

    @property
    def templates(self) -> tuple[str, ...]:
        return (self.template,)

    @property
    def depends_on_frame(self) -> bool:
        return True

    def edit(self, group: HullGroup) -> GroupEdit:
        template = group.template(self.template)
        axis, sign = "XYZ".index(self.direction[1]), 1.0 if self.direction[0] == "+" else -1.0
        factor = 1.0 if self.keep else _fit_factor(template.aabb, group.bounds, axis)
        offset = _flush_offset(template.aabb, group.bounds, axis, sign, factor)
        shapes = tuple(shape.transform(np.eye(3) * factor, offset) for shape in template.shapes)
        return GroupEdit.insert(shapes, group, removes=False)


def _fit_factor(part: Aabb, bounds: Aabb, axis: int) -> float:
    """The factor that makes `part` as large as fits the side of `bounds` across `axis`."""
    across = [k for k in range(3) if k != axis]
    return float((bounds.size[across] / part.size[across]).min())


def _flush_offset(part: Aabb, bounds: Aabb, axis: int, sign: float, factor: float) -> Floats:
    """Where to move the scaled `part`, so that it touches the middle of that side from outside."""
    target = bounds.center.copy()
    target[axis] += sign * (bounds.size[axis] + part.size[axis] * factor) / 2
    return target - part.center * factor


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

    @property
    def depends_on_frame(self) -> bool:
        """Scaling about the centre of the bounding box in all directions alike moves it by little only."""
        return self.axis != "all"

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
    def depends_on_frame(self) -> bool:
        return self.action.depends_on_frame

    @property
    def makes_hulls(self) -> bool:
        return self.action.makes_hulls
