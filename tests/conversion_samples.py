"""Assets with a bit of everything that conversions between formats have to carry, made in memory."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from meshforge.formats.visuals import Visual, VisualSurfaces
from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Pose, Shape, Sphere, convex_hull
from meshforge.symbolic import Asset, Body, Document, Geom, Inertial, Joint, Mechanism, NonConvexPiece, Surface
from tests.soups import angle

TURNED = Pose.from_rpy([1, 2, 3], [0.4, -1.1, 2.0])
NEAR = Pose.of_translation([0.2, 0.5, 0.25])


def foreign(bodies: dict[str, Pose], geoms: list[tuple[str, str, Shape]], *opaque: NonConvexPiece) -> Asset:
    """An asset of no format that is known; geoms as name, body and shape."""
    made = tuple(Geom(name, body, shape) for name, body, shape in geoms)
    return Asset(Path("x.foo"), "foo", tuple(Body(n, p) for n, p in bodies.items()), made, Document(), opaque)


def block(x: float, y: float, z: float, half: float = 0.1) -> Box:
    """An axis-aligned box about a point."""
    return Box(Pose.of_translation([x, y, z]), np.array([half, 2 * half, 3 * half]))


def wedge(x: float) -> Shape:
    """A hull that is no primitive."""
    return convex_hull(np.array([[x, 0, 0], [x + 1, 0, 0], [x, 1, 0], [x, 0, 0.5], [x + 1, 0, 0.25], [x, 1, 0.7]]))


def inertial(body: str, mass: float, centre: tuple[float, float, float], turn: Pose = TURNED) -> Inertial:
    """A mass whose principal axes are turned against all else."""
    return Inertial(body, mass, np.array(centre), turn.rotation @ np.diag([0.1, 0.2, 0.25]) @ turn.rotation.T)


def primitives() -> Asset:
    """One body with a shape of each kind, apart from each other."""
    return foreign(
        {"all": Pose.identity()},
        [
            ("all/box", "all", Box(TURNED, np.array([0.1, 0.2, 0.3]))),
            ("all/ball", "all", Sphere(Pose.of_translation([4, 0, 0]), 0.4)),
            ("all/tube", "all", Cylinder(Pose(TURNED.rotation, [6, 0, 0]), 0.2, 0.5)),
            ("all/pill", "all", Capsule(Pose(TURNED.rotation, [8, 0, 1]), 0.2, 0.5)),
            ("all/egg", "all", Ellipsoid(Pose(TURNED.rotation, [10, 0, 0]), np.array([0.2, 0.3, 0.5]))),
            ("all/wedge", "all", wedge(12)),
        ],
    )


def doors() -> Asset:
    """A frame with a door that turns within limits, a handle fixed to it, a drawer, and a wheel that turns for ever."""
    frame, door = Pose.identity(), Pose(TURNED.rotation, [0.5, 0.5, 0])
    handle, drawer, wheel = door @ NEAR, Pose.of_translation([0, 0, 2]), Pose.of_translation([-1, 0, 0.1])
    axis = TURNED.rotation[:, 2]
    asset = foreign(
        {"frame": frame, "door": door, "handle": handle, "drawer": drawer, "wheel": wheel},
        [
            ("frame/board", "frame", block(0, 0, 0)),
            ("frame/geom1", "frame", wedge(3)),
            ("door/board", "door", Box(door, np.array([0.3, 0.02, 0.5]))),
            ("handle/bar", "handle", Cylinder(handle, 0.01, 0.1)),
            ("drawer/front", "drawer", block(0, 0, 2)),
            ("wheel/tyre", "wheel", Cylinder(wheel, 0.3, 0.05)),
        ],
    )
    joints = (
        Joint("hinge", "revolute", "frame", "door", door.translation, axis, (-0.5, 1.25), damping=0.3, effort=40.0),
        Joint("grip", "fixed", "door", "handle", handle.translation, axis),
        Joint("rail", "prismatic", "frame", "drawer", drawer.translation, np.array([0.6, 0.8, 0]), (0.0, 0.4)),
        Joint("axle", "revolute", "frame", "wheel", wheel.translation, np.array([0, 0, 1.0]), friction=0.2),
    )
    masses = tuple(inertial(body.name, k + 1.5, (0.1, k, 0.2)) for k, body in enumerate(asset.bodies))
    red, none = (1.0, 0.25, 0.0, 1.0), np.zeros(3)
    visuals = VisualSurfaces(
        (
            Visual("door", Box(door, np.array([0.31, 0.03, 0.51])), np.eye(3), none, red),
            Visual("frame", wedge(3), np.eye(3), none),
        )
    )
    return replace(asset, mechanism=Mechanism(joints, masses), visuals=visuals)


def crowd() -> Asset:
    """Bodies apart, without joints, with hulls of the same names and without names."""
    bodies = {"left": Pose.of_translation([-2, 0, 0]), "right": TURNED, "base": Pose.identity()}
    return foreign(
        bodies,
        [
            ("left/part", "left", block(-2, 0, 0)),
            ("left/geom1", "left", wedge(-5)),
            ("right/part", "right", Sphere(TURNED, 0.2)),
            ("right/geom1", "right", block(1, 2, 5)),
            ("base/geom0", "base", block(0, 0, 0)),
        ],
    )


def opaque() -> Asset:
    """A hull, an angle that is no hull, and an endless plane."""
    vertices, faces = angle()
    return foreign(
        {"room": Pose.identity()},
        [("room/stool", "room", block(0, 0, 8))],
        NonConvexPiece("room/walls", "room", "not convex", Surface(vertices, faces)),
        NonConvexPiece("room/floor", "room", "a plane has no end", plane=Pose.of_translation([0, 0, -1])),
    )


SAMPLES = {"primitives": primitives, "doors": doors, "crowd": crowd, "opaque": opaque}
