"""What touches what in a MuJoCo scene, how deep, and whether things have come to rest."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np


@dataclass(frozen=True, slots=True)
class Touch:
    """Two geoms by name, the object first, and how deep they are in each other [m]."""

    mover: str
    other: str
    depth: float


def collide(model: Any, data: Any) -> None:
    """Find all contacts for the positions as they are set."""
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_collision(model, data)


def deepest(model: Any, data: Any, least: float) -> Touch | None:
    """The deepest contact deeper than `least` [m], None where there is none."""
    contact = data.contact
    if not len(contact.dist):
        return None
    k = int(np.argmin(contact.dist))
    depth = -float(contact.dist[k])
    if depth <= least:
        return None
    pair = [int(g) for g in contact.geom[k]]
    pair.sort(key=lambda geom: -int(model.geom_contype[geom]))
    return Touch(model.geom(pair[0]).name, model.geom(pair[1]).name, depth)


def advance(model: Any, data: Any, seconds: float) -> bool:
    """Simulate for so long; False where the simulation breaks down."""
    steps = max(1, round(seconds / model.opt.timestep))
    mujoco.mj_step(model, data, nstep=steps)
    return not any(warning.number for warning in data.warning)


def calm(data: Any, speed: float = 0.001, turning: float = 0.01) -> bool:
    """Whether all free bodies are at rest: speed [m/s], turning [rad/s]."""
    velocity = np.abs(np.asarray(data.qvel).reshape(-1, 6))
    return bool(velocity[:, :3].max() < speed and velocity[:, 3:].max() < turning)


def mm(length: float) -> str:
    """A length in words."""
    return f"{1000 * length:.1f} mm"
