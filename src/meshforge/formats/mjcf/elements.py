"""XML text of MJCF elements: geoms, joints and masses."""

from collections.abc import Iterable
from typing import assert_never

import numpy as np

from meshforge.formats.kinematic_tree import drop_rounding, place_inertial
from meshforge.formats.xml import format_numbers, tag
from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Floats, Pose, Sphere, principal_axes
from meshforge.symbolic import Inertial, Joint

MjcfShape = Box | Capsule | Cylinder | Ellipsoid | Sphere
"""The shapes that MuJoCo has of its own."""

_TYPES = {"revolute": "hinge", "prismatic": "slide", "ball": "ball"}

LEAST_MASS = 1e-9
"""The least mass [kg] that a moving body is left with."""
_LEAST_MOMENT = 1e-14  # [kg m^2]; MuJoCo refuses less than 1e-15
_LIGHT_MOMENT = 1e-9  # [kg m^2], that of LIGHT about 3 cm away
_SLIGHT = 1e-6  # of the largest moment, by which two may fall short of the third through rounding


def exclude_tag(first: str, second: str) -> bytes:
    """Return the element that keeps two bodies from contact."""
    return tag("exclude", {"body1": first, "body2": second})


def geom_attributes(shape: MjcfShape) -> dict[str, str]:
    """Return type, size and pose of a native shape, in the frame in which the shape is."""
    match shape:
        case Box():
            size: Iterable[float] = shape.half
        case Ellipsoid():
            size = shape.radii
        case Capsule() | Cylinder():
            size = (shape.radius, shape.half_length)
        case Sphere():
            size = (shape.radius,)
        case _:
            assert_never(shape)
    return {"type": shape.kind, "size": format_numbers(size), **pose_attributes(shape.pose)}


def mesh_geom_attributes(mesh: str, pose: Pose) -> dict[str, str]:
    """Return type and pose of a geom of the mesh of that name; pose: of the file's frame."""
    return {"type": "mesh", "mesh": mesh, **pose_attributes(pose)}


def pose_attributes(pose: Pose) -> dict[str, str]:
    """Position and rotation; what is zero is left out."""
    found = {}
    if pose.translation.any():
        found["pos"] = format_numbers(pose.translation)
    if not np.array_equal(pose.rotation, np.eye(3)):
        found["quat"] = format_numbers(pose.to_quaternion())
    return found


def inertial_attributes(mass: float, pos: Floats, quaternion: Floats, diagonal: Floats) -> dict[str, str]:
    """Return a mass [kg], its centre (3,), and the moments (3,) about axes that a quaternion (4,) w x y z turns."""
    turned = {} if np.array_equal(quaternion, (1, 0, 0, 0)) else {"quat": format_numbers(quaternion)}
    weight = {"mass": format_numbers([mass]), "diaginertia": format_numbers(diagonal)}
    return {"pos": format_numbers(pos), **turned, **weight}


def joint_tag(joint: Joint, root_t_body: Pose) -> bytes:
    """Return the element of a joint that is not fixed, in its body."""
    named = {"name": joint.name} if joint.name else {}
    if joint.kind == "floating":
        return tag("freejoint", named)
    attributes = {**named, "type": _TYPES[joint.kind]}
    pos = drop_rounding(root_t_body.rotation.T @ (joint.anchor - root_t_body.translation), 1.0)
    if joint.kind != "prismatic" and pos.any():
        attributes["pos"] = format_numbers(pos)
    if joint.kind != "ball":
        attributes["axis"] = format_numbers(drop_rounding(root_t_body.rotation.T @ joint.axis))
        if joint.limits:
            attributes["range"] = format_numbers(joint.limits)
        if joint.effort:
            attributes["actuatorfrcrange"] = format_numbers([-joint.effort, joint.effort])
    if joint.damping:
        attributes["damping"] = format_numbers([joint.damping])
    if joint.friction:
        attributes["frictionloss"] = format_numbers([joint.friction])
    return tag("joint", attributes)


def inertial_tag(inertial: Inertial, root_t_body: Pose) -> tuple[bytes, bool]:
    """Return the `<inertial>` of a body; and whether its moments had to be changed, being those of no rigid body."""
    centre, tensor = place_inertial(inertial, root_t_body)
    moments, axes = principal_axes(tensor)
    legal = _legal_moments(moments, inertial.mass)
    quaternion = Pose(axes, np.zeros(3)).to_quaternion()
    text = tag("inertial", inertial_attributes(inertial.mass, drop_rounding(centre, 1.0), quaternion, legal))
    return text, not np.allclose(legal, moments, rtol=_SLIGHT, atol=0)


def _legal_moments(moments: Floats, mass: float) -> Floats:
    """Moments that a rigid body can have: positive, no one larger than the two others together.

    Others become their mean, as MuJoCo has it where `balanceinertia` asks it to repair them.
    """
    largest = int(np.argmax(moments))
    others = float(moments.sum() - moments[largest])
    excess = float(moments[largest]) - others
    if moments.min() > _LEAST_MOMENT and excess <= 0:
        return moments
    if moments.min() > _LEAST_MOMENT and excess <= _SLIGHT * moments[largest]:
        repaired = moments.copy()
        repaired[largest] = others * (1 - 1e-12)
        return repaired
    return np.full(3, max(float(moments.mean()), _LIGHT_MOMENT * mass, _LEAST_MOMENT))
