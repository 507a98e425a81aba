"""What touches what in a MuJoCo scene, how deep, and whether things have come to rest."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from meshforge.checks.trials.place import describe_hull
from meshforge.symbolic import Hull

BREAKS_DOWN = "the simulation breaks down"


@dataclass(frozen=True, slots=True)
class Touch:
    """Two geoms by name, the object first, and how deep they are in each other [m]."""

    mover: str
    other: str
    depth: float

    def names(self, hulls: Iterable[Hull]) -> tuple[str, ...]:
        """Return the names of those hulls that touch."""
        return tuple(hull.name for hull in hulls if describe_hull(hull) in (self.mover, self.other))


def collide(model: Any, data: Any) -> None:
    """Find all contacts for the positions as they are set."""
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_collision(model, data)


def deepest(model: Any, data: Any, least: float, apart: frozenset[frozenset[str]] = frozenset()) -> Touch | None:
    """Return the deepest contact deeper than `least` [m], None where there is none; apart: pairs of names of hulls
    whose contacts do not count."""
    contact = data.contact
    for k in np.argsort(contact.dist, kind="stable"):
        depth = -float(contact.dist[k])
        if depth <= least:
            return None
        pair = sorted(map(int, contact.geom[k]), key=lambda geom: -int(model.geom_contype[geom]))
        mover, other = (model.geom(geom).name for geom in pair)
        if not apart or frozenset(name.rpartition(" (")[0] for name in (mover, other)) not in apart:
            return Touch(mover, other, depth)
    return None


def advance(model: Any, data: Any, seconds: float) -> bool:
    """Simulate for so long; return whether the simulation holds up."""
    steps = max(1, round(seconds / model.opt.timestep))
    mujoco.mj_step(model, data, nstep=steps)
    return not any(warning.number for warning in data.warning)


def calm(data: Any, speed: float = 0.001, turning: float = 0.01) -> bool:
    """Return whether all free bodies are at rest: speed [m/s], turning [rad/s]."""
    velocity = np.abs(np.asarray(data.qvel).reshape(-1, 6))
    return bool(velocity[:, :3].max() < speed and velocity[:, 3:].max() < turning)
