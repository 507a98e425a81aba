"""Swings: what a joint moves goes through its range and does not touch the rest."""

from collections.abc import Sequence
from typing import Any, Literal

import mujoco
import numpy as np

from meshforge.checks.trials.contact import collide, deepest
from meshforge.checks.trials.place import Failure, Place, mm
from meshforge.checks.trials.scene import add_hulls, blank
from meshforge.geometry import Floats
from meshforge.symbolic import Hull

_ARC = 2.0  # of the tolerance, how far the outermost point goes between two looks
_FINEST, _COARSEST = 0.25, 0.5  # degrees between two looks
_MOST_LOOKS = 2000

Motion = Literal["hinge", "slide"]
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
    model = _build_scene(moving, rest, joint, motion)
    data = mujoco.MjData(model)
    for at in _list_looks(moving, joint, touching, motion):
        data.qpos[0] = np.radians(at) if motion == "hinge" else at
        collide(model, data)
        if touch := deepest(model, data, touching, apart):
            where = f"at {at:.0f} degrees" if motion == "hinge" else f"pulled out by {mm(at)}"
            return Failure(
                f"{where} {touch.mover} is {mm(touch.depth)} in {touch.other}", touch.names([*moving, *rest])
            )
    return None


def _build_scene(moving: Sequence[Hull], rest: Sequence[Hull], joint: Place, motion: Motion) -> Any:
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
