"""The actions: Replace and Add, which insert shapes; Delete, Merge, Scale and Each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import ClassVar, Literal, get_args

import numpy as np

from meshforge import geometry, symbolic
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

Fit = Literal["native", "tight", "inscribed", "volume", "longest"]
Side = Literal["X", "Y", "Z"]
_LONG = ("native", "tight", "inscribed", "volume", "X", "Y", "Z", "radius")
_OPTIONS: Mapping[str, tuple[str, ...]] = {
    "box": ("tight", "inscribed", "volume"),
    "cylinder": _LONG,
    "capsule": _LONG,
    "sphere": ("native", "inscribed", "volume", "longest", "radius"),
}
_TIGHT_FITS = {"box": geometry.tight_box, "cylinder": geometry.tight_cylinder, "capsule": geometry.tight_capsule}


@dataclass(frozen=True, slots=True)
class Replace(base.Action):
    """Replaces the selected hulls of each body by a primitive or a template that fills their bounding box."""

    by_body: ClassVar[bool] = True
    planned: ClassVar[tuple[str, ...]] = ("within", "clear", "to")
    geometry: str = field(metadata={"argument": base.PrimitiveOrFileArgument()})
    fit: Fit | None = field(default=None, metadata={"argument": WordArgument(get_args(Fit))})
    axis: Side | None = field(default=None, metadata={"argument": WordArgument(get_args(Side))})
    radius: float | None = field(
        default=None, metadata={"argument": base.OptionArgument("radius", base.LengthArgument())}
    )

    def conflict(self) -> str | None:
        takes = ("longest",) if self.templates else _OPTIONS[self.geometry]
        given = [word for word in (self.fit, self.axis, "radius" if self.radius else None) if word]
        if wrong := next((word for word in given if word not in takes), None):
            return f"Replace({self._shown_geometry}) takes {join_alternatives(takes)}, not {wrong}"
        if self.axis and self.fit == "tight":
            return f"{self.axis} does not go with tight, which finds its own direction"
        return f"radius does not go with {self.fit}, which finds its own" if self.radius and self.fit else None

    @property
    def _shown_geometry(self) -> str:
        return self.arguments()["geometry"].show(self.geometry)

    @property
    def templates(self) -> tuple[str, ...]:
        return () if self.geometry in base.PRIMITIVES else (self.geometry,)

    @property
    def depends_on_frame(self) -> bool:
        is_free = self.axis is None and self.fit in ("tight", "volume")
        return not is_free and (self.geometry, self.fit) not in (("sphere", "native"), ("sphere", "inscribed"))

    def edit(self, group: HullGroup) -> GroupEdit:
        if self.templates:
            return GroupEdit.insert(fit_template(group, self.geometry, turned=self.fit == "longest"), group)
        shape = fit_primitive(group, self)
        return GroupEdit.insert((shape,), group, note=_note_on_fit(group, self, shape))


def fit_primitive(group: HullGroup, action: Replace) -> Shape:
    """The primitive that replaces a group."""
    shapes, bounds, primitive = [hull.shape for hull in group.hulls], group.bounds, action.geometry
    axis = _choose_axis(shapes, bounds, action)
    if action.radius is not None:
        return geometry.shape_of_radius(primitive, action.radius, bounds, axis)
    match action.fit:
        case "tight":
            return _fit_tight(group, primitive)
        case "inscribed":
            hull = convex_hull(group.points, name=group.largest.name, thicken=group.thickness)
            return geometry.inscribe(primitive, hull, axis)
        case "volume":
            is_tight = primitive != "sphere" and axis is None
            around = _fit_tight(group, primitive) if is_tight else _fit_native(shapes, bounds, primitive, axis)
            factor = (geometry.volume_of_union(shapes) / around.volume) ** (1 / 3)
            return around.transform(np.eye(3) * factor, around.centroid * (1 - factor))
        case "native":
            return _fit_native(shapes, bounds, primitive, axis)
        case "longest":
            return geometry.shape_of_radius(primitive, float(bounds.size.max()) / 2, bounds)
        case _:
            return _fill_bounds(bounds, primitive, axis)


def _choose_axis(shapes: Sequence[Shape], bounds: Aabb, action: Replace) -> int | None:
    """The axis (0, 1, 2) that is given, or along which a cylinder encloses less; None where the fit finds its own."""
    if action.axis is not None:
        return "XYZ".index(action.axis)
    finds_its_own = action.geometry != "cylinder" or action.fit in ("tight", "inscribed", "volume")
    return None if finds_its_own else geometry.find_cylinder_axis(shapes, bounds)


def _fit_tight(group: HullGroup, primitive: str) -> Shape:
    return _TIGHT_FITS[primitive](group.points, name=group.largest.name, thicken=group.thickness)


def _fit_native(shapes: Sequence[Shape], bounds: Aabb, primitive: str, axis: int | None) -> Shape:
    if primitive == "sphere":
        return geometry.native_sphere(shapes, bounds)
    fit = geometry.native_cylinder if primitive == "cylinder" else geometry.native_capsule
    return fit(shapes, bounds, axis)


def _fill_bounds(bounds: Aabb, primitive: str, axis: int | None) -> Shape:
    match primitive:
        case "box":
            return geometry.aabb_box(bounds)
        case "cylinder":
            return geometry.aabb_cylinder(bounds, axis)
        case "capsule":
            return geometry.aabb_capsule(bounds, axis)
        case _:
            return geometry.aabb_sphere(bounds)


def _note_on_fit(group: HullGroup, action: Replace, made: Shape) -> str | None:
    if action.fit in ("tight", "inscribed", "volume") and group.has_round:
        return "round primitives were fitted by their tessellated points"
    if made.is_primitive:
        return None
    others = join_alternatives(f"Replace({action.geometry}, {word})" for word in ("native", "tight"))
    return (
        f"sides of the {action.geometry} differ by more than 1%, so it is a hull mesh "
        f"({others} makes a native {action.geometry})"
    )


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

    planned: ClassVar[tuple[str, ...]] = ("to",)
    axis: Axis = field(metadata={"argument": WordArgument(AXES)})
    factor: float = field(metadata={"argument": FactorArgument()})

    def note_on(self, mesh: symbolic.SymbolicMesh, mask: int) -> str | None:
        parts = len(symbolic.split_by_contact(mesh, mask))
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
            return GroupEdit(
                tuple(NewShape(hull.shape.transform(linear, offset), hull, (hull,)) for hull in group.hulls)
            )


@dataclass(frozen=True, slots=True)
class Shrink(Action):
    """Moves the surface of each selected hull inwards by a distance."""

    distance: float = field(metadata={"argument": base.LengthArgument()})

    def edit(self, group: HullGroup) -> GroupEdit:
        return GroupEdit(
            tuple(
                NewShape(geometry.shrink(hull.shape, self.distance, hull.name), hull, (hull,)) for hull in group.hulls
            )
        )


@dataclass(frozen=True, slots=True)
class Each(Action):
    """Does the action to every connected component of the selected hulls, body by body."""

    planned: ClassVar[tuple[str, ...]] = ("by",)
    action: Action = field(metadata={"argument": ActionArgument()})

    def conflict(self) -> str | None:
        return "Each cannot stand inside Each" if isinstance(self.action, Each) else None

    def groups(self, mesh: symbolic.SymbolicMesh, mask: int) -> list[int]:
        return symbolic.split_by_contact(mesh, mask)

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
