"""How hulls are written where a physics extension marks collision: colliders on nodes, and the shapes they refer to."""

import copy
from collections.abc import Sequence

import numpy as np

from meshforge.formats.gltf import physics
from meshforge.formats.gltf.document import Convention, NodeRecord
from meshforge.formats.gltf.draft import SceneDraft
from meshforge.formats.gltf.styles import NewPiece, Style
from meshforge.formats.meshfile.gltf_document import Json, entries, entry, extension
from meshforge.formats.meshfile.gltf_meshes import DRACO
from meshforge.geometry import Box, Capsule, Cylinder, Pose, Sphere
from meshforge.symbolic import Geom, NonConvexPiece

_DRAWN_EXTRAS = {"meshforge": {"drawn": True}}
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
        self.convention, self.drawn, self.marks = convention, drawn, physics.EXTENSIONS[convention]

    def remove(self, element: NodeRecord) -> None:
        node = self.draft.node(element.node)
        _remove_collider(node)
        if is_drawn(node) or "mesh" not in node:
            self.draft.empty_node(element.node)

    def keep_pieces(self, element: NodeRecord, kept: Sequence[int]) -> None:
        """Make each piece that is left a collider of its own, on a node below."""
        draft = self.draft
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
        if isinstance(what, NonConvexPiece) and what.plane is not None:
            root_t_holder = physics.rigid_pose_of(draft.scene.placements[holder]) if holder is not None else None
            plane = root_t_holder.inverse() @ what.plane if root_t_holder else what.plane
            node = {"name": piece.own, **pose_keys(plane @ physics.Z_TO_Y.inverse())}
            self._add_collider(node, holder, self._write_entry("plane", {}), what.name, {})
            return
        if self._add_as_authored(piece):
            return
        like = draft.scene.placements[piece.source.node].node if piece.source else {}
        drawn = self.drawn or is_drawn(like)
        node = {"name": piece.own, **({"extras": copy.deepcopy(_DRAWN_EXTRAS)} if drawn else {})}
        shape = draft.shape_in(what.shape, holder) if isinstance(what, Geom) else None
        if isinstance(shape, ExtensionPrimitive):
            is_long = isinstance(shape, Cylinder | Capsule)
            pose = shape.pose @ physics.Z_TO_Y.inverse() if is_long else shape.pose
            node |= pose_keys(pose)
            if drawn:
                own = shape.move(pose.inverse()).tessellate()
                node["mesh"], _ = draft.add_surface_mesh(own.vertices, own.faces, piece.own)
            geometry = self._write_shape(shape)
        else:
            mesh, middle = draft.add_surface_mesh(*draft.triangles_in(what, holder), piece.own)
            node |= {"translation": middle.tolist(), **({"mesh": mesh} if drawn else {})}
            number = len(draft.tree.setdefault("nodes", []))  # of the new node
            geometry = self._write_mesh(mesh, number if drawn else None, hulled=shape is not None, like=like)
        self._add_collider(node, holder, geometry, what.name, like)

    def _add_as_authored(self, piece: NewPiece) -> bool:
        """Collide with the vertices of the scene themselves, where no map shears them and Draco compresses none."""
        draft, element = self.draft, piece.source
        if element is None or element.owner is None or piece.part is None:
            return False
        source = draft.scene.placements[element.node]
        place = _even_place(draft, element.node, piece.holder)
        parts = entries(entry(draft.scene.tree, "meshes", source.node["mesh"]), "primitives")
        if place is None or any(extension(part, DRACO) for part in parts):
            return False
        whole = draft.extract_pieces(source.node["mesh"], element.owner, [piece.part])
        mesh = draft.add_mesh({"name": piece.own, "primitives": [_strip_look(part) for part in whole["primitives"]]})
        geometry = self._write_mesh(mesh, None, hulled=isinstance(piece.what, Geom), like={})
        self._add_collider({"name": piece.own, **place}, piece.holder, geometry, piece.what.name, {})
        return True

    def _add_collider(
        self, node: Json, holder: int | None, geometry: Json, name: str, like: Json, at: int | None = None
    ) -> None:
        self.draft.declare_extension(self.marks.name)
        old = copy.deepcopy((extension(like, self.marks.name) or {}).get("collider", {}))
        rest = {key: value for key, value in old.items() if key not in ("geometry", "shape")}
        node["extensions"] = {self.marks.name: {"collider": {**geometry, **rest}}}
        self.draft.expected[self.draft.add_node(node, holder, at)] = (name,)

    def _write_mesh(self, mesh: int, own: int | None, *, hulled: bool, like: Json) -> Json:
        """What a collider has to say to mean a mesh, or its hull.

        own: the collider's node, where that shows the mesh; like: a node whose collider shows the form in use.
        """
        if self.convention != "khr":
            return self._write_entry("convex" if hulled else "trimesh", {"mesh": mesh})
        geometry: Json = {"mesh": mesh}
        collider = (extension(like, physics.KHR) or {}).get("collider", {})
        if "mesh" not in collider.get("geometry", {}):
            nodes: list[Json] = self.draft.tree.setdefault("nodes", [])
            geometry = {"node": len(nodes) if own is None else own}
            if own is None:  # a node outside of the scene shows it
                nodes.append({"name": str(self.draft.tree["meshes"][mesh].get("name", "")), "mesh": mesh})
        return {"geometry": {**geometry, **({"convexHull": True} if hulled else {})}}

    def _write_shape(self, shape: ExtensionPrimitive) -> Json:
        match shape:
            case Box():
                own: Json = {"size": (2 * shape.half).tolist()}
            case Sphere():
                own = {"radius": shape.radius}
            case _:
                own = {"height": 2 * shape.half_length, "radiusTop": shape.radius, "radiusBottom": shape.radius}
        return self._write_entry(shape.kind, own)

    def _write_entry(self, kind: str, own: Json) -> Json:
        """Append a shape to those of the file; what a collider has to say to mean it."""
        owner = self.draft.tree.setdefault("extensions", {}).setdefault(self.marks.shapes, {})
        found: list[Json] = owner.setdefault("shapes", [])
        found.append({"type": kind, kind: own})
        self.draft.declare_extension(self.marks.shapes)
        shape = {"shape": len(found) - 1}
        return {"geometry": shape} if self.convention == "khr" else shape


def is_drawn(node: Json) -> bool:
    """Return whether a node's mesh only shows its collider."""
    extras = node.get("extras")
    own = extras.get("meshforge") if isinstance(extras, dict) else None
    return isinstance(own, dict) and own.get("drawn") is True


def _remove_collider(node: Json) -> None:
    extensions = node.get("extensions", {})
    for name in (physics.KHR, physics.OMI):
        if extensions.get(name, {}).pop("collider", None) is not None and not extensions[name]:
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
    """A primitive without what only matters to the eye."""
    kept: Json = {key: part[key] for key in ("indices", "mode") if key in part}
    return {**kept, "attributes": {"POSITION": part["attributes"]["POSITION"]}}


def pose_keys(pose: Pose) -> Json:
    """Return a pose as a node has it."""
    w, x, y, z = pose.to_quaternion().tolist()
    place: Json = {"translation": pose.translation.tolist()} if pose.translation.any() else {}
    return place if w == 1.0 else {**place, "rotation": [x, y, z, w]}
