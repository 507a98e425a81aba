"""Objects that are put somewhere: boxes and balls that stay on a surface, one that stays in a cavity, and a probe that
goes through an opening."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import mujoco
import numpy as np

from meshforge.checks.physics.scene import (
    BREAKS_DOWN,
    Failure,
    Place,
    Touch,
    add_hulls,
    add_object,
    advance,
    blank,
    calm,
    collide,
    deepest,
    mm,
    place,
    step_for,
)
from meshforge.geometry import Box, Capsule, Cylinder, Floats, Pose, Shape, Sphere
from meshforge.symbolic import Hull

ObjectShape = Literal["box", "sphere", "cylinder"]
ProbeShape = Literal["box", "sphere"]

_LOOK, _SOONEST = 0.05, 0.24  # [s]
_ON_SECONDS, _IN_SECONDS = 1.5, 1.0
SPOTS = ((0.0, 0.0), (0.6, 0.6), (-0.6, 0.6), (-0.6, -0.6), (0.6, -0.6))
"""Where on a surface things are put, in its halves."""
_UNEVEN = 0.2  # of the radius: objects are let down from so high, and may lie so far from the surface's height


@dataclass(frozen=True, eq=False, slots=True)
class FreeObject:
    """A shape about the origin that is put at a spot (3,) [m] with some axes (3, 3); radius: how far it may go [m]."""

    name: str
    shape: Shape
    spot: Floats
    axes: Floats
    radius: float

    @property
    def there(self) -> Shape:
        """The shape where it is put."""
        return self.shape.move(Pose(self.axes, self.spot))


def objects_on(name: str, surface: Place) -> list[FreeObject]:
    """Return five boxes and five balls on a surface; size: two half sides, and the radius of the balls [m]."""
    long, wide, radius = surface.size
    rows = []
    for k, (x, y) in enumerate(SPOTS, 1):
        spot = surface.at + surface.axes @ np.array([x * long, y * wide, 0.0])
        box, ball = Box(Pose.identity(), np.full(3, 1.5 * radius)), Sphere(Pose.identity(), radius)
        rows += [
            FreeObject(f"{name}, {word} {k}", shape, spot, surface.axes, radius)
            for word, shape in (("box", box), ("ball", ball))
        ]
    return rows


def try_support(hulls: Sequence[Hull], objects: Sequence[FreeObject], touching: float) -> Failure | None:
    """Return which object does not lie on a surface where it should, None where all do.

    objects: whose spots are on surfaces; touching: how deep things may be in each other [m].
    """
    model = _build_scene(hulls, objects, min(one.radius for one in objects))
    data = mujoco.MjData(model)
    for one in objects:
        up = float(one.shape.aabb.max[2]) + touching + _UNEVEN * one.radius
        place(model, data, one.name, one.spot + np.array([0.0, 0.0, up]), one.axes)
    if touch := _find_touch(model, data, touching):
        return _fail(f"{touch.mover}: {touch.other} is {mm(touch.depth)} in it from the start", objects, hulls, touch)
    return _watch(model, data, _ON_SECONDS, lambda: _find_gone(data, objects)) or _find_off(data, objects, touching)


def try_contain(
    hulls: Sequence[Hull], places: Mapping[str, Place], shape: ObjectShape, touching: float
) -> Failure | None:
    """Return why an object does not stay in a cavity, None where it does: what it is in at first, or how far it moves.

    places: by name; size: half extents of the object [m].
    """
    objects = [
        FreeObject(name, _shape_in(where, shape), where.at, where.axes, min(where.size))
        for name, where in places.items()
    ]
    model = _build_scene(hulls, objects, min(one.radius for one in objects))
    data = mujoco.MjData(model)
    for one in objects:
        place(model, data, one.name, one.spot, one.axes)
    if touch := _find_touch(model, data, touching):
        text = f"{touch.mover}: {touch.other} is {mm(touch.depth)} in the object from the start"
        return _fail(text, objects, hulls, touch)
    return _watch(model, data, _IN_SECONDS, lambda: _find_moved(data, objects))


def try_pass(hulls: Sequence[Hull], ways: Mapping[str, Place], shape: ProbeShape, touching: float) -> Failure | None:
    """Return which hull is in the way of a probe, and how deep, None where none is.

    ways: by name; from `at` along the first axis; size: the length, and half extents of the probe across [m]. All that
    the probe sweeps is one convex body, tried at once: a box, or a capsule.
    """
    objects = [
        FreeObject(name, _sweep(way, shape), way.at + way.axes[:, 0] * way.size[0] / 2, way.axes, 0.0)
        for name, way in ways.items()
    ]
    model = _build_scene(hulls, objects)
    data = mujoco.MjData(model)
    for one in objects:
        place(model, data, one.name, one.spot, one.axes)
    touch = _find_touch(model, data, touching)
    text = f"{touch.mover}: {touch.other} is {mm(touch.depth)} in the way" if touch else ""
    return _fail(text, objects, hulls, touch) if touch else None


def _build_scene(hulls: Sequence[Hull], objects: Sequence[FreeObject], size: float | None = None) -> Any:
    spec = blank() if size is None else blank(step_for(size))
    add_hulls(spec, spec.worldbody, hulls)
    for one in objects:
        add_object(spec, one.name, one.shape)
    return spec.compile()


def _find_touch(model: Any, data: Any, least: float) -> Touch | None:
    collide(model, data)
    return deepest(model, data, least)


def _fail(text: str, objects: Sequence[FreeObject], hulls: Sequence[Hull], touch: Touch) -> Failure:
    shown = tuple(one.there for one in objects if one.name == touch.mover)
    return Failure(text, touch.names(hulls), shown)


def _shape_in(where: Place, shape: ObjectShape) -> Shape:
    x, y, z = where.size
    if shape == "box":
        return Box(Pose.identity(), np.array(where.size))
    return Sphere(Pose.identity(), min(x, y, z)) if shape == "sphere" else Cylinder(Pose.identity(), min(x, y), z)


def _sweep(way: Place, shape: ProbeShape) -> Shape:
    """What the probe sweeps, about the middle of its way, the way along X."""
    length, wide, high = way.size
    if shape == "box":
        return Box(Pose.identity(), np.array([length / 2, wide, high]))
    return Capsule(Pose.from_rpy((0, 0, 0), (0.0, np.pi / 2, 0.0)), wide, length / 2)


def _watch(model: Any, data: Any, seconds: float, find_loss: Callable[[], Failure | None]) -> Failure | None:
    """Simulate until all is at rest, something is lost, or time is up."""
    while data.time < seconds:
        if not advance(model, data, _LOOK):
            return Failure(BREAKS_DOWN)
        if loss := find_loss():
            return loss
        if data.time > _SOONEST and calm(data):
            break
    return None


def _find_gone(data: Any, objects: Sequence[FreeObject]) -> Failure | None:
    """An object that left its spot on a surface."""
    for one in objects:
        way = float(np.linalg.norm((data.body(one.name).xpos - one.spot)[:2]))
        if way > one.radius:
            text = f"{one.name} goes away by {mm(way)} within {data.time:.2f} s, its radius {mm(one.radius)}"
            return Failure(text, objects=(one.there,))
    return None


def _find_off(data: Any, objects: Sequence[FreeObject], touching: float) -> Failure | None:
    """An object that lies at another height than the surface."""
    for one in objects:
        high = float(data.body(one.name).xpos[2] - one.spot[2] - one.shape.aabb.max[2])
        if abs(high) > touching + _UNEVEN * one.radius:
            where = "above" if high > 0 else "below"
            return Failure(f"{one.name} lies {mm(abs(high))} {where} the surface", objects=(one.there,))
    return None


def _find_moved(data: Any, objects: Sequence[FreeObject]) -> Failure | None:
    """An object that moved in its cavity by more than its half."""
    for one in objects:
        way = float(np.linalg.norm(data.body(one.name).xpos - one.spot))
        if way >= one.radius:
            text = f"{one.name}: the object, {mm(one.radius)} in half, moves by {mm(way)} within {data.time:.2f} s"
            return Failure(text, objects=(one.there,))
    return None
