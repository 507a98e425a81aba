"""MuJoCo scenes of hulls where they are, Z up, and objects that are tried on them."""

from collections.abc import Iterable
from typing import Any

import mujoco
import numpy as np

from meshforge.checks.trials.place import describe_hull
from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Floats, Pose, Shape, Sphere, inertia, spans_volume
from meshforge.symbolic import Hull

FRICTION = 0.6
_TYPES = mujoco.mjtGeom
_ROUND = (Capsule, Cylinder, Ellipsoid, Sphere)


def step_for(size: float) -> float:
    """Return the time step [s] at which things of that half extent [m] do not tunnel and are calm."""
    return float(np.clip(0.02 * np.sqrt(size), 0.0005, 0.002))


def blank(step: float = 0.002, gravity: float = 9.81, give: float = 0.0) -> Any:
    """Return an empty scene; step [s], gravity [m/s^2]; give: how slowly contacts resist [s], by default at once."""
    spec = mujoco.MjSpec()
    spec.memory = 1 << 25
    spec.compiler.balanceinertia = True
    spec.option.timestep = step
    spec.option.gravity = [0.0, 0.0, -gravity]
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.impratio = 10.0
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.ccd_iterations = 100
    geom = spec.default.geom
    geom.solref, geom.solimp = [max(give, 2 * step), 1.0], [0.95, 0.99, 0.0005, 0.5, 2.0]
    geom.friction = [FRICTION, 0.0001, 0.0001]
    geom.density = 0.0
    return spec


def weigh(body: Any, shapes: Iterable[Shape], mass: float = 1.0) -> None:
    """Give a body the mass [kg] and the inertia of shapes of one density."""
    centre, moment = inertia(list(shapes), mass)
    body.explicitinertial = True
    body.mass, body.ipos = mass, centre
    body.fullinertia = [moment[0, 0], moment[1, 1], moment[2, 2], moment[0, 1], moment[0, 2], moment[1, 2]]


def add_hulls(spec: Any, body: Any, hulls: Iterable[Hull], object_side: bool = False) -> None:
    """Add the hulls to a body whose frame is the mesh's; they touch objects, or the other side where they are those."""
    for hull in hulls:
        add_shape(spec, body, describe_hull(hull), hull.shape, object_side)


def add_shape(spec: Any, body: Any, name: str, shape: Shape, object_side: bool = True, **fields: Any) -> Any:
    """Add a shape to a body as a geom, and return that; objects touch hulls, not each other. None where the shape has
    no volume."""
    fields |= {"contype": int(object_side), "conaffinity": int(not object_side)}
    if shape.is_primitive:
        return _primitive(body, name, shape, fields)
    if not spans_volume(shape.vertices):
        return None
    mesh = spec.add_mesh(name=name, uservert=np.asarray(shape.vertices).ravel())
    mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX
    return body.add_geom(name=name, type=_TYPES.mjGEOM_MESH, meshname=name, **fields)


def _primitive(body: Any, name: str, shape: Any, fields: dict[str, Any]) -> Any:
    match shape:
        case Box():
            kind, size = _TYPES.mjGEOM_BOX, shape.half
        case Sphere():
            kind, size = _TYPES.mjGEOM_SPHERE, np.array([shape.radius, 0.0, 0.0])
        case Ellipsoid():
            kind, size = _TYPES.mjGEOM_ELLIPSOID, shape.radii
        case Capsule():
            kind, size = _TYPES.mjGEOM_CAPSULE, np.array([shape.radius, shape.half_length, 0.0])
        case Cylinder():
            kind, size = _TYPES.mjGEOM_CYLINDER, np.array([shape.radius, shape.half_length, 0.0])
        case _:
            raise AssertionError(shape.kind)
    pose: Pose = shape.pose
    return body.add_geom(name=name, type=kind, size=size, pos=pose.translation, quat=pose.to_quaternion(), **fields)


def add_object(spec: Any, name: str, shape: Shape) -> Any:
    """Add a free body of 0.1 kg of that shape, which is given about the origin, at the origin; return it."""
    body = spec.worldbody.add_body(name=name)
    body.add_freejoint(name=name)
    weigh(body, [shape], 0.1)
    fields: dict[str, Any] = {}
    if isinstance(shape, _ROUND):
        radius = float(shape.aabb.size.min()) / 2
        fields = {"condim": 6, "friction": [FRICTION, 0.05 * radius, 0.02 * radius]}
    add_shape(spec, body, name, shape, **fields)
    return body


def place(model: Any, data: Any, name: str, at: Floats, rotation: Floats | None = None) -> None:
    """Put a free body of that name somewhere, at rest."""
    begin = model.joint(name).qposadr[0]
    turn = Pose.identity() if rotation is None else Pose(rotation, np.zeros(3))
    data.qpos[begin : begin + 7] = [*at, *turn.to_quaternion()]
