"""The joints of an MJCF that is made: those of an asset in terms of MuJoCo's four kinds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from meshforge.asset import Joint, JointKind
from meshforge.formats.body_tree import free_name
from meshforge.formats.chain import across_of
from meshforge.formats.mjcf.elements import tag
from meshforge.formats.numbers import tidy
from meshforge.formats.xml import shown
from meshforge.geometry import Floats, Pose

_TYPES = {"revolute": "hinge", "prismatic": "slide", "ball": "ball"}


def parts_of(joint: Joint, top: bool, taken: set[str]) -> Sequence[Joint]:
    """The joints that move together as one does; top: whether its body may have a free joint.

    A planar joint is two slides and a hinge; a floating one that is not at the top three slides and a ball.
    """
    match joint.kind:
        case "fixed":
            return []
        case "planar":
            across = across_of(joint.axis)
            parts: list[tuple[str, JointKind, Floats]] = [
                ("x", "prismatic", across),
                ("y", "prismatic", np.cross(joint.axis, across)),
            ]
            parts.append(("turn", "revolute", joint.axis))
        case "floating" if not top:
            axes = np.eye(3)
            parts = [(name, "prismatic", axes[k]) for k, name in enumerate("xyz")]
            parts.append(("turn", "ball", axes[2]))
        case _:
            return [joint]
    name = joint.name or joint.child
    bare = replace(joint, limits=None, effort=None)
    return [replace(bare, name=free_name(f"{name}_{k}", taken), kind=kind, axis=axis) for k, kind, axis in parts]


def joint_tag(joint: Joint, root_t_body: Pose) -> bytes:
    """The element of a joint that is neither fixed nor planar, in its body."""
    named = {"name": joint.name} if joint.name else {}
    if joint.kind == "floating":
        return tag("freejoint", named)
    attributes = {**named, "type": _TYPES[joint.kind]}
    pos = tidy(root_t_body.rotation.T @ (joint.anchor - root_t_body.translation), 1.0)
    if joint.kind != "prismatic" and pos.any():
        attributes["pos"] = shown(pos)
    if joint.kind != "ball":
        attributes["axis"] = shown(tidy(root_t_body.rotation.T @ joint.axis))
        if joint.limits:
            attributes["range"] = shown(joint.limits)
        if joint.effort:
            attributes["actuatorfrcrange"] = shown([-joint.effort, joint.effort])
    if joint.damping:
        attributes["damping"] = shown([joint.damping])
    if joint.friction:
        attributes["frictionloss"] = shown([joint.friction])
    return tag("joint", attributes)
