"""What physics extensions say of a scene: which nodes are bodies, the shapes they collide with, and their masses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from meshforge.formats.collision_pieces import CollisionPiece, build_solid, end_points
from meshforge.formats.gltf.document import Convention
from meshforge.formats.kinematic_tree import BodyTree, drop_rounding
from meshforge.formats.meshfile.gltf_document import Json, entry, extension, number, numbers
from meshforge.formats.meshfile.gltf_meshes import rotations_of
from meshforge.formats.meshfile.gltf_scene import GltfScene, Placement
from meshforge.geometry import Box, Capsule, Cylinder, Floats, Pose, Shape, Sphere, convex_hull, inertia
from meshforge.symbolic import Asset, Body, Inertial

KHR, SHAPES = "KHR_physics_rigid_bodies", "KHR_implicit_shapes"
OMI, OMI_SHAPES = "OMI_physics_body", "OMI_physics_shape"
_MESHES = ("mesh", "convex", "trimesh")
_KHR_DEFAULT = (0.25, 0.5, 0.5)
_OMI_DEFAULT = (0.5, 2.0, 1.0)

Z_TO_Y = Pose([[1, 0, 0], [0, 0, 1], [0, -1, 0]], np.zeros(3))
"""Takes the axis of our own shapes, Z, to that of glTF's."""


@dataclass(frozen=True, eq=False, slots=True)
class Collider:
    """What a node collides with: a shape in its own space, or a mesh by its number, taken as one hull or as it is."""

    shape: CollisionPiece | None = None
    mesh: Any = None
    convex: bool = False


def physics_extension_of(scene: GltfScene) -> Convention | None:
    """The extension that marks the colliders of a file: the first that any node of the scene uses."""
    nodes = [placement.node for placement in scene.placements.values()]
    found: tuple[Convention, ...] = ("khr", "omi")
    return next((kind for kind in found if any(has_collider(node, kind) for node in nodes)), None)


def has_collider(node: Json, kind: Convention) -> bool:
    """Whether a node collides, by that extension; a trigger does not."""
    if kind == "khr":
        return bool((extension(node, KHR) or {}).get("collider"))
    own = (extension(node, OMI) or {}).get("collider")
    return kind == "omi" and isinstance(own, dict) and own.get("shape", -1) != -1


def is_trigger(node: Json) -> bool:
    """Whether a node detects bodies without colliding."""
    return any("trigger" in (extension(node, name) or {}) for name in (KHR, OMI))


def collider_of(placement: Placement, kind: Convention, scene: GltfScene) -> Collider:
    """What a node that has a collider collides with. Raises ValueError: something that is not there."""
    if kind == "khr":
        return _read_khr_collider(_require_object(extension(placement.node, KHR) or {}, "collider"), scene)
    shapes = extension(scene.tree, OMI_SHAPES) or {}
    index = _require_object(extension(placement.node, OMI) or {}, "collider")["shape"]
    return _collider_of_shape(entry(shapes, "shapes", index), _OMI_DEFAULT)


def _read_khr_collider(collider: Json, scene: GltfScene) -> Collider:
    geometry = _require_object(collider, "geometry")
    convex = bool(geometry.get("convexHull", False))
    if "mesh" in geometry:
        return Collider(mesh=geometry["mesh"], convex=convex)
    if "node" in geometry:
        return Collider(mesh=entry(scene.tree, "nodes", geometry["node"]).get("mesh"), convex=convex)
    shape = entry(extension(scene.tree, SHAPES) or {}, "shapes", geometry["shape"])
    return _collider_of_shape(shape, _KHR_DEFAULT, convex=convex)


def _collider_of_shape(shape: Json, default: tuple[float, float, float], *, convex: bool = False) -> Collider:
    kind = shape["type"]
    own = _require_object(shape, kind) if kind in shape else {}
    if kind in _MESHES:
        return Collider(mesh=own.get("mesh"), convex=convex or kind == "convex")
    return Collider(shape=read_shape(str(kind), own, default))


def _require_object(owner: Json, key: str) -> Json:
    found = owner[key]
    if not isinstance(found, dict):
        raise ValueError(f"its {key!r} is no object")
    return found


def read_shape(kind: str, own: Json, default: tuple[float, float, float]) -> CollisionPiece:
    """The shape of a type with its parameters; a tapered one, which no engine has natively, as a polytope.

    default: radius of cylinders and capsules, height of cylinders, height of capsules, which the specifications set
    apart; a capsule with one `radius` (an older form) says its whole height. Raises ValueError: no number.
    """
    match kind:
        case "box":
            size = numbers(own, "size", 3, (1.0, 1.0, 1.0))
            return build_solid("box", size, lambda: Box(Pose.identity(), size / 2))
        case "sphere":
            radius = number(own, "radius", 0.5)
            return build_solid("sphere", [radius], lambda: Sphere(Pose.identity(), radius))
        case "cylinder" | "capsule":
            return _build_round(kind, own, default)
        case "plane":
            return CollisionPiece(None, "a plane has no end", plane=Z_TO_Y)
    return CollisionPiece(None, f"a shape of type {kind!r} is not known")


def _build_round(kind: str, own: Json, default: tuple[float, float, float]) -> CollisionPiece:
    radius, of_cylinder, of_capsule = default
    if "radius" in own:
        top = bottom = number(own, "radius", radius)
        height = number(own, "height", 2.0) - (2 * top if kind == "capsule" else 0.0)
    else:
        top, bottom = number(own, "radiusTop", radius), number(own, "radiusBottom", radius)
        height = number(own, "height", of_cylinder if kind == "cylinder" else of_capsule)
    sizes = [max(top, bottom), height]
    if kind == "capsule" and abs(height) <= 1e-9 * sizes[0]:
        return build_solid("sphere", sizes[:1], lambda: Sphere(Pose.identity(), top))
    if top == bottom:
        make = Cylinder if kind == "cylinder" else Capsule
        return build_solid(kind, sizes, lambda: make(Z_TO_Y, top, height / 2))
    if min(top, bottom) < 0:
        return CollisionPiece(None, f"a {kind} of negative radius")
    ball = kind == "capsule"
    ends = [end_points(top, height / 2, ball=ball, axis=1), end_points(bottom, -height / 2, ball=ball, axis=1)]
    return build_solid(kind, sizes, lambda: convex_hull(np.concatenate(ends)))


_SIZES = {"inertiaDiagonal": 3, "inertiaTensor": 9}


def motion_of(asset: Asset, body: Body) -> Json:
    """The `motion` of a body: kinematic where it is the fixed part of something with joints; its mass where known."""
    kinematic = asset.mechanism.joints and BodyTree.of(asset).is_static(body.name)
    return {"isKinematic": True, **mass_keys(asset, body)} if kinematic else mass_keys(asset, body)


def mass_keys(asset: Asset, body: Body) -> Json:
    """The mass of a body as a motion has it, moments about its own axes where these are principal ones."""
    inertial = next((known for known in asset.mechanism.inertials if known.body == body.name), None)
    if inertial is None or inertial.mass <= 0:
        return {}
    keys: Json = {"mass": inertial.mass}
    keys["centerOfMass"] = body.pose.inverse().apply(inertial.centre[None])[0].tolist()
    tensor = drop_rounding(body.pose.rotation.T @ inertial.inertia @ body.pose.rotation)
    diagonal, axes = np.diag(tensor), np.eye(3)
    if not np.array_equal(tensor, np.diag(diagonal)):
        diagonal, axes = np.linalg.eigh(tensor)
        axes = axes * np.sign(np.linalg.det(axes))
    if diagonal.min() > 0:
        w, x, y, z = Pose(axes, np.zeros(3)).to_quaternion().tolist()
        keys |= {"inertiaDiagonal": diagonal.tolist(), "inertiaOrientation": [x, y, z, w]}
    return keys


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
        own = extension(placement.node, OMI) or {}
        if "motion" in (extension(placement.node, KHR) or {}) or "motion" in own or "type" in own:  # OMI's older form
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
