"""The masses of an MJCF that is made, such as MuJoCo takes them."""

from __future__ import annotations

import numpy as np

from meshforge.asset import Inertial
from meshforge.formats.mjcf.elements import inertial_attributes, tag
from meshforge.formats.numbers import tidy
from meshforge.geometry import Floats, Pose

LIGHT = 1e-6
"""The mass [kg] of a moving body that has none; MuJoCo refuses to move nothing."""
LEAST = 1e-9
"""The least mass [kg] that a moving body is left with."""
_LEAST_MOMENT = 1e-14  # [kg m^2]; MuJoCo refuses less than 1e-15
_LIGHT_MOMENT = 1e-9  # [kg m^2], that of LIGHT about 3 cm away
_SLIGHT = 1e-6  # of the largest moment, by which two may fall short of the third through rounding


def inertial_tag(inertial: Inertial, root_t_body: Pose) -> tuple[bytes, bool]:
    """The `<inertial>` of a body; and whether its moments had to be changed, being those of no rigid body."""
    turn = root_t_body.rotation.T
    moments, axes = _principal(tidy(turn @ inertial.inertia @ turn.T))
    legal = _legal(moments, inertial.mass)
    centre = tidy(turn @ (inertial.centre - root_t_body.translation), 1.0)
    quaternion = Pose(axes, np.zeros(3)).to_quaternion()
    text = tag("inertial", inertial_attributes(inertial.mass, centre, quaternion, legal))
    return text, not np.allclose(legal, moments, rtol=_SLIGHT, atol=0)


def light_tag() -> bytes:
    """The `<inertial>` of a body without a mass."""
    moments = np.full(3, _LIGHT_MOMENT)
    return tag("inertial", inertial_attributes(LIGHT, np.zeros(3), np.array([1.0, 0, 0, 0]), moments))


def _principal(inertia: Floats) -> tuple[Floats, Floats]:
    """The principal moments (3,) and their axes, a rotation (3, 3); the given axes where these are principal."""
    if not (inertia - np.diag(np.diag(inertia))).any():
        return np.diag(inertia).copy(), np.eye(3)
    moments, axes = np.linalg.eigh(inertia)
    return moments, axes * (1.0 if np.linalg.det(axes) > 0 else -1.0)


def _legal(moments: Floats, mass: float) -> Floats:
    """Moments that a rigid body can have: positive, no one larger than the two others together.

    Others become their mean, as MuJoCo has it where it is told to mend them.
    """
    largest = int(np.argmax(moments))
    others = float(moments.sum() - moments[largest])
    excess = float(moments[largest]) - others
    if moments.min() > _LEAST_MOMENT and excess <= 0:
        return moments
    if moments.min() > _LEAST_MOMENT and excess <= _SLIGHT * moments[largest]:
        mended = moments.copy()
        mended[largest] = others * (1 - 1e-12)
        return mended
    return np.full(3, max(float(moments.mean()), _LIGHT_MOMENT * mass, _LEAST_MOMENT))
