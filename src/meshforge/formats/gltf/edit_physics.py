"""How an edit is written where a physics extension marks collision: colliders on nodes, and the shapes they refer
to."""

from __future__ import annotations

import copy
from collections.abc import Sequence
from typing import Any

import numpy as np

from meshforge.formats.gltf import physics
from meshforge.formats.gltf.document import Convention, NodeRecord
from meshforge.formats.gltf.draft import SceneDraft
from meshforge.formats.gltf.edit_styles import EditStyle
from meshforge.formats.meshfile.gltf_document import Json, entries, extension
from meshforge.geometry import Box, Capsule, Cylinder, Pose, Sphere
from meshforge.symbolic import Geom, Opaque, Surface

DRAWN_EXTRAS = {"meshforge": {"drawn": True}}
"""The extras of a node whose mesh only shows its collider, and goes with it."""

ExtensionPrimitive = Box | Sphere | Cylinder | Capsule
"""The shapes that the extensions have."""


class PhysicsStyle(EditStyle):
    """A hull is a node with a collider: a shape of the extension, or the hull of a mesh.

    drawn: whether each new hull is shown by a mesh, beside those whose parent is.
    """

    renames = True
    holds = ("polytope", "box", "sphere", "cylinder", "capsule")
    lacks = "the extension has no"

    def __init__(self, draft: SceneDraft, convention: Convention, drawn: bool = False) -> None:
        super().__init__(draft)
        self.convention, self.drawn = convention, drawn

    def remove(self, element: NodeRecord) -> None:
        node = self.draft.node(element.node)
        _remove_collider(node)
        if is_drawn(node) or "mesh" not in node:
            self.draft.empty_node(element.node)

    def keep_pieces(self, element: NodeRecord, kept: Sequence[int]) -> None:
        """Each piece that is left becomes a collider of its own, on a node below."""
        draft = self.draft
        assert element.owner is not None  # only meshes have several pieces
        source = draft.scene.placements[element.node]
        mesh = physics.collider_of(source, self.convention, draft.scene).mesh
        for at, k in enumerate(kept):
            own = element.names[k].removeprefix(f"{element.body}/")
            part = draft.add_mesh({**draft.extract_pieces(mesh, element.owner, [k]), "name": own})
            index = draft.add_node({"name": own}, element.node, at)
            geometry = write_mesh_geometry(draft, self.convention, part, None, hulled=False, like=source.node)
            self._set_collider(index, source.node, geometry)
            draft.expected[index] = (element.names[k],)
        _remove_collider(draft.node(element.node))

    def add_hull(self, geom: Geom, own: str, body: int | None, parent: NodeRecord | None) -> None:
        draft, holder = self.draft, self.holder(body, parent)
        shape = draft.shape_in(geom.shape, holder)
        like = draft.scene.placements[parent.node].node if parent else {}
        drawn = self.drawn or is_drawn(like)
        node: Json = {"name": own}
        if isinstance(shape, ExtensionPrimitive):
            if drawn:
                node["mesh"], _ = draft.add_shape_mesh(shape.move(node_pose_of(shape).inverse()), own)
            node |= pose_keys(node_pose_of(shape))
            self._add_node(node, drawn, holder, like, write_shape(draft, self.convention, shape), geom.name)
        else:
            mesh, middle = draft.add_shape_mesh(shape, own)
            node["translation"] = middle.tolist()
            self._add_mesh(node, drawn, holder, like, mesh, geom.name)

    def add_opaque(self, piece: Opaque, surface: Surface, own: str, body: int | None) -> None:
        """Add a surface that is no hull."""
        points = self.draft.points_in(np.asarray(surface.vertices), body)
        mesh, middle = self.draft.add_surface_mesh(points, surface.faces, own)
        node: Json = {"name": own, "translation": middle.tolist()}
        self._add_mesh(node, self.drawn, body, {}, mesh, piece.name, hulled=False)

    def add_plane(self, piece: Opaque, own: str, body: int | None) -> None:
        """Add an endless plane."""
        assert piece.plane is not None
        above = physics.rigid_pose_of(self.draft.scene.placements[body]) if body is not None else Pose.identity()
        node = {"name": own, **pose_keys(above.inverse() @ piece.plane @ physics.Z_TO_Y.inverse())}
        index = _append_entry(self.draft, physics.SHAPES, "shapes", {"type": "plane", "plane": {}})
        self._add_node(node, False, body, {}, {"geometry": {"shape": index}}, piece.name)

    def _add_mesh(
        self, node: Json, drawn: bool, holder: int | None, like: Json, mesh: int, name: str, *, hulled: bool = True
    ) -> None:
        own = len(entries(self.draft.tree, "nodes")) if drawn else None
        if drawn:
            node["mesh"] = mesh
            self.draft.tree.setdefault("nodes", [])
        geometry = write_mesh_geometry(self.draft, self.convention, mesh, own, hulled=hulled, like=like)
        self._add_node(node, drawn, holder, like, geometry, name)

    def _add_node(self, node: Json, drawn: bool, holder: int | None, like: Json, geometry: Any, name: str) -> None:
        if drawn:
            node["extras"] = copy.deepcopy(DRAWN_EXTRAS)
        self.add_collider(node, holder, geometry, name, like)

    def add_collider(self, node: Json, holder: int | None, geometry: Any, name: str, like: Json | None = None) -> None:
        """Add a node that collides with a geometry; name: of the piece; like: a node that collides alike."""
        index = self.draft.add_node(node, holder)
        self._set_collider(index, like or {}, geometry)
        self.draft.expected[index] = (name,)

    def _set_collider(self, index: int, like: Json, geometry: Any) -> None:
        """Give a node a collider with that geometry, and all else of the collider of another node."""
        extensions = self.draft.node(index).setdefault("extensions", {})
        self.draft.declare_extension(
            {"khr": physics.KHR, "omi": physics.OMI}.get(self.convention, physics.OMI_COLLIDER)
        )
        match self.convention:
            case "khr":
                old = (extension(like, physics.KHR) or {}).get("collider", {})
                rest = {k: copy.deepcopy(v) for k, v in old.items() if k not in ("geometry", "shape")}
                extensions[physics.KHR] = {"collider": {**geometry, **rest}}
            case "omi":
                old = (extension(like, physics.OMI) or {}).get("collider", {})
                extensions[physics.OMI] = {"collider": {**copy.deepcopy(old), "shape": geometry}}
            case _:
                old = extension(like, physics.OMI_COLLIDER) or {}
                extensions[physics.OMI_COLLIDER] = {**copy.deepcopy(old), "collider": geometry}


def is_drawn(node: Json) -> bool:
    """Whether a node's mesh only shows its collider."""
    extras = node.get("extras")
    own = extras.get("meshforge") if isinstance(extras, dict) else None
    return isinstance(own, dict) and own.get("drawn") is True


def _remove_collider(node: Json) -> None:
    extensions = node.get("extensions", {})
    for name in (physics.KHR, physics.OMI):
        own = extensions.get(name, {})
        if "collider" in own:
            del own["collider"]
            if not own:
                del extensions[name]
    extensions.pop(physics.OMI_COLLIDER, None)
    if not extensions:
        node.pop("extensions", None)


def node_pose_of(shape: ExtensionPrimitive) -> Pose:
    """The place of a node whose collider is the shape."""
    return shape.pose @ physics.Z_TO_Y.inverse() if isinstance(shape, Cylinder | Capsule) else shape.pose


def pose_keys(pose: Pose) -> Json:
    """A pose as a node has it."""
    w, x, y, z = pose.to_quaternion().tolist()
    place: Json = {"translation": pose.translation.tolist()} if pose.translation.any() else {}
    return place if w == 1.0 else {**place, "rotation": [x, y, z, w]}


def write_shape(draft: SceneDraft, convention: Convention, shape: ExtensionPrimitive) -> Any:
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
    return _write_entry(draft, convention, shape.kind, own)


def write_mesh_geometry(
    draft: SceneDraft, convention: Convention, mesh: int, own: int | None, *, hulled: bool, like: Json
) -> Any:
    """What a collider has to say to mean a mesh, or its hull.

    own: the collider's node, where that shows the mesh; like: a node whose collider shows the form in use.
    """
    if convention != "khr":
        kind = "trimesh" if not hulled else "hull" if convention == "omi collider" else "convex"
        return _write_entry(draft, convention, kind, {"mesh": mesh})
    collider = (extension(like, physics.KHR) or {}).get("collider", {})
    if "geometry" not in collider and "shape" in collider:
        entry: Json = {"type": "mesh", "mesh": {"mesh": mesh}}
        if hulled:
            entry["extensions"] = {physics.KHR: {"convexHull": True}}
        older = physics.OLD_SHAPES in _extensions_of(draft)
        return {"shape": _append_entry(draft, physics.OLD_SHAPES if older else physics.SHAPES, "shapes", entry)}
    geometry: Json = {"mesh": mesh}
    if "mesh" not in collider.get("geometry", {}):
        geometry = {"node": _add_carrier(draft, mesh) if own is None else own}
    return {"geometry": {**geometry, **({"convexHull": True} if hulled else {})}}


def _add_carrier(draft: SceneDraft, mesh: int) -> int:
    nodes: list[Any] = draft.tree.setdefault("nodes", [])
    nodes.append({"name": str(draft.tree["meshes"][mesh].get("name", "")), "mesh": mesh})
    return len(nodes) - 1


def _write_entry(draft: SceneDraft, convention: Convention, kind: str, own: Json) -> Any:
    match convention:
        case "khr":
            older = physics.OLD_SHAPES in _extensions_of(draft) and physics.SHAPES not in _extensions_of(draft)
            index = _append_entry(
                draft, physics.OLD_SHAPES if older else physics.SHAPES, "shapes", {"type": kind, kind: own}
            )
            return {"shape": index} if older else {"geometry": {"shape": index}}
        case "omi":
            return _append_entry(draft, physics.OMI_SHAPES, "shapes", {"type": kind, kind: own})
    return _append_entry(draft, physics.OMI_COLLIDER, "colliders", {"type": kind, **own})


def _append_entry(draft: SceneDraft, name: str, key: str, value: Json) -> int:
    found: list[Any] = _extensions_of(draft).setdefault(name, {}).setdefault(key, [])
    found.append(value)
    draft.declare_extension(name)
    return len(found) - 1


def _extensions_of(draft: SceneDraft) -> Json:
    found: Json = draft.tree.setdefault("extensions", {})
    return found
