"""Graspable: a parallel gripper closes on a bar and pulls the asset along."""

from collections.abc import Sequence
from typing import Any, Literal

import mujoco
import numpy as np

from meshforge.checks.physics.scene import (
    BREAKS_DOWN,
    Failure,
    Place,
    add_hulls,
    add_shape,
    advance,
    blank,
    collide,
    deepest,
    mm,
    step_for,
    weigh,
)
from meshforge.geometry import Box, Floats, Pose
from meshforge.symbolic import Hull

Pull = Literal["back", "up"]

_PULL, _SECONDS = 0.05, 0.4
_ALONG = 0.8  # of the pull, that the asset must come along
_FORCE = 20.0  # of a finger [N]
_CLOSING, _SLOWEST = 0.2, 0.6  # for the whole opening where nothing is in it, and at most [s]
_BACK = 2.0  # fingers reach so far back from the bar, in lengths of what is past it
_SIDES = (1.0, -1.0)


def try_grasp(hulls: Sequence[Hull], grip: Place, pull: Pull, touching: float) -> Failure | None:
    """Return why the gripper fails, None where it does not: what is in its way, or how little the asset comes along.

    grip: at the middle of the bar, from where fingers come along the first axis and close along the second; size: how
    far they go past the middle, half their opening, and half their height [m]. The asset has no weight.
    """
    way = np.array([0.0, 0.0, 1.0]) if pull == "up" else -grip.axes[:, 0]
    model = _build_scene(hulls, grip, way)
    data = mujoco.MjData(model)
    collide(model, data)
    fingers = tuple(_finger_of(grip, side) for side in _SIDES)
    if touch := deepest(model, data, touching):
        return Failure(f"{touch.other} is {mm(touch.depth)} in an open finger", touch.names(hulls), fingers)
    why = _close(model, data, grip) or _pull(model, data, grip, way)
    return Failure(why, objects=fingers) if why else None


def _build_scene(hulls: Sequence[Hull], grip: Place, way: Floats) -> Any:
    """A free asset without weight, and a heavy gripper that slides along `way`, its fingers open."""
    spec = blank(step_for(grip.size[1] / 2), gravity=0.0)
    body = spec.worldbody.add_body(name="asset")
    body.add_freejoint()
    weigh(body, [hull.shape for hull in hulls])
    add_hulls(spec, body, hulls)
    gripper = spec.worldbody.add_body(name="gripper")
    gripper.add_joint(name="gripper", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=way)
    weigh(gripper, [Box(Pose.identity(), np.full(3, 0.1))], 1000.0)
    for side in _SIDES:
        _add_finger(spec, gripper, grip, side)
    rule = spec.add_equality(type=mujoco.mjtEq.mjEQ_JOINT, name1=_name(1.0), name2=_name(-1.0))
    rule.objtype = mujoco.mjtObj.mjOBJ_JOINT
    rule.data[:5] = [0.0, 1.0, 0.0, 0.0, 0.0]
    return spec.compile()


def _name(side: float) -> str:
    return "left finger" if side > 0 else "right finger"


def _finger_of(grip: Place, side: float) -> Box:
    """The open finger on one side of the bar."""
    past, opening, half = grip.size
    long, thick = past * (1 + _BACK) / 2, opening / 4
    middle = grip.at + grip.axes[:, 0] * (past - long) + grip.axes[:, 1] * side * (opening + thick)
    return Box(Pose(grip.axes, middle), np.array([long, thick, half]))


def _add_finger(spec: Any, gripper: Any, grip: Place, side: float) -> None:
    """Add a finger; its joint says how far it has closed."""
    box, opening = _finger_of(grip, side), grip.size[1]
    body = gripper.add_body(name=_name(side))
    body.add_joint(
        name=_name(side),
        type=mujoco.mjtJoint.mjJNT_SLIDE,
        axis=-side * grip.axes[:, 1],
        range=[0.0, opening],
        limited=mujoco.mjtLimited.mjLIMITED_TRUE,
        damping=_FORCE * _CLOSING / opening,
    )
    weigh(body, [box], 0.1)
    add_shape(spec, body, _name(side), box, friction=[1.0, 0.005, 0.0001], condim=4)


def _close(model: Any, data: Any, grip: Place) -> str | None:
    """Close until the fingers hold something; why they do not."""
    fingers = [int(model.joint(_name(side)).dofadr[0]) for side in _SIDES]
    data.qfrc_applied[fingers] = _FORCE
    while data.time < _SLOWEST:
        if not advance(model, data, 0.02):
            return BREAKS_DOWN
        closed = float(data.qpos[model.joint(_name(1.0)).qposadr[0]])
        if closed > 0.99 * grip.size[1]:
            return "the fingers close on nothing"
        if np.abs(data.qvel[fingers]).max() < 0.01 * grip.size[1] / _CLOSING:
            break
    return None


def _pull(model: Any, data: Any, grip: Place, way: Floats) -> str | None:
    """Pull smoothly; why the asset stays behind."""
    base = int(model.joint("gripper").dofadr[0])
    body = data.body("asset")
    grip_point = body.xmat.reshape(3, 3).T @ (grip.at - body.xpos)
    count = round(_SECONDS / model.opt.timestep)
    for k in range(count):
        data.qvel[base] = _PULL / _SECONDS * (1 - np.cos(2 * np.pi * (k + 0.5) / count))
        mujoco.mj_step(model, data)
    came = float(way @ (body.xpos + body.xmat.reshape(3, 3) @ grip_point - grip.at))
    return f"pulled by {mm(_PULL)}, the asset comes along by {mm(came)}" if came < _ALONG * _PULL else None
