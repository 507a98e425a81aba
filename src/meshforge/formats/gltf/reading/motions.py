"""The masses of bodies, as KHR_physics_rigid_bodies tells them: in the frame of a body's node, about principal axes."""

from __future__ import annotations

import numpy as np

from meshforge.asset import Asset, Body, Inertial
from meshforge.formats.body_tree import BodyTree
from meshforge.formats.gltf.reading.bodies import rigid
from meshforge.formats.gltf.reading.physics import KHR
from meshforge.formats.meshfile.gltf import Json, Placement
from meshforge.formats.meshfile.gltf.items import extension, number, numbers
from meshforge.formats.meshfile.gltf.scene import turn_of
from meshforge.geometry import Pose


def motion_of(asset: Asset, body: Body) -> Json:
    """The `motion` of a body: kinematic where it is the fixed part of something with joints; its mass where known."""
    tree = BodyTree.of(asset)
    motion: Json = {"isKinematic": True} if asset.mechanism.joints and tree.is_static(body.name) else {}
    inertial = next((known for known in asset.mechanism.inertials if known.body == body.name), None)
    if inertial is None or inertial.mass <= 0:
        return motion
    turn = body.pose.rotation
    diagonal, axes = np.linalg.eigh(turn.T @ inertial.inertia @ turn)
    axes = axes * np.sign(np.linalg.det(axes))
    w, x, y, z = Pose(axes, np.zeros(3)).to_quaternion().tolist()
    motion |= {"mass": inertial.mass, "centerOfMass": body.pose.inverse().apply(inertial.centre[None])[0].tolist()}
    if diagonal.min() > 0:
        motion |= {"inertiaDiagonal": diagonal.tolist(), "inertiaOrientation": [x, y, z, w]}
    return motion


def inertial_of(placement: Placement, body: str) -> Inertial | None:
    """What a node that is a body weighs; None where the file leaves that to the engine. Raises ValueError."""
    motion = (extension(placement.node, KHR) or {}).get("motion", {})
    if not isinstance(motion, dict) or not {"mass", "inertiaDiagonal"} <= motion.keys():
        return None
    mass, diagonal = number(motion, "mass", 0.0), numbers(motion, "inertiaDiagonal", 3, ())
    if mass <= 0 or diagonal.min() <= 0:
        return None  # zero stands for endless
    pose = rigid(placement)
    axes = pose.rotation @ turn_of(numbers(motion, "inertiaOrientation", 4, (0.0, 0.0, 0.0, 1.0)))
    centre = placement.world @ np.array([*numbers(motion, "centerOfMass", 3, (0.0, 0.0, 0.0)), 1.0])
    return Inertial(body, mass, centre[:3], axes @ np.diag(diagonal) @ axes.T)
