"""Two parallel fingers in MuJoCo that close on an asset along x, placed by the surface that is seen."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np

from meshforge.geometry import Floats, Ints, sample_surface

FORCE = 0.5  # [N] of each finger: contacts are soft, and a stronger one sinks in
_STEPS = 1000
_POINTS = 20000
_GAP = 0.02  # of the diagonal, on both sides of what is seen


@dataclass(frozen=True)
class Fingers:
    """Two boxes. middle: (3,) [m] between the inner sides; opening: [m] between these; half: (3,) [m] of each box."""

    middle: Floats
    opening: float
    half: Floats

    def add_to(self, path: Path) -> mujoco.MjModel:
        """A model of the asset in a file, which stands still, and of the fingers, which slide along x."""
        spec = mujoco.MjSpec.from_file(str(path))
        spec.option.gravity = [0, 0, 0]
        for name, side in (("left", -1), ("right", 1)):
            away = side * (self.opening / 2 + self.half[0])
            body = spec.worldbody.add_body(name=name, pos=self.middle + np.array([away, 0, 0]))
            body.add_joint(name=name, type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[1, 0, 0], damping=[20, 0, 0])
            body.add_geom(name=name, type=mujoco.mjtGeom.mjGEOM_BOX, size=self.half, mass=0.05)
        return spec.compile()

    def count_contacts(self, path: Path) -> int:
        """How many contacts the open fingers have."""
        model = self.add_to(path)
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        return int(data.ncon)

    def close(self, path: Path) -> tuple[dict[str, set[str]], float]:
        """The hulls that each finger touches when both are closed, and how far apart they are then [m]."""
        model = self.add_to(path)
        data = mujoco.MjData(model)
        data.qfrc_applied[:] = [FORCE, -FORCE]
        mujoco.mj_step(model, data, _STEPS)
        touched: dict[str, set[str]] = {"left": set(), "right": set()}
        for pair in data.contact.geom.tolist():
            names = {model.geom(place).name for place in pair}
            for finger in names & touched.keys():
                touched[finger] |= names - {finger}
        return touched, self.opening + float(data.qpos[1] - data.qpos[0])


def place_fingers(vertices: Floats, faces: Ints, along: float) -> tuple[Fingers, float]:
    """Open fingers around a surface at a height `along` y [m], 2% of its diagonal away on both sides, and how wide the
    surface is between them [m]."""
    points, _ = sample_surface(vertices, faces, _POINTS)
    diagonal = float(np.linalg.norm(vertices.max(axis=0) - vertices.min(axis=0)))
    half = np.array([0.02, 0.03, 0.01]) * diagonal
    held = points[np.abs(points[:, 1] - along) <= half[1]]
    low, high = held[:, 0].min(), held[:, 0].max()
    middle = np.array([(low + high) / 2, along, (held[:, 2].min() + held[:, 2].max()) / 2])
    return Fingers(middle, float(high - low) + 2 * _GAP * diagonal, half), float(high - low)
