"""The joints and masses of a compiled model, in the root frame."""

from __future__ import annotations

import numpy as np

from meshforge.asset import Inertial, Joint, JointKind, Mechanism
from meshforge.formats.mjcf.reading.model import Reading

_KINDS: tuple[JointKind, ...] = ("floating", "ball", "prismatic", "revolute")  # in the order of MuJoCo's numbers


def read_mechanism(reading: Reading) -> Mechanism:
    """The mechanism of a model, `<exclude>` and `<pair>` too; a body without a joint is fixed to its parent."""
    joints = [joint for k in range(1, reading.model.nbody) for joint in _joints(reading, k)]
    inertials = [i for k in range(1, reading.model.nbody) if (i := _inertial(reading, k)) is not None]
    return Mechanism(tuple(joints), tuple(inertials), _apart(reading), _paired(reading))


def _apart(reading: Reading) -> tuple[tuple[str, str], ...]:
    signatures = [int(signature) for signature in reading.model.exclude_signature]
    return tuple(
        (reading.body_names[s >> 16], reading.body_names[s & 0xFFFF]) for s in signatures
    )  # as MuJoCo packs it


def _paired(reading: Reading) -> tuple[tuple[str, str], ...]:
    geoms = zip(reading.model.pair_geom1, reading.model.pair_geom2, strict=True)
    return tuple((reading.names[int(first)], reading.names[int(second)]) for first, second in geoms)


def _joints(reading: Reading, body: int) -> list[Joint]:
    model = reading.model
    child, parent = reading.body_names[body], reading.body_names[int(model.body_parentid[body])]
    first, count = int(model.body_jntadr[body]), int(model.body_jntnum[body])
    if not count:
        pose = reading.body_poses[body]
        return [Joint("", "fixed", parent, child, pose.translation, pose.rotation[:, 0])]
    return [_joint(reading, k, parent, child) for k in range(first, first + count)]


def _joint(reading: Reading, k: int, parent: str, child: str) -> Joint:
    model, pose = reading.model, reading.body_poses[int(reading.model.jnt_bodyid[k])]
    kind, dof = _KINDS[int(model.jnt_type[k])], int(model.jnt_dofadr[k])
    limits = None
    if model.jnt_limited[k] and kind in ("prismatic", "revolute"):
        zero = float(model.qpos0[model.jnt_qposadr[k]])
        limits = float(model.jnt_range[k, 0]) - zero, float(model.jnt_range[k, 1]) - zero
    return Joint(
        model.joint(k).name,
        kind,
        parent,
        child,
        pose.apply(model.jnt_pos[k][None])[0],
        pose.rotation @ model.jnt_axis[k],
        limits,
        damping=float(np.ravel(model.dof_damping[dof])[0]),
        friction=float(np.ravel(model.dof_frictionloss[dof])[0]),
        effort=float(model.jnt_actfrcrange[k, 1]) if model.jnt_actfrclimited[k] else None,
    )


def _inertial(reading: Reading, k: int) -> Inertial | None:
    body = reading.bodies[k]
    if body.mass <= 0:
        return None
    frame = body.pose @ body.inertial
    inertia = frame.rotation @ np.diag(body.inertia) @ frame.rotation.T
    return Inertial(body.name, body.mass, frame.translation, inertia)
