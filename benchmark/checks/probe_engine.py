"""A program for a process of its own, since PyBullet may crash: loads a file in MuJoCo or PyBullet, puts a small ball
at each of many points, and writes which of them touch, and the margin of contacts [m], as JSON."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np

from meshforge.geometry import Floats

_OF_FIGURES = ("mjGEOM_PLANE", "mjGEOM_HFIELD", "mjGEOM_SDF")
"""Geoms of MuJoCo that are no solids to compare with hulls."""
_MARGIN = 0.001
"""Of the hulls of Bullet [m]: gUrdfDefaultCollisionMargin of its importers; it says 0 of links of several shapes."""


def probe_mujoco(path: Path, points: Floats, radius: float) -> tuple[list[bool], float]:
    """Which points (n, 3) a ball touches something at, at the reference pose; raises ValueError for a file that MuJoCo
    refuses."""
    import mujoco

    spec = mujoco.MjSpec.from_file(str(path))
    ball = spec.worldbody.add_body(name="probe of the benchmark", mass=1, inertia=[1, 1, 1], explicitinertial=True)
    ball.add_freejoint()
    bits = 0x7FFFFFFF
    sphere = {"type": mujoco.mjtGeom.mjGEOM_SPHERE, "size": [radius, 0, 0], "contype": bits, "conaffinity": bits}
    ball.add_geom(name="probe of the benchmark", **sphere, margin=0, gap=0)
    for key in list(spec.keys):  # their number of coordinates is another one now
        spec.delete(key)
    model = spec.compile()
    data, probe = mujoco.MjData(model), model.geom("probe of the benchmark").id
    at = int(model.joint(model.body("probe of the benchmark").jntadr[0]).qposadr[0])
    left_out = {int(getattr(mujoco.mjtGeom, name)) for name in _OF_FIGURES}
    touched = list[bool]()
    for point in points:
        data.qpos[at : at + 3] = point
        mujoco.mj_fwdPosition(model, data)
        pairs = ((one.geom1, one.geom2, one.dist) for one in data.contact[: data.ncon])
        others = [a + b - probe for a, b, gap in pairs if probe in (a, b) and gap < 0]
        touched.append(any(int(model.geom_type[one]) not in left_out for one in others))
    return touched, float(model.geom_margin.max())


def probe_bullet(path: Path, points: Floats, radius: float) -> tuple[list[bool], float]:
    """As `probe_mujoco`."""
    import pybullet as bullet

    bullet.connect(bullet.DIRECT)
    try:
        if path.suffix == ".urdf":
            bodies = [bullet.loadURDF(str(path), useFixedBase=True, flags=bullet.URDF_USE_INERTIA_FROM_FILE)]
        elif path.suffix == ".sdf":
            bodies = list(bullet.loadSDF(str(path)))
        else:
            shape = bullet.createCollisionShape(bullet.GEOM_MESH, fileName=str(path))
            bodies = [bullet.createMultiBody(baseCollisionShapeIndex=shape)] if shape >= 0 else []
    except bullet.error:
        bodies = []
    if not bodies or min(bodies) < 0:
        raise ValueError("PyBullet refuses it")
    ball = bullet.createMultiBody(1.0, bullet.createCollisionShape(bullet.GEOM_SPHERE, radius=radius))
    touched = list[bool]()
    for point in points:
        bullet.resetBasePositionAndOrientation(ball, point.tolist(), [0, 0, 0, 1])
        near = (one for body in bodies for one in bullet.getClosestPoints(ball, body, 0.0))
        touched.append(any(one[8] < 0 for one in near))
    return touched, _MARGIN


def main(engine: str, path: str, points: str, out: str) -> int:
    """Return the exit code: 3 where the engine refuses the file."""
    given = json.loads(Path(points).read_text("utf-8"))
    probe = {"mujoco": probe_mujoco, "bullet": probe_bullet}[engine]
    try:
        touched, margin = probe(Path(path), np.array(given["points"]), given["radius"])
    except ValueError:
        return 3
    Path(out).write_text(json.dumps({"touched": touched, "margin": margin}), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
