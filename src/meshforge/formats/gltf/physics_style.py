"""How hulls are written where a physics extension marks collision: colliders on nodes, and the shapes they refer to."""

from __future__ import annotations

import copy
from collections.abc import Sequence
from typing import Any

import numpy as np

from meshforge.formats.gltf import physics
from meshforge.formats.gltf.document import Convention, NodeRecord
from meshforge.formats.gltf.draft import SceneDraft
from meshforge.formats.gltf.styles import NewPiece, Style
from meshforge.formats.meshfile.gltf_document import Json, extension
from meshforge.formats.meshfile.gltf_meshes import DRACO
from meshforge.geometry import Box, Capsule, Cylinder, Pose, Sphere
from meshforge.symbolic import Geom, NonConvexPiece

DRAWN_EXTRAS = {"meshforge": {"drawn": True}}
"""The extras of a node whose mesh only shows its collider, and goes with it."""
ExtensionPrimitive = Box | Sphere | Cylinder | Capsule
"""The shapes that the extensions have."""

_EVEN = 1e-9  # by which the stretches of a map may differ where it scales evenly
_SAME = 1e-12  # by which a stretch may differ from one where it is none


class PhysicsStyle(Style):
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
            geometry = self._write_mesh(part, None, hulled=False, like=source.node)
            self._add_collider({"name": own}, element.node, geometry, element.names[k], source.node, at)
        _remove_collider(draft.node(element.node))

    def add(self, piece: NewPiece) -> None:
        """Add a piece as a shape of the extension, as the vertices of the scene themselves, or as a mesh of its own."""
        draft, what, holder = self.draft, piece.what, piece.holder
        like = draft.scene.placements[piece.source.node].node if piece.source else {}
        shape = draft.shape_in(what.shape, holder) if isinstance(what, Geom) else None
        drawn = self.drawn or is_drawn(like)
        if isinstance(what, NonConvexPiece) and what.plane is not None:
            self._add_plane(piece, what.plane)
        elif self._add_as_authored(piece):
            return
        elif isinstance(shape, ExtensionPrimitive):
            pose = node_pose_of(shape)
            node: Json = {"name": piece.own}
            if drawn:
                own = shape.move(pose.inverse()).tessellate()
                node["mesh"], _ = draft.add_surface_mesh(own.vertices, own.faces, piece.own)
            self._add_node(node | pose_keys(pose), drawn, piece, write_shape(draft, self.convention, shape), like)
        else:
            mesh, middle = draft.add_surface_mesh(*draft.triangles_in(what, holder), piece.own)
            place = {"name": piece.own, "translation": middle.tolist()}
            number = len(draft.tree.setdefault("nodes", []))  # of the new node
            geometry = self._write_mesh(mesh, number if drawn else None, hulled=shape is not None, like=like)
            self._add_node(place | ({"mesh": mesh} if drawn else {}), drawn, piece, geometry, like)

    def _add_plane(self, piece: NewPiece, plane: Pose) -> None:
        holder = piece.holder
        above = physics.rigid_pose_of(self.draft.scene.placements[holder]) if holder is not None else Pose.identity()
        node = {"name": piece.own, **pose_keys(above.inverse() @ plane @ physics.Z_TO_Y.inverse())}
        shape = _write_entry(self.draft, self.convention, "plane", {})
        self._add_node(node, False, piece, shape, {})

    def _add_as_authored(self, piece: NewPiece) -> bool:
        """Collide with the vertices of the scene themselves, where no skin moves them and no map shears them."""
        draft, element = self.draft, piece.source
        if element is None or element.owner is None or piece.part is None:
            return False
        source = draft.scene.placements[element.node]
        place = _even_place(draft, element.node, piece.holder)
        if place is None or "skin" in source.node:
            return False
        whole = draft.extract_pieces(source.node["mesh"], element.owner, [piece.part])
        mesh = draft.add_mesh({"name": piece.own, "primitives": [_strip_look(part) for part in whole["primitives"]]})
        geometry = self._write_mesh(mesh, None, hulled=isinstance(piece.what, Geom), like={})
        self._add_node({"name": piece.own, **place}, False, piece, geometry, {})
        return True

    def _add_node(self, node: Json, drawn: bool, piece: NewPiece, geometry: Any, like: Json) -> None:
        extras = {"extras": copy.deepcopy(DRAWN_EXTRAS)} if drawn else {}
        self._add_collider({**node, **extras}, piece.holder, geometry, piece.what.name, like)

    def _add_collider(
        self, node: Json, holder: int | None, geometry: Any, name: str, like: Json, at: int | None = None
    ) -> None:
        """Add a node that collides with a geometry, and has all else of the collider of another node."""
        index = self.draft.add_node(node, holder, at)
        extensions = self.draft.node(index).setdefault("extensions", {})
        extension_name = physics.KHR if self.convention == "khr" else physics.OMI
        self.draft.declare_extension(extension_name)
        old = copy.deepcopy((extension(like, extension_name) or {}).get("collider", {}))
        rest = {key: value for key, value in old.items() if key not in ("geometry", "shape")}
        own = geometry if self.convention == "khr" else {"shape": geometry}
        extensions[extension_name] = {"collider": {**own, **rest}}
        self.draft.expected[index] = (name,)

    def _write_mesh(self, mesh: int, own: int | None, *, hulled: bool, like: Json) -> Any:
        """What a collider has to say to mean a mesh, or its hull.

        own: the collider's node, where that shows the mesh; like: a node whose collider shows the form in use.
        """
        if self.convention != "khr":
            return _write_entry(self.draft, self.convention, "convex" if hulled else "trimesh", {"mesh": mesh})
        geometry: Json = {"mesh": mesh}
        collider = (extension(like, physics.KHR) or {}).get("collider", {})
        if "mesh" not in collider.get("geometry", {}):
            geometry = {"node": self._add_carrier(mesh) if own is None else own}
        return {"geometry": {**geometry, **({"convexHull": True} if hulled else {})}}

    def _add_carrier(self, mesh: int) -> int:
        nodes: list[Any] = self.draft.tree.setdefault("nodes", [])
        nodes.append({"name": str(self.draft.tree["meshes"][mesh].get("name", "")), "mesh": mesh})
        return len(nodes) - 1


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
    if not extensions:
        node.pop("extensions", None)


def _even_place(draft: SceneDraft, node: int, holder: int | None) -> Json | None:
    """The place of a node below another one, as a node has it; None where that mirrors, shears or stretches."""
    matrix = draft.matrix_below(node, holder)
    linear = matrix[:3, :3]
    stretch = np.linalg.svd(linear, compute_uv=False)
    if np.linalg.det(linear) <= 0 or np.ptp(stretch) > _EVEN * stretch[0]:
        return None
    scale = float(stretch.mean())
    place = pose_keys(Pose(linear / scale, matrix[:3, 3]))
    return place if abs(scale - 1) <= _SAME else {**place, "scale": [scale] * 3}


def _strip_look(part: Json) -> Json:
    """A primitive without what only matters to the eye; one that Draco compressed keeps its attributes."""
    kept: Json = {key: part[key] for key in ("attributes", "indices", "mode") if key in part}
    packed = part.get("extensions", {}).get(DRACO)
    if packed is not None:
        return {**kept, "extensions": {DRACO: packed}}
    return {**kept, "attributes": {"POSITION": part["attributes"]["POSITION"]}}


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
            own = {"height": 2 * shape.half_length, "radiusTop": shape.radius, "radiusBottom": shape.radius}
    return _write_entry(draft, convention, shape.kind, own)


def _write_entry(draft: SceneDraft, convention: Convention, kind: str, own: Json) -> Any:
    """Append a shape to those of the file; what a collider has to say to mean it."""
    name = physics.SHAPES if convention == "khr" else physics.OMI_SHAPES
    found: list[Any] = draft.tree.setdefault("extensions", {}).setdefault(name, {}).setdefault("shapes", [])
    found.append({"type": kind, kind: own})
    draft.declare_extension(name)
    index = len(found) - 1
    return {"geometry": {"shape": index}} if convention == "khr" else index
