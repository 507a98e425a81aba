"""Graspable: a parallel gripper closes on a bar and pulls the asset along."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from benchmark.assets.asset import Site
from benchmark.criteria.case import Case
from benchmark.criteria.contact import advance, collide, deepest, mm
from benchmark.criteria.scene import add_hulls, add_shape, axes_of, blank, step_for, tolerance, weigh
from meshforge.geometry import Box, Floats, Pose

_PULL, _SECONDS = 0.05, 0.4
_ALONG = 0.8  # of the pull, that the asset must come along
_FORCE = 20.0  # of a finger [N]
_CLOSING, _SLOWEST = 0.2, 0.6  # for the whole opening where nothing is in it, and at most [s]
_BACK = 2.0  # fingers reach so far back from the bar, in lengths of what is past it
_SIDES = (1.0, -1.0)


def failure(case: Case, site: str, pull: str = "back") -> str | None:
    """Why the gripper fails at some site of that name: what is in its way, or how little the asset comes along."""
    assert pull in ("back", "up"), pull
    sites = case.asset.site(site)
    if sites and not case.mesh.hulls:
        return f"{site}: no hull is left"
    for number, where in enumerate(sites, 1):
        why = _to_line(case, where, pull)
        if why:
            return f"{site} {number}: {why}"
    return None


def _to_line(case: Case, site: Site, pull: str) -> str | None:
    axes = axes_of(site)
    way = np.array([0.0, 0.0, 1.0]) if pull == "up" else -axes[:, 0]
    model = _scene(case, site, way)
    data = mujoco.MjData(model)
    collide(model, data)
    touch = deepest(model, data, tolerance(case.asset))
    if touch:
        return f"{touch.other} is {mm(touch.depth)} in an open finger"
    return _closes(model, data, site) or _pulls(model, data, site, way)


def _scene(case: Case, site: Site, way: Floats) -> Any:
    """A free asset without weight, and a heavy gripper that slides along `way`, its fingers open."""
    spec = blank(step_for(site.size[1] / 2), gravity=0.0)
    body = spec.worldbody.add_body(name="asset")
    body.add_freejoint()
    weigh(body, [hull.shape for hull in case.mesh.hulls])
    add_hulls(spec, body, case.mesh.hulls)
    gripper = spec.worldbody.add_body(name="gripper")
    gripper.add_joint(name="gripper", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=way)
    weigh(gripper, [Box(Pose.identity(), np.full(3, 0.1))], 1000.0)
    axes = axes_of(site)
    for side in _SIDES:
        _finger(spec, gripper, site, axes, side)
    rule = spec.add_equality(type=mujoco.mjtEq.mjEQ_JOINT, name1=_name(1.0), name2=_name(-1.0))
    rule.objtype = mujoco.mjtObj.mjOBJ_JOINT
    rule.data[:5] = [0.0, 1.0, 0.0, 0.0, 0.0]
    return spec.compile()


def _name(side: float) -> str:
    return "left finger" if side > 0 else "right finger"


def _finger(spec: Any, gripper: Any, site: Site, axes: Floats, side: float) -> None:
    """A finger on one side of the bar; its joint says how far it has closed."""
    past, opening, half = site.size
    long, thick = past * (1 + _BACK) / 2, opening / 4
    middle = np.asarray(site.at) + axes[:, 0] * (past - long) + axes[:, 1] * side * (opening + thick)
    box = Box(Pose(axes, middle), np.array([long, thick, half]))
    body = gripper.add_body(name=_name(side))
    body.add_joint(
        name=_name(side),
        type=mujoco.mjtJoint.mjJNT_SLIDE,
        axis=-side * axes[:, 1],
        range=[0.0, opening],
        limited=mujoco.mjtLimited.mjLIMITED_TRUE,
        damping=_FORCE * _CLOSING / opening,
    )
    weigh(body, [box], 0.1)
    add_shape(spec, body, _name(side), box, friction=[1.0, 0.005, 0.0001], condim=4)


def _closes(model: Any, data: Any, site: Site) -> str | None:
    """Close until the fingers hold something; why they do not."""
    fingers = [int(model.joint(_name(side)).dofadr[0]) for side in _SIDES]
    data.qfrc_applied[fingers] = _FORCE
    while data.time < _SLOWEST:
        if not advance(model, data, 0.02):
            return "the simulation breaks down"
        closed = float(data.qpos[model.joint(_name(1.0)).qposadr[0]])
        if closed > 0.99 * site.size[1]:
            return "the fingers close on nothing"
        if np.abs(data.qvel[fingers]).max() < 0.01 * site.size[1] / _CLOSING:
            break
    return None


def _pulls(model: Any, data: Any, site: Site, way: Floats) -> str | None:
    """Pull smoothly; why the asset stays behind."""
    base = int(model.joint("gripper").dofadr[0])
    body = data.body("asset")
    start = np.asarray(site.at)
    held = body.xmat.reshape(3, 3).T @ (start - body.xpos)
    count = round(_SECONDS / model.opt.timestep)
    for k in range(count):
        data.qvel[base] = _PULL / _SECONDS * (1 - np.cos(2 * np.pi * (k + 0.5) / count))
        mujoco.mj_step(model, data)
    came = float(way @ (body.xpos + body.xmat.reshape(3, 3) @ held - start))
    return f"pulled by {mm(_PULL)}, the asset comes along by {mm(came)}" if came < _ALONG * _PULL else None
