"""Defects that are planted in the hulls of an asset; how, and where they fit, is in `defects.toml`."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from hashlib import blake2b
from itertools import product
from typing import TypeVar

import numpy as np

from meshforge.checks.goals.rooms import find_way
from meshforge.checks.grid import grid_around, voxelize_hulls
from meshforge.checks.physics.mechanism import JointTree
from meshforge.common import GeometryError
from meshforge.geometry import Aabb, Box, Floats, Polytope, Pose, Shape, Sphere, convex_hull, distance, rotation_about
from meshforge.geometry.solids import cut
from meshforge.symbolic import Hull, Joint, SymbolicMesh

Item = TypeVar("Item")
_UP = np.array([0.0, 0.0, 1.0])
_SIDES = np.array([one for one in product((-1.0, 0.0, 1.0), repeat=3) if any(one)])


@dataclass(frozen=True, eq=False)
class Subject:
    """An asset in which a defect is planted; seed: of what decides where."""

    mesh: SymbolicMesh
    seed: str

    def shuffle(self, items: Iterable[Item], key: Callable[[Item], str]) -> list[Item]:
        """The items in the order of their digests."""
        return sorted(items, key=lambda one: blake2b(f"{self.seed}|{key(one)}".encode()).hexdigest())

    @cached_property
    def bodies(self) -> Mapping[str, list[Hull]]:
        """The hulls of each body that has some, shuffled."""
        names = self.shuffle({hull.body for hull in self.mesh.hulls}, str)
        return {name: [hull for hull in self.mesh.hulls if hull.body == name] for name in names}

    @cached_property
    def hulls(self) -> list[Hull]:
        """All hulls, shuffled."""
        return self.shuffle(self.mesh.hulls, lambda hull: hull.name)

    @cached_property
    def joints(self) -> list[Joint]:
        """The joints that turn or slide, shuffled."""
        joints = self.mesh.asset.mechanism.joints if self.mesh.asset else ()
        return self.shuffle((one for one in joints if one.kind in ("revolute", "prismatic")), lambda one: one.child)

    @cached_property
    def tree(self) -> JointTree:
        return JointTree.of(self.mesh)

    @property
    def size(self) -> float:
        return self.mesh.diagonal

    def find_shown_box(self, body: str) -> Aabb | None:
        """The box of what a body shows."""
        visuals = self.mesh.asset.visuals if self.mesh.asset else ()
        points = [one.vertices for one in visuals if one.body in (body, None) and len(one.faces)]
        return Aabb.of_points(np.concatenate(points)) if points else None

    def change(self, body: str, linear: Floats, offset: Floats) -> Defect:
        """The hulls of a body transformed."""
        hulls = [replace(hull, shape=hull.shape.transform(linear, offset)) for hull in self.bodies[body]]
        return self.put(hulls)

    def put(self, hulls: Sequence[Hull], gone: Iterable[str] = ()) -> Defect:
        """Hulls in place of those with their names, or new ones; gone: names of those that are deleted."""
        known, away = self.mesh.index, {*gone, *(hull.name for hull in hulls)}
        made = [replace(one, name=f"{one.name} anew", parent=one.name) if one.name in known else one for one in hulls]
        kept = [hull for hull in self.mesh.hulls if hull.name not in away]
        touched = frozenset(hull.body for hull in (*self.mesh.hulls, *made) if hull.name in away or hull in made)
        names = frozenset((*away, *(hull.name for hull in made)))
        return Defect(self.mesh.with_hulls((*kept, *made)), names, touched)


@dataclass(frozen=True, eq=False)
class Defect:
    """An asset with a defect, and the names of hulls and bodies that were changed; none where all have other names."""

    mesh: SymbolicMesh
    hulls: frozenset[str] = frozenset()
    bodies: frozenset[str] = frozenset()


Plant = Callable[[Subject], Defect | None]


def _about(linear: Floats, at: Floats) -> tuple[Floats, Floats]:
    return linear, at - linear @ at


def _box_of(hulls: Iterable[Hull]) -> Aabb:
    return Aabb.union(hull.aabb for hull in hulls)


def is_deep(shape: Shape, other: Shape, depth: float) -> bool:
    """Whether no way of that length parts two shapes."""
    if distance(shape, other) > 0:
        return False
    steps = depth * _SIDES / np.linalg.norm(_SIDES, axis=1)[:, None]
    return all(distance(shape.transform(np.eye(3), step), other) == 0 for step in steps)


def _list_other_hulls(subject: Subject, body: str) -> list[Hull]:
    """The hulls of bodies that move against one."""
    rigid = subject.tree.rigid_roots()
    return [hull for hull in subject.mesh.hulls if rigid[hull.body] != rigid[body]]


def _fill_room(subject: Subject) -> Defect | None:
    for body, hulls in subject.bodies.items():
        if len(hulls) < 2 or not subject.find_shown_box(body):
            continue
        try:
            whole = convex_hull(np.concatenate([hull.vertices for hull in hulls]))
        except GeometryError:
            continue
        grid = grid_around(whole.aabb)
        free = voxelize_hulls(grid, [whole]) & ~voxelize_hulls(grid, [hull.shape for hull in hulls])
        if free.sum() * grid.cell**3 >= 0.01 * np.prod(_box_of(subject.mesh.hulls).size):
            return subject.put([replace(hulls[0], shape=whole)], [hull.name for hull in hulls[1:]])
    return None


def _plug_opening(subject: Subject) -> Defect | None:
    for body, hulls in subject.bodies.items():
        ways = [way for axis in range(3) if (way := find_way(hulls, axis))] if subject.find_shown_box(body) else []
        if ways:
            way = max(ways, key=lambda one: float(one.size[1] * one.size[2]))
            if 2 * way.size[1:].min() >= 0.03 * subject.size:
                at = way.at + way.axes[:, 0] * way.size[0] / 2
                plug = Box(Pose(way.axes, at), way.size * np.array([0.5, 1.0, 1.0]))
                return subject.put([Hull("plug", body, plug)])
    return None


def _jam_at_rest(subject: Subject) -> Defect | None:
    for joint in subject.joints:
        hulls, others = subject.bodies.get(joint.child, []), _list_other_hulls(subject, joint.child)
        if hulls:
            planted = subject.change(joint.child, *_about(1.25 * np.eye(3), _box_of(hulls).center))
            for hull in hulls:
                grown = planted.mesh.hull_of(f"{hull.name} anew").shape
                for other in others:
                    if is_deep(grown, other.shape, 0.02 * subject.size) and distance(hull.shape, other.shape) > 0:
                        return planted
    return None


def move(joint: Joint, shape: Shape, way: float, axis: Floats | None = None) -> Shape:
    """A shape that a joint has moved by so much; axis: another one for the joint's."""
    along = joint.axis if axis is None else axis
    if joint.kind == "prismatic":
        return shape.transform(np.eye(3), way * along)
    return shape.transform(*_about(rotation_about(along, way), joint.anchor))


def _jam_on_its_way(subject: Subject) -> Defect | None:
    half = 0.015 * subject.size
    for joint in subject.joints:
        below = set(subject.tree.list_below(joint.child))
        moving = [hull for hull in subject.mesh.hulls if hull.body in below]
        if joint.limits is None or joint.parent not in subject.bodies:
            continue
        for hull in subject.shuffle(moving, lambda one: one.name):
            at = move(joint, hull.shape, sum(joint.limits) / 2).centroid
            stone = Box(Pose.of_translation(at), np.full(3, half))
            if all(distance(stone, other.shape) > 0.005 * subject.size for other in subject.mesh.hulls):
                return subject.put([Hull("stone", joint.parent, stone)])
    return None


def _shift(subject: Subject) -> Defect | None:
    for body, hulls in subject.bodies.items():
        if subject.find_shown_box(body):
            way = np.zeros(3)
            way[int(_box_of(hulls).size.argmax())] = 0.08 * subject.size
            return subject.change(body, np.eye(3), way)
    return None


def _turn(subject: Subject) -> Defect | None:
    for body, hulls in subject.bodies.items():
        box = _box_of(hulls)
        least, most = sorted(box.size[:2])
        if subject.find_shown_box(body) and most - least >= max(0.25 * most, 0.05 * subject.size):
            return subject.change(body, *_about(rotation_about(_UP, np.pi / 2), box.center))
    return None


def _mirror(subject: Subject) -> Defect | None:
    for body, hulls in subject.bodies.items():
        box, linear = _box_of(hulls), np.eye(3)
        axis = int(box.size.argmax())
        linear[axis, axis] = -1.0
        planted = subject.change(body, *_about(linear, box.center))
        both = (hulls, [hull for hull in planted.mesh.hulls if hull.body == body])
        points = [np.concatenate([hull.vertices for hull in some]) for some in both]
        reach = [(one @ _SIDES.T / np.linalg.norm(_SIDES, axis=1)).max(axis=0) for one in points]
        if subject.find_shown_box(body) and np.abs(reach[0] - reach[1]).max() >= 0.03 * subject.size:
            return planted
    return None


def _scale_body(factor: float) -> Plant:
    def plant(subject: Subject) -> Defect | None:
        for body, hulls in subject.bodies.items():
            if subject.find_shown_box(body):
                return subject.change(body, *_about(factor * np.eye(3), _box_of(hulls).center))
        return None

    return plant


def _stretch_hull(subject: Subject) -> Defect | None:
    for hull in subject.hulls:
        box, shown, linear = hull.aabb, subject.find_shown_box(hull.body), np.eye(3)
        linear[int(box.size.argmax()), int(box.size.argmax())] = 1.6
        long = hull.shape.transform(*_about(linear, box.center))
        if shown and max((shown.min - long.aabb.min).max(), (long.aabb.max - shown.max).max()) >= 0.04 * subject.size:
            return subject.put([replace(hull, shape=long)])
    return None


def _miss_hull(subject: Subject) -> Defect | None:
    for hull in subject.hulls:
        others = [other.shape for other in subject.mesh.hulls if other is not hull]
        shown = subject.mesh.asset.visuals if subject.mesh.asset else ()
        seen = [one.vertices for one in shown if one.body in (hull.body, None) and len(one.vertices)]
        if not seen or not others:
            continue
        points = np.concatenate(seen)
        for corner in hull.vertices:
            near = np.linalg.norm(points - corner, axis=1).min() <= 0.01 * subject.size
            ball = Sphere(Pose.of_translation(corner), 1e-4 * subject.size)
            if near and min(distance(ball, other) for other in others) >= 0.04 * subject.size:
                return subject.put([], [hull.name])
    return None


def _miss_body(subject: Subject) -> Defect | None:
    for body, hulls in subject.bodies.items():
        if len(subject.bodies) > 1 and subject.find_shown_box(body):
            return subject.put([], [hull.name for hull in hulls])
    return None


def _float_hull(subject: Subject) -> Defect | None:
    for hull in subject.hulls:
        own = subject.bodies[hull.body]
        way = hull.shape.centroid - _box_of(own).center
        if len(own) < 2 or not np.linalg.norm(way):
            continue
        way, others = way / np.linalg.norm(way), [other.shape for other in subject.mesh.hulls if other is not hull]
        for far in np.arange(0.1, 2.0, 0.05) * subject.size:
            there = hull.shape.transform(np.eye(3), far * way)
            if all(distance(there, other) >= 0.1 * subject.size for other in others):
                return subject.put([replace(hull, shape=there)])
    return None


def _double_hull(subject: Subject) -> Defect | None:
    hull = subject.hulls[0]
    planted = subject.put([replace(hull, name="again")])
    return replace(planted, hulls=planted.hulls | {hull.name})


def _put_hull_within(subject: Subject) -> Defect | None:
    hull = subject.hulls[0]
    return subject.put([Hull("within", hull.body, _half(hull))])


def _half(hull: Hull) -> Shape:
    return hull.shape.transform(*_about(0.5 * np.eye(3), hull.shape.centroid))


def _press_flat(subject: Subject) -> Defect | None:
    hull, linear = subject.hulls[0], np.eye(3)
    thin = int(hull.aabb.size.argmin())
    linear[thin, thin] = 0.001
    flat = hull.shape.tessellate().transform(*_about(linear, hull.shape.centroid))
    return subject.put([replace(hull, shape=flat)])


def _dent(subject: Subject) -> Defect | None:
    hull = subject.hulls[0].shape.tessellate()
    corners = hull.vertices[hull.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    largest = int(np.linalg.norm(normals, axis=1).argmax())
    normal = normals[largest] / np.linalg.norm(normals[largest])
    depth = float((hull.vertices @ normal).max() - (hull.vertices @ normal).min()) / 3
    pit, (a, b, c), new = corners[largest].mean(axis=0) - depth * normal, hull.faces[largest], len(hull.vertices)
    rest = np.delete(hull.faces, largest, axis=0)
    faces = np.concatenate([rest, [[a, b, new], [b, c, new], [c, a, new]]])
    return subject.put([replace(subject.hulls[0], shape=Polytope(np.vstack([hull.vertices, pit]), faces))])


def _topple(subject: Subject) -> Defect | None:
    box = _box_of(subject.mesh.hulls)
    if len(subject.bodies) > 1:
        return None
    middles = {hull.name: hull.shape.centroid for hull in subject.mesh.hulls}
    for axis, sign in subject.shuffle(product((0, 1), (-1.0, 1.0)), str):
        gone = [name for name, at in middles.items() if sign * (at - box.center)[axis] > 0 and at[2] < box.center[2]]
        left = [hull for hull in subject.mesh.hulls if hull.name not in gone]
        if not gone or not left:
            continue
        centre = sum(hull.volume * hull.shape.centroid for hull in left) / sum(hull.volume for hull in left)
        low = min(hull.aabb.min[2] for hull in left)
        foot = np.concatenate([hull.vertices[hull.vertices[:, 2] < low + 0.01 * subject.size] for hull in left])
        if sign * (centre - box.center)[axis] > max(sign * (foot[:, axis] - box.center[axis])):
            return subject.put([], gone)
    return None


def _lay_on_its_side(subject: Subject) -> Defect | None:
    for hull in subject.hulls:
        shape = hull.shape
        if shape.kind in ("cylinder", "capsule") and subject.find_shown_box(hull.body):
            pose = shape.pose  # type: ignore[attr-defined]  # both kinds have one
            along, across = (float(np.ptp(shape.vertices @ pose.rotation[:, k])) for k in (2, 0))
            if abs(along - across) >= max(0.25 * max(along, across), 0.04 * subject.size):
                turned = shape.transform(*_about(rotation_about(pose.rotation[:, 0], np.pi / 2), shape.centroid))
                return subject.put([replace(hull, shape=turned)])
    return None


def _make_too_fine(subject: Subject) -> Defect | None:
    hull, k = subject.hulls[0], np.arange(500)
    height, turned = 1 - (2 * k + 1) / 500, np.pi * (1 + 5**0.5) * k
    ball = np.stack([np.cos(turned), np.sin(turned), height], axis=1)
    ball[:, :2] *= np.sqrt(1 - height**2)[:, None]
    radius = (0.75 * hull.volume / np.pi) ** (1 / 3)
    return subject.put([replace(hull, shape=convex_hull(hull.shape.centroid + radius * ball))])


DEFECTS: Mapping[str, Plant] = {
    "filled room": _fill_room,
    "plugged opening": _plug_opening,
    "jammed at rest": _jam_at_rest,
    "jammed on its way": _jam_on_its_way,
    "shifted collider": _shift,
    "turned collider": _turn,
    "mirrored collider": _mirror,
    "collider too large": _scale_body(1.3),
    "collider too small": _scale_body(0.7),
    "hull beyond the visual": _stretch_hull,
    "missing hull": _miss_hull,
    "body without hulls": _miss_body,
    "floating hull": _float_hull,
    "hull twice": _double_hull,
    "hull within a hull": _put_hull_within,
    "flat hull": _press_flat,
    "dented hull": _dent,
    "falls over": _topple,
    "primitive on its side": _lay_on_its_side,
    "too many vertices": _make_too_fine,
}
"""By the names of the plan; those of files are in `files`."""


def _turn_order(subject: Subject) -> Defect:
    return Defect(subject.put(subject.mesh.hulls[::-1]).mesh)


def _cut_in_two(subject: Subject) -> Defect | None:
    hull = max(subject.mesh.hulls, key=lambda one: one.volume)
    normal = np.eye(3)[int(hull.aabb.size.argmax())]
    halves = cut(hull.shape, hull.aabb.center, normal)
    if halves[0] is None or halves[1] is None:
        return None
    planted = subject.put([replace(hull, shape=halves[0]), Hull("other half", hull.body, halves[1])])
    return Defect(planted.mesh)


def _transform_all(change: Callable[[Hull], Shape]) -> Plant:
    def plant(subject: Subject) -> Defect:
        planted = subject.put([replace(hull, shape=change(hull)) for hull in subject.mesh.hulls])
        return Defect(planted.mesh)

    return plant


def _round(hull: Hull) -> Shape:
    if not isinstance(hull.shape, Polytope):
        return hull.shape
    return Polytope(hull.vertices.astype(np.float32).astype(float), hull.faces)


HARMLESS: Mapping[str, Plant] = {
    "other order": _turn_order,
    "cut in two": _cut_in_two,
    "rounded": _transform_all(_round),
    "a little smaller": _transform_all(
        lambda hull: hull.shape.transform(*_about(0.995 * np.eye(3), hull.shape.centroid))
    ),
}
