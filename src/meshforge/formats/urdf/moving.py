"""XML text of the joints, masses and visuals of a URDF that is made."""

from __future__ import annotations

import numpy as np

from meshforge.asset import Inertial
from meshforge.formats.chain import LinkJoint
from meshforge.formats.numbers import tidy
from meshforge.formats.urdf.elements import mesh_tag, native_tag, origin_tag
from meshforge.formats.visual_files import Shown
from meshforge.formats.visuals import Rgba
from meshforge.formats.xml import escaped, shown
from meshforge.geometry import Box, Cylinder, Floats, Pose, Sphere

ENDLESS = 1000.0  # [m] either way, for a prismatic joint without limits, which URDF does not know
_STRONG = 1000.0  # [N, Nm, m/s, rad/s], for joints of which no largest effort or velocity is known
LIGHT = Inertial("", 1e-6, np.zeros(3), 1e-9 * np.eye(3))
"""The mass of a link that stands for none, above what engines refuse."""


def joint_element(made: LinkJoint) -> list[bytes]:
    """The lines of a `<joint>`."""
    joint = made.joint
    kind = joint.kind if joint else "fixed"
    type_ = "continuous" if joint and kind == "revolute" and joint.limits is None else kind
    lines = [
        b'  <joint name="%s" type="%s">' % (escaped(made.name), type_.encode()),
        b"    " + origin_tag(made.pose),
        b'    <parent link="%s"/>' % escaped(made.parent),
        b'    <child link="%s"/>' % escaped(made.child),
    ]
    if kind in ("revolute", "prismatic", "planar"):
        lines.append(b'    <axis xyz="%s"/>' % _text(tidy(made.axis)))
    if joint and kind in ("revolute", "prismatic"):
        lower, upper = joint.limits or (-ENDLESS, ENDLESS)
        range_ = b"" if type_ == "continuous" else b'lower="%s" upper="%s" ' % (_number(lower), _number(upper))
        most = _number(joint.effort or _STRONG), _number(joint.velocity or _STRONG)
        if range_ or joint.effort or joint.velocity:
            lines.append(b'    <limit %seffort="%s" velocity="%s"/>' % (range_, *most))
    if joint and (joint.damping or joint.friction):
        said = _number(joint.damping), _number(joint.friction)
        lines.append(b'    <dynamics damping="%s" friction="%s"/>' % said)
    return [*lines, b"  </joint>"]


def inertial_element(inertial: Inertial, root_t_link: Pose) -> list[bytes]:
    """The lines of an `<inertial>`, its axes those of the link."""
    turn = root_t_link.rotation.T
    m = tidy(turn @ inertial.inertia @ turn.T)
    names = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    moments = m[0, 0], m[0, 1], m[0, 2], m[1, 1], m[1, 2], m[2, 2]
    said = b" ".join(b'%s="%s"' % (n.encode(), _number(v)) for n, v in zip(names, moments, strict=True))
    centre = turn @ (inertial.centre - root_t_link.translation)
    return [
        b"    <inertial>",
        b"      " + origin_tag(Pose.of_translation(centre)),
        b'      <mass value="%s"/>' % _number(inertial.mass),
        b"      <inertia %s/>" % said,
        b"    </inertial>",
    ]


def visual_element(visual: Shown, reference: str | None = None) -> list[bytes]:
    """The lines of a `<visual>`; reference: the mesh file of a shape that URDF lacks."""
    if isinstance(visual.what, Box | Cylinder | Sphere):
        pose, tag = visual.what.pose, native_tag(visual.what)
    else:
        file = visual.what if isinstance(visual.what, str) else reference
        assert file is not None  # made for every shape that is not native
        pose, tag = visual.pose, mesh_tag(file)
        if not np.array_equal(visual.scale, np.ones(3)):
            tag = tag[:-2] + b' scale="%s"/>' % _text(visual.scale)
    lines = [
        b"    <visual>",
        b"      " + origin_tag(pose),
        b"      <geometry>",
        b"        " + tag,
        b"      </geometry>",
    ]
    return [*lines, *([_material(visual.rgba)] if visual.rgba else []), b"    </visual>"]


def _material(rgba: Rgba) -> bytes:
    """A colour, named by its numbers: equal names must be equal colours."""
    text = shown(rgba)
    return b'      <material name="rgba %s"><color rgba="%s"/></material>' % (text.encode(), text.encode())


def _number(value: float) -> bytes:
    return shown([value]).encode()


def _text(values: Floats) -> bytes:
    return shown(values).encode()
