"""The rigid bodies of a scene and their masses, as physics extensions say them: about principal axes, in the frame
of a node."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from meshforge.formats.gltf.physics import KHR, OMI, is_body
from meshforge.formats.kinematic_tree import BodyTree
from meshforge.formats.meshfile.gltf_document import Json, extension, number, numbers
from meshforge.formats.meshfile.gltf_meshes import rotations_of
from meshforge.formats.meshfile.gltf_scene import GltfScene, Placement
from meshforge.geometry import Floats, Pose, Shape, inertia
from meshforge.symbolic import Asset, Body, Inertial

_SIZES = {"inertiaDiagonal": 3, "inertiaTensor": 9}


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


def read_motion(node: Json) -> Json:
    """What a node says of how it moves as a body: KHR's `motion`, else OMI's, whose older form is the extension itself.

    Zeros of OMI that leave the inertia to the engine are left out.
    """
    khr, omi = extension(node, KHR) or {}, extension(node, OMI) or {}
    if "motion" in khr:
        return khr["motion"] if isinstance(khr["motion"], dict) else {}
    motion = omi.get("motion", omi)
    own = motion.items() if isinstance(motion, dict) else ()
    return {key: value for key, value in own if key not in _SIZES or numbers(motion, key, _SIZES[key], ()).any()}


def read_inertial(placement: Placement, body: str, hulls: Sequence[Shape]) -> Inertial | None:
    """What a node that is a body weighs; hulls: of the body, whose inertia it has where it says none.

    None where it is endless, or where the file leaves that to the engine. Raises ValueError.
    """
    motion = read_motion(placement.node)
    mass, has_inertia = number(motion, "mass", 0.0), bool(_SIZES.keys() & motion.keys())
    if mass <= 0 or not (hulls or has_inertia):
        return None
    centre = placement.world @ np.array([*numbers(motion, "centerOfMass", 3, (0.0, 0.0, 0.0)), 1.0])
    if not has_inertia:
        return Inertial(body, mass, *inertia(hulls, mass, centre[:3] if "centerOfMass" in motion else None))
    moments, axes = _principal_axes(motion)
    if moments.min() <= 0:
        return None  # zero stands for endless
    axes = rigid_pose_of(placement).rotation @ axes
    return Inertial(body, mass, centre[:3], axes @ np.diag(moments) @ axes.T)


def explain_missing_mass(motion: Json) -> str:
    """Why a body that says its mass has none in the asset."""
    is_endless = number(motion, "mass", 0.0) <= 0 or _SIZES.keys() & motion.keys()
    return "they or their inertia are endless" if is_endless else "no hull of these bodies gives their inertia"


def _principal_axes(motion: Json) -> tuple[Floats, Floats]:
    """The moments (3,) that a motion says, and their axes (3, 3) in the frame of the body."""
    if "inertiaDiagonal" in motion:
        turn = rotations_of(numbers(motion, "inertiaOrientation", 4, (0.0, 0.0, 0.0, 1.0)))
        return numbers(motion, "inertiaDiagonal", 3, ()), turn
    moments, axes = np.linalg.eigh(numbers(motion, "inertiaTensor", 9, ()).reshape(3, 3))
    return moments, axes


def body_nodes(scene: GltfScene) -> dict[int, int]:
    """For each node of the scene in a body, the node that is that body: itself, or the nearest one above."""
    found: dict[int, int] = {}
    for index, placement in scene.placements.items():
        if is_body(placement.node):
            found[index] = index
        elif placement.parent in found:
            found[index] = found[placement.parent]
    return found


def rigid_pose_of(placement: Placement) -> Pose:
    """The pose of a node without its scale: the rotation nearest to its map."""
    left, _, right = np.linalg.svd(placement.linear)
    rotation = left @ right
    if np.linalg.det(rotation) < 0:
        rotation = left @ np.diag([1.0, 1.0, -1.0]) @ right
    return Pose(rotation, placement.offset)
