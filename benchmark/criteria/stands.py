"""Stands: dropped from 1 cm as one rigid body, leaning a little, the mesh ends upright and at rest."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
from scipy.spatial import ConvexHull, QhullError

from benchmark.criteria.case import Case
from benchmark.criteria.contact import advance, calm
from benchmark.criteria.scene import add_shape, blank, weigh
from meshforge.geometry import Box, Floats, Polytope, Pose, Shape, Sphere

_DROP, _SECONDS, _LOOK = 0.01, 2.0, 0.05
_TILT, _LOST = 2.0, 25.0  # degrees: upright; no way back
_CALM_FOR = 4  # looks
_LEAN = 0.3  # degrees, at which it is dropped: what merely balances falls
_GIVE = 0.02  # of the floor, like wood [s]: on a stiffer one what is tall rocks on
_POINT = 1e-4  # radius of a corner, of the mesh's diagonal
_LEANING = Pose.from_rpy((0, 0, 0), tuple(np.radians(_LEAN) * np.array([0.8, 0.6, 0.0])))


def failure(case: Case) -> str | None:
    """Why the mesh does not stand: by how much it tilts, or that it is not at rest in time."""
    if not case.mesh.hulls:
        return "no hull is left"
    model = _scene(case)
    data = mujoco.MjData(model)
    still = 0
    while data.time < _SECONDS and still < _CALM_FOR:
        if not advance(model, data, _LOOK):
            return "the simulation breaks down"
        if _tilt(data) > _LOST:
            return f"it falls over within {data.time:.2f} s"
        still = still + 1 if data.ncon and calm(data, turning=0.005) else 0
    if _tilt(data) >= _TILT:
        return f"it tilts by {_tilt(data):.1f} degrees"
    return None if still else f"it is not at rest after {_SECONDS:.0f} s, tilted by {_tilt(data):.1f} degrees"


def _tilt(data: Any) -> float:
    """Of the body against upright [degrees]."""
    return float(np.degrees(np.arccos(np.clip(data.body("asset").xmat[8], -1.0, 1.0))))


def _scene(case: Case) -> Any:
    """A floor, and the mesh above it: a flat floor touches corners and round shapes only, so these are its geoms."""
    shapes = [hull.shape for hull in case.mesh.hulls]
    spec = blank(give=_GIVE)
    floor = spec.worldbody.add_geom(name="floor", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[10, 10, 1])
    floor.contype, floor.conaffinity = 1, 0
    down = -_LEANING.rotation[2]
    foot = -max(float(down @ shape.support(down)) for shape in shapes)
    body = spec.worldbody.add_body(name="asset", pos=[0.0, 0.0, _DROP - foot])
    body.quat = _LEANING.to_quaternion()
    body.add_freejoint()
    weigh(body, shapes)
    for k, shape in enumerate(_support_points(shapes, _POINT * case.mesh.diagonal)):
        add_shape(spec, body, f"{shape.kind} {k}", shape, object_side=False)
    return spec.compile()


def _support_points(shapes: list[Shape], radius: float) -> list[Shape]:
    """The corners of the convex hull of all angular shapes as balls within it, and the round shapes."""
    angular = [shape.vertices for shape in shapes if isinstance(shape, Polytope | Box)]
    others = [shape for shape in shapes if not isinstance(shape, Polytope | Box)]
    corners = _corners(np.concatenate(angular)) if angular else []
    lifted = np.array([0.0, 0.0, radius])
    return [*(Sphere(Pose.of_translation(corner + lifted), radius) for corner in corners), *others]


def _corners(points: Floats) -> list[Floats]:
    try:
        return list(points[ConvexHull(points).vertices])
    except QhullError:
        return list(points)
