"""XML text of MJCF elements: geoms, meshes, bodies and masses, their numbers in full precision."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import assert_never

import numpy as np

from meshforge.formats.xml import escaped, shown
from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Floats, Pose, Sphere

Native = Box | Capsule | Cylinder | Ellipsoid | Sphere
"""The shapes that MuJoCo has of its own."""


def tag(name: str, attributes: Mapping[str, str], closed: bool = True) -> bytes:
    """An element without children; closed: else only its start tag."""
    said = "".join(f' {key}="{escaped(value).decode()}"' for key, value in attributes.items())
    return f"<{name}{said}{'/' if closed else ''}>".encode()


def geom_attributes(shape: Native) -> dict[str, str]:
    """Type, size and pose of a native shape, in the frame in which the shape is."""
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
    return {"type": shape.kind, "size": shown(size), **pose_attributes(shape.pose)}


def mesh_geom_attributes(mesh: str, pose: Pose) -> dict[str, str]:
    """Type and pose of a geom of the mesh of that name; pose: of the file's frame."""
    return {"type": "mesh", "mesh": mesh, **pose_attributes(pose)}


def pose_attributes(pose: Pose) -> dict[str, str]:
    """Position and rotation; what is zero is left out."""
    found = {}
    if pose.translation.any():
        found["pos"] = shown(pose.translation)
    if not np.array_equal(pose.rotation, np.eye(3)):
        found["quat"] = shown(pose.to_quaternion())
    return found


def inertial_attributes(mass: float, pos: Floats, quaternion: Floats, diagonal: Floats) -> dict[str, str]:
    """A mass [kg], its centre (3,), and the moments (3,) about axes that a quaternion (4,) w x y z turns."""
    turned = {} if np.array_equal(quaternion, (1, 0, 0, 0)) else {"quat": shown(quaternion)}
    return {"pos": shown(pos), **turned, "mass": shown([mass]), "diaginertia": shown(diagonal)}
