"""What physics extensions say of a node: whether it is a body, and which shape it collides with."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from meshforge.formats.gltf.document import Convention
from meshforge.formats.gltf.reading.shapes import Described, described
from meshforge.formats.meshfile.gltf import Json, Placement, Scene
from meshforge.formats.meshfile.gltf.items import entry, extension

KHR, SHAPES, OLD_SHAPES = "KHR_physics_rigid_bodies", "KHR_implicit_shapes", "KHR_collision_shapes"
OMI, OMI_SHAPES, OMI_COLLIDER = "OMI_physics_body", "OMI_physics_shape", "OMI_collider"
_MESHES = ("mesh", "convex", "hull", "trimesh")
_KHR_DEFAULT = (0.25, 0.5, 0.5)
_OMI_DEFAULT = (0.5, 2.0, 1.0)


@dataclass(frozen=True, eq=False, slots=True)
class Collider:
    """What a node collides with: a shape of its own, or a mesh by its number, taken as one hull or as it is."""

    shape: Described | None = None
    mesh: Any = None
    convex: bool = False


def physics_of(scene: Scene) -> Convention | None:
    """The extension that the colliders of a file are told by: the first that any node of the scene uses."""
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
            return own is not None and not _omi_collider(own, tree).get("isTrigger", False)
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
        or (older is not None and bool(_omi_collider(older, tree).get("isTrigger", False)))
    )


def collider_of(placement: Placement, kind: Convention, scene: Scene) -> Collider:
    """What a node that has a collider collides with. Raises ValueError: something that is not there."""
    match kind:
        case "khr":
            return _khr(_object(extension(placement.node, KHR) or {}, "collider"), scene)
        case "omi":
            shapes = extension(scene.tree, OMI_SHAPES) or {}
            index = _object(extension(placement.node, OMI) or {}, "collider")["shape"]
            return _shaped(entry(shapes, "shapes", index), _OMI_DEFAULT)
    flat = _omi_collider(extension(placement.node, OMI_COLLIDER) or {}, scene.tree)
    if flat["type"] in ("cylinder", "capsule"):
        flat = {"radius": 0.5, **flat}
    return _shaped({"type": flat["type"], flat["type"]: flat}, _OMI_DEFAULT)


def _khr(collider: Json, scene: Scene) -> Collider:
    geometry = _object(collider, "geometry") if "geometry" in collider else collider
    convex = bool(geometry.get("convexHull", False))
    if "mesh" in geometry:
        return Collider(mesh=geometry["mesh"], convex=convex)
    if "node" in geometry:
        return Collider(mesh=entry(scene.tree, "nodes", geometry["node"]).get("mesh"), convex=convex)
    shapes = extension(scene.tree, SHAPES) or extension(scene.tree, OLD_SHAPES) or {}
    shape = entry(shapes, "shapes", geometry["shape"])
    hulled = bool((extension(shape, KHR) or {}).get("convexHull", False))
    return _shaped(shape, _KHR_DEFAULT, convex=convex or hulled)


def _shaped(shape: Json, default: tuple[float, float, float], *, convex: bool = False) -> Collider:
    kind = shape["type"]
    own = _object(shape, kind) if kind in shape else {}
    if kind in _MESHES:
        return Collider(mesh=own.get("mesh"), convex=convex or kind in ("convex", "hull"))
    return Collider(shape=described(str(kind), own, default))


def _omi_collider(own: Json, tree: Json) -> Json:
    return entry(extension(tree, OMI_COLLIDER) or {}, "colliders", own.get("collider"))


def _object(owner: Json, key: str) -> Json:
    found = owner[key]
    if not isinstance(found, dict):
        raise ValueError(f"its {key!r} is no object")
    return found
