"""Replace: a primitive or a template in the place of hulls."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import ClassVar, Literal, get_args

import numpy as np

from meshforge import geometry
from meshforge.common import join_names
from meshforge.geometry import Aabb, Floats, Shape, convex_hull
from meshforge.language import arguments
from meshforge.language.actions.base import Action, ActionIcon
from meshforge.language.actions.edit import GroupEdit, HullGroup
from meshforge.language.actions.misfit import find_narrow_gaps, measure_mismatch

Fit = Literal["native", "tight", "inscribed", "volume", "longest"]
Side = Literal["X", "Y", "Z"]
_LONG = ("native", "tight", "inscribed", "volume", "X", "Y", "Z", "radius")
_OPTIONS: Mapping[str, tuple[str, ...]] = {
    "box": ("tight", "inscribed", "volume"),
    "cylinder": _LONG,
    "capsule": _LONG,
    "sphere": ("native", "inscribed", "volume", "longest", "radius"),
}
_FIT_TEXTS: Mapping[Fit, str] = {
    "native": "native, around all of it",
    "tight": "tight, in any direction",
    "inscribed": "inside, the largest",
    "volume": "of the same volume",
    "longest": "longest side matched",
}
_TIGHT_FITS = {"box": geometry.tight_box, "cylinder": geometry.tight_cylinder, "capsule": geometry.tight_capsule}


_SLACK = 1e-9  # of the diagonal, against rounding


@dataclass(frozen=True, slots=True)
class Replace(Action):
    """Replaces the selected hulls of each body by a primitive or a template that fills their bounding box."""

    by_body: ClassVar[bool] = True
    key: ClassVar[str] = "R"
    icon: ClassVar[ActionIcon] = "replace"
    geometry: str = field(metadata={"argument": arguments.PrimitiveOrFileArgument(), "title": "By"})
    fit: Fit | None = field(
        default=None,
        metadata={"argument": arguments.WordArgument(get_args(Fit)), "omitted": "bounding box", "words": _FIT_TEXTS},
    )
    axis: Side | None = field(
        default=None,
        metadata={"argument": arguments.WordArgument(get_args(Side)), "title": "Along", "omitted": "by itself"},
    )
    radius: float | None = field(
        default=None,
        metadata={"argument": arguments.OptionArgument("radius", arguments.LengthArgument()), "title": "Radius [m]"},
    )
    within: float | None = field(
        default=None,
        metadata={"argument": arguments.OptionArgument("within", arguments.ShareArgument()), "title": "Only within"},
    )
    clear: bool = field(
        default=False, metadata={"argument": arguments.FlagArgument("clear"), "title": "Only where gaps stay"}
    )

    def conflict(self) -> str | None:
        takes = ("longest",) if self.templates else _OPTIONS[self.geometry]
        given = [word for word in (self.fit, self.axis, "radius" if self.radius else None) if word]
        if wrong := next((word for word in given if word not in takes), None):
            shown = self.arguments()["geometry"].show(self.geometry)
            return f"Replace({shown}) takes {arguments.join_alternatives(takes)}, not {wrong}"
        if self.axis and self.fit == "tight":
            return f"{self.axis} does not go with tight, which finds its own direction"
        return f"radius does not go with {self.fit}, which finds its own" if self.radius and self.fit else None

    @property
    def templates(self) -> tuple[str, ...]:
        return () if self.geometry in arguments.PRIMITIVES else (self.geometry,)

    @property
    def depends_on_frame(self) -> bool:
        is_free = self.axis is None and self.fit in ("tight", "volume")
        return not is_free and (self.geometry, self.fit) not in (("sphere", "native"), ("sphere", "inscribed"))

    def edit(self, group: HullGroup) -> GroupEdit:
        if self.templates:
            shapes, note = fit_template(group, self.geometry, turned=self.fit == "longest"), None
        else:
            shape = fit_primitive(group, self)
            shapes, note = (shape,), _note_on_fit(group, self, shape)
        why = _find_mismatch(group, shapes, self)
        if why is None:
            return GroupEdit.insert(shapes, group, note=note)
        names, verb = join_names([hull.name for hull in group.hulls], 3), "stay" if group.hulls[1:] else "stays"
        return GroupEdit(removes=False, note=f"{names} {verb}: {why}", fits=False)

    def phrase(self, whose: str) -> str:
        within = f"its surface is within {arguments.show_number(self.within)} of the diagonal" if self.within else ""
        conditions = " and ".join(filter(None, [within, "no gap to another hull shrinks" if self.clear else ""]))
        return f"replaced by {_describe_substitute(self, whose)}{conditions and f', where {conditions}'}"


def _find_mismatch(group: HullGroup, shapes: Sequence[Shape], action: Replace) -> str | None:
    """Why a group stays, as what would replace it does not meet the conditions of the action; None where it does."""
    if action.within is not None:
        most = action.within * group.length
        found = measure_mismatch(shapes, [hull.shape for hull in group.hulls])
        if found > most + _SLACK * group.length:
            return f"their surfaces would be {found:.3g} m apart, more than {most:.3g} m"
    if action.clear:
        beside = [hull for hull in group.mesh.hulls if hull not in group.hulls]
        gaps = find_narrow_gaps(shapes, group.hulls, beside, group.mesh.contact_distance)
        return gaps[0].describe("it" if len(group.hulls) == 1 else "them", "would shrink") if gaps else None
    return None


def fit_primitive(group: HullGroup, action: Replace) -> Shape:
    """Return the primitive that replaces a group."""
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
    others = arguments.join_alternatives(f"Replace({action.geometry}, {word})" for word in ("native", "tight"))
    return (
        f"sides of the {action.geometry} differ by more than 1%, so it is a hull mesh "
        f"({others} makes a native {action.geometry})"
    )


def fit_template(group: HullGroup, name: str, *, turned: bool) -> tuple[Shape, ...]:
    """Return the shapes of a template, its bounding box mapped onto that of the group, axis by axis.

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


_SOLID_WORDS = {"box": "box", "cylinder": "cylinder", "capsule": "capsule", "sphere": "sphere or ellipsoid"}


def _describe_substitute(action: Replace, whose: str) -> str:
    if action.geometry not in arguments.PRIMITIVES:
        turned = " turned lengthwise and" if action.fit == "longest" else ""
        return f"“{action.geometry}”,{turned} stretched to fill {whose} bounding box"
    solid, around = _SOLID_WORDS[action.geometry], f"around {'it' if whose == 'its' else 'them'}"
    along = f", along {action.axis}" if action.axis else ""
    if action.radius:
        size = f"radius {arguments.show_number(action.radius)} m"
        return f"a {action.geometry} of {size} at the middle of {whose} bounding box{along}"
    match action.fit:
        case "tight":
            return f"the smallest {solid} {around}, at any angle"
        case "native":
            return _describe_native(action, whose, around)
        case "inscribed":
            return f"the largest {action.geometry} inside {whose} convex hull{along}"
        case "volume":
            return f"a {action.geometry} of {whose} volume{along}"
        case "longest":
            return f"a sphere as wide as the longest side of {whose} bounding box"
        case _:
            return f"a {solid} that fills {whose} bounding box{along}"


def _describe_native(action: Replace, whose: str, around: str) -> str:
    if action.geometry == "sphere":
        return f"the smallest sphere {around}"
    if action.geometry == "cylinder" and not action.axis:
        return f"the smallest cylinder {around} along X, Y or Z"
    side = action.axis or f"the longest side of {whose} bounding box"
    return f"the thinnest {action.geometry} {around}, along {side}"
