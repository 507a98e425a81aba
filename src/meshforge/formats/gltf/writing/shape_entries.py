"""Shapes as the physics extensions write them, and the nodes that put them in place."""

from __future__ import annotations

from typing import Any

from meshforge.formats.gltf.document import Convention
from meshforge.formats.gltf.reading.physics import KHR, OLD_SHAPES, OMI_COLLIDER, OMI_SHAPES, SHAPES
from meshforge.formats.gltf.reading.shapes import Z_TO_Y
from meshforge.formats.gltf.writing.draft import Draft
from meshforge.formats.meshfile.gltf import Json
from meshforge.formats.meshfile.gltf.items import extension
from meshforge.geometry import Box, Capsule, Cylinder, Pose, Sphere

Native = Box | Sphere | Cylinder | Capsule
"""The shapes that the extensions have."""


def place_of(shape: Native) -> Pose:
    """The place of a node whose collider is the shape."""
    return shape.pose @ Z_TO_Y.inverse() if isinstance(shape, Cylinder | Capsule) else shape.pose


def place_keys(pose: Pose) -> Json:
    """A pose as a node has it."""
    w, x, y, z = pose.to_quaternion().tolist()
    place: Json = {"translation": pose.translation.tolist()} if pose.translation.any() else {}
    return place if w == 1.0 else {**place, "rotation": [x, y, z, w]}


def add_plane(draft: Draft) -> Json:
    """Write down an endless plane; what a collider has to say to mean it."""
    return {"geometry": {"shape": _appended(draft, SHAPES, "shapes", {"type": "plane", "plane": {}})}}


def add_shape(draft: Draft, convention: Convention, shape: Native) -> Any:
    """Write down a shape; what a collider has to say to mean it."""
    match shape:
        case Box():
            own: Json = {"size": (2 * shape.half).tolist()}
        case Sphere():
            own = {"radius": shape.radius}
        case _:
            height = 2 * shape.half_length
            own = {"height": height, "radiusTop": shape.radius, "radiusBottom": shape.radius}
            if convention == "omi collider":
                whole = height + 2 * shape.radius * isinstance(shape, Capsule)
                own = {"height": whole, "radius": shape.radius}
    return _added(draft, convention, shape.kind, own)


def geometry_of(draft: Draft, convention: Convention, mesh: int, own: int | None, *, hulled: bool, like: Json) -> Any:
    """What a collider has to say to mean a mesh, or its hull.

    own: the collider's node, where that shows the mesh; like: a node whose collider shows the form in use.
    """
    if convention != "khr":
        kind = "trimesh" if not hulled else "hull" if convention == "omi collider" else "convex"
        return _added(draft, convention, kind, {"mesh": mesh})
    collider = (extension(like, KHR) or {}).get("collider", {})
    if "geometry" not in collider and "shape" in collider:
        entry: Json = {"type": "mesh", "mesh": {"mesh": mesh}}
        if hulled:
            entry["extensions"] = {KHR: {"convexHull": True}}
        return {"shape": _appended(draft, OLD_SHAPES if OLD_SHAPES in _extensions(draft) else SHAPES, "shapes", entry)}
    named = (
        {"mesh": mesh}
        if "mesh" in collider.get("geometry", {})
        else {"node": _carrier(draft, mesh) if own is None else own}
    )
    return {"geometry": {**named, **({"convexHull": True} if hulled else {})}}


def _carrier(draft: Draft, mesh: int) -> int:
    """A node outside of all scenes that holds a mesh for a collider."""
    nodes: list[Any] = draft.tree.setdefault("nodes", [])
    nodes.append({"name": str(draft.tree["meshes"][mesh].get("name", "")), "mesh": mesh})
    return len(nodes) - 1


def _added(draft: Draft, convention: Convention, kind: str, own: Json) -> Any:
    match convention:
        case "khr":
            older = OLD_SHAPES in _extensions(draft) and SHAPES not in _extensions(draft)
            index = _appended(draft, OLD_SHAPES if older else SHAPES, "shapes", {"type": kind, kind: own})
            return {"shape": index} if older else {"geometry": {"shape": index}}
        case "omi":
            return _appended(draft, OMI_SHAPES, "shapes", {"type": kind, kind: own})
    return _appended(draft, OMI_COLLIDER, "colliders", {"type": kind, **own})


def _appended(draft: Draft, name: str, key: str, value: Json) -> int:
    found: list[Any] = _extensions(draft).setdefault(name, {}).setdefault(key, [])
    found.append(value)
    draft.declare_extension(name)
    return len(found) - 1


def _extensions(draft: Draft) -> Json:
    found: Json = draft.tree.setdefault("extensions", {})
    return found
