"""The joints and masses of an asset, in one form for all formats that have them."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from meshforge.geometry import Floats, Pose, freeze_floats

JointKind = Literal["fixed", "revolute", "prismatic", "ball", "floating", "planar"]


@dataclass(frozen=True, eq=False, slots=True)
class Joint:
    """How a body moves against another, described where all joints are at zero.

    name: empty where the file gives none; parent, child: the bodies it joins.
    anchor: (3,), a point of the axis, or the centre of a ball [m]; axis: (3,), of unit length, the normal of a planar
    joint; both in the root frame. limits: [rad] or [m] from zero, None where there are none.
    damping, friction: of the file, 0 where it tells none; effort [N or Nm], velocity [m/s or rad/s]: the largest, None
    where it tells none. Several joints of one child act one after another, the first one nearest to the parent.
    """

    name: str
    kind: JointKind
    parent: str
    child: str
    anchor: Floats
    axis: Floats
    limits: tuple[float, float] | None = None
    damping: float = 0.0
    friction: float = 0.0
    effort: float | None = None
    velocity: float | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "anchor", freeze_floats(self.anchor, (3,)))
        object.__setattr__(self, "axis", freeze_floats(self.axis, (3,)))


@dataclass(frozen=True, eq=False, slots=True)
class Inertial:
    """What a body weighs: mass [kg], centre (3,) of mass [m], inertia (3, 3) about it [kg m^2], in the root frame."""

    body: str
    mass: float
    centre: Floats
    inertia: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "centre", freeze_floats(self.centre, (3,)))
        object.__setattr__(self, "inertia", freeze_floats(self.inertia, (3, 3)))


@dataclass(frozen=True, eq=False, slots=True)
class Mechanism:
    """The joints of an asset, which make its bodies one or more trees, and the masses that the file tells.

    apart: pairs of bodies that the file keeps from colliding; paired: pairs of geoms that it has collide all the same,
    whatever their bodies and contact attributes.
    """

    joints: tuple[Joint, ...] = ()
    inertials: tuple[Inertial, ...] = field(default=())
    apart: tuple[tuple[str, str], ...] = ()
    paired: tuple[tuple[str, str], ...] = ()

    def move(self, pose: Pose) -> Mechanism:
        """The mechanism in another root frame; pose: new_T_old."""
        turn = pose.rotation
        return replace(
            self,
            joints=tuple(
                replace(j, anchor=turn @ j.anchor + pose.translation, axis=turn @ j.axis) for j in self.joints
            ),
            inertials=tuple(
                Inertial(i.body, i.mass, turn @ i.centre + pose.translation, turn @ i.inertia @ turn.T)
                for i in self.inertials
            ),
        )


def unit_vector(axis: Floats) -> Floats | None:
    """An axis (3,) in unit length; None where it has no direction."""
    length = float(np.linalg.norm(axis))
    return axis / length if length > 0 else None
