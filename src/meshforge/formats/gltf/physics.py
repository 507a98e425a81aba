"""What physics extensions say of a scene: which nodes are bodies, and the shapes they collide with; and the masses of
bodies that are written."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from meshforge.formats.collision_pieces import CollisionPiece, build_round, build_solid
from meshforge.formats.gltf.document import Convention
from meshforge.formats.kinematic_tree import BodyTree, drop_rounding
from meshforge.formats.meshfile.gltf_document import Json, entry, extension, number, numbers
from meshforge.formats.meshfile.gltf_scene import GltfScene, Placement
from meshforge.geometry import Box, Pose, Sphere, principal_axes
from meshforge.symbolic import Asset, Body

KHR, OMI = "KHR_physics_rigid_bodies", "OMI_physics_body"
_MESHES = ("mesh", "convex", "trimesh")

Z_TO_Y = Pose([[1, 0, 0], [0, 0, 1], [0, -1, 0]], np.zeros(3))
"""Takes the axis of our own shapes, Z, to that of glTF's."""


@dataclass(frozen=True, slots=True)
class PhysicsExtension:
    """An extension that marks bodies and colliders; shapes: the one that lists their shapes.

    defaults: radius of cylinders and capsules, height of cylinders, height of capsules.
    """

    name: str
    shapes: str
    defaults: tuple[float, float, float]


EXTENSIONS: dict[Convention, PhysicsExtension] = {
    "khr": PhysicsExtension(KHR, "KHR_implicit_shapes", (0.25, 0.5, 0.5)),
    "omi": PhysicsExtension(OMI, "OMI_physics_shape", (0.5, 2.0, 1.0)),
}


@dataclass(frozen=True, eq=False, slots=True)
class Collider:
    """What a node collides with: a shape in its own space, or a mesh by its number, taken as one hull or as it is."""

    shape: CollisionPiece | None = None
    mesh: Any = None
    convex: bool = False


def physics_extension_of(scene: GltfScene) -> Convention | None:
    """Return the extension that marks the colliders of a file: the first that any node of the scene uses."""
    nodes = [placement.node for placement in scene.placements.values()]
    return next((kind for kind in EXTENSIONS if any(has_collider(node, kind) for node in nodes)), None)


def has_collider(node: Json, kind: Convention) -> bool:
    """Return whether a node collides, by that extension; a trigger does not."""
    own = (extension(node, EXTENSIONS[kind].name) or {}).get("collider")
    return bool(own) if kind == "khr" else isinstance(own, dict) and own.get("shape", -1) != -1


def collider_of(placement: Placement, kind: Convention, scene: GltfScene) -> Collider:
    """Return what a node that has a collider collides with. Raises ValueError: something that is not there."""
    marks = EXTENSIONS[kind]
    geometry = _require_object(extension(placement.node, marks.name) or {}, "collider")
    if kind == "khr":
        geometry = _require_object(geometry, "geometry")
        convex = bool(geometry.get("convexHull", False))
        if "mesh" in geometry:
            return Collider(mesh=geometry["mesh"], convex=convex)
        if "node" in geometry:
            return Collider(mesh=entry(scene.tree, "nodes", geometry["node"]).get("mesh"), convex=convex)
    shape = entry(extension(scene.tree, marks.shapes) or {}, "shapes", geometry["shape"])
    what = shape["type"]
    own = _require_object(shape, what) if what in shape else {}
    if what in _MESHES:
        return Collider(mesh=own.get("mesh"), convex=what == "convex" or bool(geometry.get("convexHull", False)))
    return Collider(shape=_read_shape(str(what), own, marks.defaults))


def _require_object(owner: Json, key: str) -> Json:
    found = owner[key]
    if not isinstance(found, dict):
        raise ValueError(f"its {key!r} is no object")
    return found


def _read_shape(kind: str, own: Json, default: tuple[float, float, float]) -> CollisionPiece:
    """The shape of a type with its parameters; a tapered one, which no engine has natively, as a polytope.

    default: see `PhysicsExtension`; a capsule with one `radius` (older) says its height. Raises ValueError: no number.
    """
    match kind:
        case "box":
            size = numbers(own, "size", 3, (1.0, 1.0, 1.0))
            return build_solid("box", size, lambda: Box(Pose.identity(), size / 2))
        case "sphere":
            radius = number(own, "radius", 0.5)
            return build_solid("sphere", [radius], lambda: Sphere(Pose.identity(), radius))
        case "cylinder" | "capsule":
            radius, height = default[0], default[1 if kind == "cylinder" else 2]
            if "radius" in own:
                top = bottom = number(own, "radius", radius)
                height = number(own, "height", 2.0) - (2 * top if kind == "capsule" else 0.0)
            else:
                top, bottom = number(own, "radiusTop", radius), number(own, "radiusBottom", radius)
                height = number(own, "height", height)
            return build_round(kind, Z_TO_Y, bottom, top, height / 2)
        case "plane":
            return CollisionPiece(None, "a plane has no end", plane=Z_TO_Y)
    return CollisionPiece(None, f"a shape of type {kind!r} is not known")


def motion_of(asset: Asset, body: Body) -> Json:
    """Return the `motion` of a body: kinematic for the fixed part of something with joints; its mass where known."""
    is_kinematic = asset.mechanism.joints and BodyTree.of(asset).is_static(body.name)
    return {**({"isKinematic": True} if is_kinematic else {}), **mass_keys(asset, body)}


def mass_keys(asset: Asset, body: Body) -> Json:
    """Return the mass of a body as a motion has it, moments about its own axes where these are principal ones."""
    inertial = next((known for known in asset.mechanism.inertials if known.body == body.name), None)
    if inertial is None or inertial.mass <= 0:
        return {}
    keys: Json = {"mass": inertial.mass}
    keys["centerOfMass"] = body.pose.inverse().apply(inertial.centre[None])[0].tolist()
    tensor = drop_rounding(body.pose.rotation.T @ inertial.inertia @ body.pose.rotation)
    diagonal, axes = principal_axes(tensor)
    if diagonal.min() > 0:
        w, x, y, z = Pose(axes, np.zeros(3)).to_quaternion().tolist()
        keys |= {"inertiaDiagonal": diagonal.tolist(), "inertiaOrientation": [x, y, z, w]}
    return keys


def says_mass(node: Json) -> bool:
    """Return whether a node says what it weighs as a body: in KHR's `motion`, or OMI's, if older the extension."""
    khr, omi = extension(node, KHR) or {}, extension(node, OMI) or {}
    motion = khr.get("motion", omi.get("motion", omi))
    return isinstance(motion, dict) and "mass" in motion


def body_nodes(scene: GltfScene) -> dict[int, int]:
    """Return for each node of the scene in a body, the node that is that body: itself, or the nearest one above."""
    found: dict[int, int] = {}
    for index, placement in scene.placements.items():
        own = extension(placement.node, OMI) or {}
        if "motion" in (extension(placement.node, KHR) or {}) or "motion" in own or "type" in own:  # OMI's older form
            found[index] = index
        elif placement.parent in found:
            found[index] = found[placement.parent]
    return found


def rigid_pose_of(placement: Placement) -> Pose:
    """Return the pose of a node without its scale: the rotation nearest to its map."""
    left, _, right = np.linalg.svd(placement.linear)
    left[:, 2] *= np.sign(np.linalg.det(left @ right))
    return Pose(left @ right, placement.offset)
