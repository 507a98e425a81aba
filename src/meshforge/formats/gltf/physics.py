"""What physics extensions say of a node: whether it is a body, and which shape it collides with."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from meshforge.formats.collision_pieces import CollisionPiece, build_solid, end_points
from meshforge.formats.gltf.document import Convention
from meshforge.formats.meshfile.gltf_document import Json, entry, extension, number, numbers
from meshforge.formats.meshfile.gltf_scene import GltfScene, Placement
from meshforge.geometry import Box, Capsule, Cylinder, Pose, Sphere, convex_hull

KHR, SHAPES, OLD_SHAPES = "KHR_physics_rigid_bodies", "KHR_implicit_shapes", "KHR_collision_shapes"
OMI, OMI_SHAPES, OMI_COLLIDER = "OMI_physics_body", "OMI_physics_shape", "OMI_collider"
_MESHES = ("mesh", "convex", "hull", "trimesh")
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
    found: list[Convention] = ["khr", "omi", "omi collider"]
    return next((kind for kind in found if any(has_collider(node, kind, scene.tree) for node in nodes)), None)


def has_collider(node: Json, kind: Convention, tree: Json) -> bool:
    """Whether a node collides, by that extension; a trigger does not."""
    match kind:
        case "khr":
            return bool((extension(node, KHR) or {}).get("collider"))
        case "omi":
            own = (extension(node, OMI) or {}).get("collider")
            return isinstance(own, dict) and own.get("shape", -1) != -1
        case "omi collider":
            own = extension(node, OMI_COLLIDER)
            return own is not None and not _omi_collider_of(own, tree).get("isTrigger", False)
    return False


def is_body(node: Json) -> bool:
    """Whether a node is a rigid body of its own: `motion`, or a `type` in OMI's older form."""
    own = extension(node, OMI) or {}
    return "motion" in (extension(node, KHR) or {}) or "motion" in own or "type" in own


def is_trigger(node: Json, tree: Json) -> bool:
    """Whether a node detects bodies without colliding."""
    older = extension(node, OMI_COLLIDER)
    return (
        "trigger" in (extension(node, KHR) or {})
        or "trigger" in (extension(node, OMI) or {})
        or (older is not None and bool(_omi_collider_of(older, tree).get("isTrigger", False)))
    )


def collider_of(placement: Placement, kind: Convention, scene: GltfScene) -> Collider:
    """What a node that has a collider collides with. Raises ValueError: something that is not there."""
    match kind:
        case "khr":
            return _read_khr_collider(_require_object(extension(placement.node, KHR) or {}, "collider"), scene)
        case "omi":
            shapes = extension(scene.tree, OMI_SHAPES) or {}
            index = _require_object(extension(placement.node, OMI) or {}, "collider")["shape"]
            return _collider_of_shape(entry(shapes, "shapes", index), _OMI_DEFAULT)
    flat = _omi_collider_of(extension(placement.node, OMI_COLLIDER) or {}, scene.tree)
    if flat["type"] in ("cylinder", "capsule"):
        flat = {"radius": 0.5, **flat}
    return _collider_of_shape({"type": flat["type"], flat["type"]: flat}, _OMI_DEFAULT)


def _read_khr_collider(collider: Json, scene: GltfScene) -> Collider:
    geometry = _require_object(collider, "geometry") if "geometry" in collider else collider
    convex = bool(geometry.get("convexHull", False))
    if "mesh" in geometry:
        return Collider(mesh=geometry["mesh"], convex=convex)
    if "node" in geometry:
        return Collider(mesh=entry(scene.tree, "nodes", geometry["node"]).get("mesh"), convex=convex)
    shapes = extension(scene.tree, SHAPES) or extension(scene.tree, OLD_SHAPES) or {}
    shape = entry(shapes, "shapes", geometry["shape"])
    hulled = bool((extension(shape, KHR) or {}).get("convexHull", False))
    return _collider_of_shape(shape, _KHR_DEFAULT, convex=convex or hulled)


def _collider_of_shape(shape: Json, default: tuple[float, float, float], *, convex: bool = False) -> Collider:
    kind = shape["type"]
    own = _require_object(shape, kind) if kind in shape else {}
    if kind in _MESHES:
        return Collider(mesh=own.get("mesh"), convex=convex or kind in ("convex", "hull"))
    return Collider(shape=read_shape(str(kind), own, default))


def _omi_collider_of(own: Json, tree: Json) -> Json:
    return entry(extension(tree, OMI_COLLIDER) or {}, "colliders", own.get("collider"))


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
