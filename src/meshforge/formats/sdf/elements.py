"""XML text of SDF elements: shapes, joints, masses and visuals."""

from __future__ import annotations

from typing import assert_never

import numpy as np

from meshforge.formats.kinematic_tree import LinkJoint, drop_rounding, name_moments, place_inertial
from meshforge.formats.mesh_output import LinkVisual
from meshforge.formats.xml import escape, format_numbers, nest
from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Floats, Pose, Sphere
from meshforge.symbolic import Coupling, Inertial

SdfShape = Box | Capsule | Cylinder | Ellipsoid | Sphere
"""The shapes that SDF has of its own and MeshForge knows, the round ones from 1.8 on."""
_ENDLESS = (-1e16, 1e16)
"""Limits that stand for none, which PyBullet asks for."""


def leaf(tag: str, text: str) -> bytes:
    """Return an element that holds a text."""
    return b"<%s>%s</%s>" % (tag.encode(), escape(text), tag.encode())


def _number_leaf(tag: str, number: float) -> bytes:
    return leaf(tag, format_numbers([number]))


def pose_leaf(pose: Pose) -> bytes:
    """Return the element of a pose, its numbers in full precision."""
    return leaf("pose", format_numbers([*pose.translation, *pose.to_rpy()]))


def native_lines(shape: SdfShape) -> list[bytes]:
    """Return the lines of the element of a native shape, without its pose."""
    match shape:
        case Box():
            inside = [leaf("size", format_numbers(2 * shape.half))]
        case Ellipsoid():
            inside = [leaf("radii", format_numbers(shape.radii))]
        case Sphere():
            inside = [_number_leaf("radius", shape.radius)]
        case Cylinder() | Capsule():
            inside = [_number_leaf("radius", shape.radius), _number_leaf("length", 2 * shape.half_length)]
        case _:
            assert_never(shape)
    return nest(shape.kind, *inside)


def mesh_lines(reference: str, scale: Floats | None = None) -> list[bytes]:
    """Return the lines of the element of a mesh file in metres."""
    scaled = [] if scale is None else [leaf("scale", format_numbers(scale))]
    return nest("mesh", leaf("uri", reference), *scaled)


def joint_lines(made: LinkJoint, parent: str, child: str, coupling: Coupling | None = None) -> list[bytes]:
    """Return the lines of a `<joint>`, whose frame is that of its child; coupling: to another joint, from 1.11 on."""
    joint = made.joint
    kind = joint.kind if joint else "fixed"
    inside = [leaf("parent", parent), leaf("child", child)]
    if joint and kind in ("revolute", "prismatic"):
        lower, upper = joint.limits or _ENDLESS
        most = (("effort", joint.effort), ("velocity", joint.velocity))
        losses = (("damping", joint.damping), ("friction", joint.friction))
        limit = [_number_leaf("lower", lower), _number_leaf("upper", upper)]
        limit += [_number_leaf(tag, number) for tag, number in most if number]
        dynamics = [_number_leaf(tag, number) for tag, number in losses if number]
        axis = [leaf("xyz", format_numbers(drop_rounding(made.axis))), *nest("limit", *limit)]
        mimic = []
        if coupling:
            offset, factor = coupling.coefficients
            numbers = (("multiplier", factor), ("offset", offset), ("reference", 0.0))
            inside_mimic = (_number_leaf(tag, number) for tag, number in numbers)
            mimic = nest("mimic", *inside_mimic, joint=coupling.joint, axis="axis")
        inside += nest("axis", *axis, *(nest("dynamics", *dynamics) if dynamics else []), *mimic)
    return nest("joint", *inside, name=made.name, type=kind)


def inertial_lines(inertial: Inertial, root_t_link: Pose) -> list[bytes]:
    """Return the lines of an `<inertial>`, its axes those of the link."""
    centre, tensor = place_inertial(inertial, root_t_link)
    moments = nest("inertia", *(_number_leaf(name, value) for name, value in name_moments(tensor)))
    return nest("inertial", pose_leaf(Pose.of_translation(centre)), _number_leaf("mass", inertial.mass), *moments)


def visual_lines(name: str, visual: LinkVisual) -> list[bytes]:
    """Return the lines of a `<visual>`."""
    if isinstance(visual.what, SdfShape):
        pose, kind = visual.what.pose, native_lines(visual.what)
    else:
        assert isinstance(visual.what, str)  # a file is made for every shape that is not native
        scale = None if np.array_equal(visual.scale, np.ones(3)) else visual.scale
        pose, kind = visual.pose, mesh_lines(visual.what, scale)
    inside = [pose_leaf(pose), *nest("geometry", *kind)]
    if visual.rgba:
        color = format_numbers(visual.rgba)
        inside += nest("material", leaf("ambient", color), leaf("diffuse", color))
        inside += [_number_leaf("transparency", 1 - visual.rgba[3])] if visual.rgba[3] < 1 else []
    return nest("visual", *inside, name=name)
