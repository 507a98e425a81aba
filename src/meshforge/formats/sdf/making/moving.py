"""XML text of the joints, masses and visuals of an SDF that is made."""

from __future__ import annotations

import numpy as np

from meshforge.asset import Inertial
from meshforge.formats.chain import LinkJoint
from meshforge.formats.numbers import tidy
from meshforge.formats.sdf.elements import Native, leaf, mesh_lines, native_lines, nested, pose_leaf
from meshforge.formats.visual_files import Shown
from meshforge.formats.xml import escaped, shown
from meshforge.geometry import Pose

_ENDLESS = (-1e16, 1e16)
"""Limits that stand for none, which PyBullet asks for."""
_MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


def named(tag: str, name: str, *inside: bytes, more: bytes = b"") -> list[bytes]:
    """The lines of an element with a name; more: further attributes."""
    first, *rest = nested(tag, *inside)
    return [first[:-1] + b' name="%s"%s>' % (escaped(name), more), *rest]


def joint_lines(made: LinkJoint, parent: str, child: str) -> list[bytes]:
    """The lines of a `<joint>`, whose frame is that of its child."""
    joint = made.joint
    kind = joint.kind if joint else "fixed"
    inside = [leaf("parent", parent), leaf("child", child)]
    if joint and kind in ("revolute", "prismatic"):
        limit = [leaf(tag, shown([v])) for tag, v in zip(("lower", "upper"), joint.limits or _ENDLESS, strict=True)]
        limit += [leaf("effort", shown([joint.effort]))] if joint.effort else []
        limit += [leaf("velocity", shown([joint.velocity]))] if joint.velocity else []
        dynamics = [leaf("damping", shown([joint.damping]))] if joint.damping else []
        dynamics += [leaf("friction", shown([joint.friction]))] if joint.friction else []
        axis = [leaf("xyz", shown(tidy(made.axis)))]
        axis += nested("limit", *limit) if limit else []
        axis += nested("dynamics", *dynamics) if dynamics else []
        inside += nested("axis", *axis)
    return named("joint", made.name, *inside, more=b' type="%s"' % kind.encode())


def inertial_lines(inertial: Inertial, root_t_link: Pose) -> list[bytes]:
    """The lines of an `<inertial>`, its axes those of the link."""
    turn = root_t_link.rotation.T
    m = tidy(turn @ inertial.inertia @ turn.T)
    moments = m[0, 0], m[0, 1], m[0, 2], m[1, 1], m[1, 2], m[2, 2]
    tensor = nested("inertia", *(leaf(name, shown([v])) for name, v in zip(_MOMENTS, moments, strict=True)))
    centre = turn @ (inertial.centre - root_t_link.translation)
    return nested("inertial", pose_leaf(Pose.of_translation(centre)), leaf("mass", shown([inertial.mass])), *tensor)


def visual_lines(name: str, visual: Shown, reference: str | None) -> list[bytes]:
    """The lines of a `<visual>`; reference: the mesh file of a shape that SDF lacks."""
    if isinstance(visual.what, Native):
        pose, kind = visual.what.pose, native_lines(visual.what)
    else:
        file = visual.what if isinstance(visual.what, str) else reference
        assert file is not None  # made for every shape that is not native
        scale = None if np.array_equal(visual.scale, np.ones(3)) else visual.scale
        pose, kind = visual.pose, mesh_lines(file, scale)
    inside = [pose_leaf(pose), *nested("geometry", *kind)]
    if visual.rgba:
        color = shown(visual.rgba)
        inside += nested("material", leaf("ambient", color), leaf("diffuse", color))
        inside += [leaf("transparency", shown([1 - visual.rgba[3]]))] if visual.rgba[3] < 1 else []
    return named("visual", name, *inside)
