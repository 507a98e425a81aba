"""Motion of hulls themselves: dropped from 1 cm as one rigid body they end upright; what a joint moves goes through its
range and does not touch the rest."""

from collections.abc import Iterator, Sequence
from typing import Any

import mujoco
import numpy as np
from scipy.spatial import ConvexHull, QhullError

from meshforge.checks.physics.scene import (
    BREAKS_DOWN,
    Failure,
    Motion,
    Place,
    Touch,
    add_hulls,
    add_shape,
    advance,
    blank,
    calm,
    collide,
    list_touches,
    mm,
    weigh,
)
from meshforge.geometry import Box, Floats, Polytope, Pose, Shape, Sphere
from meshforge.symbolic import Hull

_DROP, _SECONDS, _LOOK = 0.01, 2.0, 0.05
_TILT, _LOST = 2.0, 25.0  # degrees: upright; no way back
_CALM_FOR = 4  # looks
_LEAN = 0.3  # degrees, at which it is dropped: what merely balances falls
_GIVE = 0.02  # of the floor, like wood [s]: on a stiffer one what is tall rocks on
_POINT = 1e-4  # radius of a corner, of the mesh's diagonal
_LEANING = Pose.from_rpy((0, 0, 0), tuple(np.radians(_LEAN) * np.array([0.8, 0.6, 0.0])))


def try_stand(hulls: Sequence[Hull], diagonal: float) -> Failure | None:
    """Return why hulls, Z up and of one density, do not stand: by how much they tilt, or that they do not rest in time;
    None where they do. diagonal: of the mesh [m]."""
    model = _build_drop([hull.shape for hull in hulls], diagonal)
    data = mujoco.MjData(model)
    still = 0
    while data.time < _SECONDS and still < _CALM_FOR:
        if not advance(model, data, _LOOK):
            return Failure(BREAKS_DOWN)
        if _tilt(data) > _LOST:
            return Failure(f"it falls over within {data.time:.2f} s")
        still = still + 1 if data.ncon and calm(data, turning=0.005) else 0
    if _tilt(data) >= _TILT:
        return Failure(f"it tilts by {_tilt(data):.1f} degrees")
    moving = f"it is not at rest after {_SECONDS:.0f} s, tilted by {_tilt(data):.1f} degrees"
    return None if still else Failure(moving)


def _tilt(data: Any) -> float:
    """Of the body against upright [degrees]."""
    return float(np.degrees(np.arccos(np.clip(data.body("asset").xmat[8], -1.0, 1.0))))


def _build_drop(shapes: Sequence[Shape], diagonal: float) -> Any:
    """A floor, and the hulls above it: a flat floor touches corners and round shapes only, so these are the geoms."""
    spec = blank(give=_GIVE)
    floor = spec.worldbody.add_geom(name="floor", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[10, 10, 1])
    floor.contype, floor.conaffinity = 1, 0
    down = -_LEANING.rotation[2]
    foot = -max(float(down @ shape.support(down)) for shape in shapes)
    body = spec.worldbody.add_body(name="asset", pos=[0.0, 0.0, _DROP - foot])
    body.quat = _LEANING.to_quaternion()
    body.add_freejoint()
    weigh(body, shapes)
    for k, shape in enumerate(_list_feet(shapes, _POINT * diagonal)):
        add_shape(spec, body, f"{shape.kind} {k}", shape, object_side=False)
    return spec.compile()


def _list_feet(shapes: Sequence[Shape], radius: float) -> list[Shape]:
    """The corners of the convex hull of all angular shapes as balls within it, and the round shapes."""
    angular = [shape.vertices for shape in shapes if isinstance(shape, Polytope | Box)]
    others = [shape for shape in shapes if not isinstance(shape, Polytope | Box)]
    corners = _find_corners(np.concatenate(angular)) if angular else []
    lifted = np.array([0.0, 0.0, radius])
    return [*(Sphere(Pose.of_translation(corner + lifted), radius) for corner in corners), *others]


def _find_corners(points: Floats) -> list[Floats]:
    try:
        return list(points[ConvexHull(points).vertices])
    except QhullError:
        return list(points)


_ARC = 2.0  # of the tolerance, how far the outermost point goes between two looks
_FINEST, _COARSEST = 0.25, 0.5  # degrees between two looks
_MOST_LOOKS = 2000

NO_PAIRS: frozenset[frozenset[str]] = frozenset()


def try_swing(
    moving: Sequence[Hull],
    rest: Sequence[Hull],
    joint: Place,
    touching: float,
    motion: Motion = "hinge",
    apart: frozenset[frozenset[str]] = NO_PAIRS,
) -> Failure | None:
    """Return which hulls meet, where on the way, and how deep; None where none do.

    joint: through `at`, along its first axis; size: from where to where it goes, [degrees] of a hinge, [m] of a slide.
    apart: pairs of names of hulls that may be in each other.
    """
    for at, touches in watch_joint(moving, rest, joint, touching, motion):
        if touch := next((one for one in touches if not apart or one.pair not in apart), None):
            text = f"{describe_place(at, motion)} {touch.mover} is {mm(touch.depth)} in {touch.other}"
            return Failure(text, touch.names([*moving, *rest]))
    return None


def describe_place(at: float, motion: Motion) -> str:
    """Return where on its way a joint is, in words."""
    return f"at {at:.0f} degrees" if motion == "hinge" else f"pulled out by {mm(at)}"


def watch_joint(
    moving: Sequence[Hull], rest: Sequence[Hull], joint: Place, touching: float, motion: Motion
) -> Iterator[tuple[float, Iterator[Touch]]]:
    """Yield where a joint is on its way, as `try_swing` has it, and what is deeper in each other there than `touching`
    [m], the deepest first."""
    model = _build_joint(moving, rest, joint, motion)
    data = mujoco.MjData(model)
    for at in _list_looks(moving, joint, touching, motion):
        data.qpos[0] = np.radians(at) if motion == "hinge" else at
        collide(model, data)
        yield float(at), list_touches(model, data, touching)


def _build_joint(moving: Sequence[Hull], rest: Sequence[Hull], joint: Place, motion: Motion) -> Any:
    spec = blank()
    add_hulls(spec, spec.worldbody, rest)
    body = spec.worldbody.add_body(name="leaf")
    kind = mujoco.mjtJoint.mjJNT_HINGE if motion == "hinge" else mujoco.mjtJoint.mjJNT_SLIDE
    body.add_joint(name="hinge", type=kind, pos=joint.at, axis=joint.axes[:, 0])
    body.explicitinertial, body.mass, body.inertia = True, 1.0, [1.0, 1.0, 1.0]
    add_hulls(spec, body, moving, object_side=True)
    return spec.compile()


def _list_looks(moving: Sequence[Hull], joint: Place, touching: float, motion: Motion) -> Floats:
    """Where on the way to look, so close that nothing is missed."""
    begin, end = joint.size[:2]
    if motion == "slide":
        count = int(np.ceil(abs(end - begin) / (_ARC * touching)))
        return np.linspace(begin, end, min(max(2, count + 1), _MOST_LOOKS))
    points = np.concatenate([hull.vertices for hull in moving]) - joint.at
    reach = float(np.linalg.norm(np.cross(points, joint.axes[:, 0]), axis=1).max())
    step = float(np.clip(np.degrees(_ARC * touching / reach), _FINEST, _COARSEST))
    return np.linspace(begin, end, max(2, int(np.ceil(abs(end - begin) / step)) + 1))
