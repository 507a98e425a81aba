"""MuJoCo scenes of hulls where they are, Z up, and objects that are tried on them; what touches what there, how deep,
and why something does not work."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Floats, Pose, Shape, Sphere, inertia, spans_volume
from meshforge.symbolic import Hull

TOLERANCE = 0.002
"""What counts as touching, of the diagonal of an asset."""


Motion = Literal["hinge", "slide"]
"""How a joint moves."""


@dataclass(frozen=True, eq=False, slots=True)
class Place:
    """Where something is tried. at: (3,) [m]; size: (3,) along the axes [m]; axes: columns of a rotation (3, 3)."""

    at: Floats
    size: Floats
    axes: Floats


def frame_of_axis(axis: Floats) -> Floats:
    """Return a rotation (3, 3) whose first column is an axis (3,)."""
    helper = np.eye(3)[int(np.abs(axis).argmin())]
    second = np.cross(axis, helper)
    second /= np.linalg.norm(second)
    return np.stack([axis, second, np.cross(axis, second)], axis=1)


@dataclass(frozen=True, eq=False, slots=True)
class Failure:
    """Why something does not work, in a sentence. hulls: names of those at fault; objects: what was tried, where."""

    text: str
    hulls: tuple[str, ...] = ()
    objects: tuple[Shape, ...] = ()

    def __str__(self) -> str:
        return self.text


def describe_hull(hull: Hull) -> str:
    """Return a hull in words, which are also the name of its geom."""
    return f"{hull.name} ({hull.label or 'no label'})"


def mm(length: float) -> str:
    """Return a length [m] in words."""
    return f"{1000 * length:.1f} mm"


FRICTION = 0.6
_ROUND = (Capsule, Cylinder, Ellipsoid, Sphere)


def step_for(size: float) -> float:
    """Return the time step [s] at which things of that half extent [m] do not tunnel and are calm."""
    return float(np.clip(0.02 * np.sqrt(size), 0.0005, 0.002))


def blank(step: float = 0.002, gravity: float = 9.81, give: float = 0.0) -> Any:
    """Return an empty scene; step [s], gravity [m/s^2]; give: how slowly contacts resist [s], by default at once."""
    import mujoco  # lazy: 0.3 s

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
    """Add a shape to a body as a geom, and return that; objects touch hulls alone. None where it has no volume."""
    import mujoco  # lazy: as above

    fields |= {"contype": int(object_side), "conaffinity": int(not object_side)}
    if shape.is_primitive:
        return _primitive(body, name, shape, fields)
    if not spans_volume(shape.vertices):
        return None
    mesh = spec.add_mesh(name=name, uservert=np.asarray(shape.vertices).ravel())
    mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX
    return body.add_geom(name=name, type=mujoco.mjtGeom.mjGEOM_MESH, meshname=name, **fields)


def _primitive(body: Any, name: str, shape: Any, fields: dict[str, Any]) -> Any:
    import mujoco  # lazy: as above

    types = mujoco.mjtGeom
    match shape:
        case Box():
            kind, size = types.mjGEOM_BOX, shape.half
        case Sphere():
            kind, size = types.mjGEOM_SPHERE, np.array([shape.radius, 0.0, 0.0])
        case Ellipsoid():
            kind, size = types.mjGEOM_ELLIPSOID, shape.radii
        case Capsule():
            kind, size = types.mjGEOM_CAPSULE, np.array([shape.radius, shape.half_length, 0.0])
        case Cylinder():
            kind, size = types.mjGEOM_CYLINDER, np.array([shape.radius, shape.half_length, 0.0])
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


BREAKS_DOWN = "the simulation breaks down"


@dataclass(frozen=True, eq=False, slots=True)
class Touch:
    """Two geoms by name, the object first, how deep they are in each other [m], and where: (3,)."""

    mover: str
    other: str
    depth: float
    at: Floats

    @property
    def pair(self) -> frozenset[str]:
        """The names of the two hulls."""
        return frozenset(name.rpartition(" (")[0] for name in (self.mover, self.other))

    def names(self, hulls: Iterable[Hull]) -> tuple[str, ...]:
        """Return the names of those hulls that touch."""
        return tuple(hull.name for hull in hulls if describe_hull(hull) in (self.mover, self.other))


def collide(model: Any, data: Any) -> None:
    """Find all contacts for the positions as they are set."""
    import mujoco  # lazy: as above

    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_collision(model, data)


def deepest(model: Any, data: Any, least: float, apart: frozenset[frozenset[str]] = frozenset()) -> Touch | None:
    """Return the deepest contact deeper than `least` [m], None where there is none; apart: pairs of names of hulls
    whose contacts do not count."""
    return next((touch for touch in list_touches(model, data, least) if not apart or touch.pair not in apart), None)


def list_touches(model: Any, data: Any, least: float) -> Iterator[Touch]:
    """Yield the contacts deeper than `least` [m], the deepest first."""
    contact = data.contact
    for k in np.argsort(contact.dist, kind="stable"):
        depth = -float(contact.dist[k])
        if depth <= least:
            return
        pair = sorted(map(int, contact.geom[k]), key=lambda geom: -int(model.geom_contype[geom]))
        mover, other = (model.geom(geom).name for geom in pair)
        yield Touch(mover, other, depth, contact.pos[k].copy())


def advance(model: Any, data: Any, seconds: float) -> bool:
    """Simulate for so long; return whether the simulation holds up."""
    import mujoco  # lazy: as above

    steps = max(1, round(seconds / model.opt.timestep))
    mujoco.mj_step(model, data, nstep=steps)
    return not any(warning.number for warning in data.warning)


def calm(data: Any, speed: float = 0.001, turning: float = 0.01) -> bool:
    """Return whether all free bodies are at rest: speed [m/s], turning [rad/s]."""
    velocity = np.abs(np.asarray(data.qvel).reshape(-1, 6))
    return bool(velocity[:, :3].max() < speed and velocity[:, 3:].max() < turning)
