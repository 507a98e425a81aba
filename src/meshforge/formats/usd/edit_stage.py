"""Edits of a stage, authored into a copy of its root layer: collision taken from prims and new prims put beside them;
or hulls beside an unmarked stage, whose own prims stay as they are."""

from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np

from meshforge.common import AssetError, join_names, pluralize
from meshforge.formats.base import note_shapes_as_hulls
from meshforge.formats.collision_pieces import CollisionPiece, names_to_keep, new_hulls
from meshforge.formats.libraries import pxr
from meshforge.formats.usd import colliders, prims
from meshforge.formats.usd.colliders import PrimCollision
from meshforge.formats.usd.stage import BODY, PrimRecord, UsdDocument, UsdStage
from meshforge.symbolic import Asset, Geom, NonConvexPiece

_GROUP_PREFIX = "collection:colliders:"
_GROUP_MEMBERS = f"{_GROUP_PREFIX}includes"
_OWN = ("physics:collisionEnabled", "physics:simulationOwner", "physics:approximation")
_SCOPE = "collision"


class LayerEdit:
    """Edits a copy of a root layer; names: what hulls read back as that cannot have their own names."""

    def __init__(self, scene: UsdStage, layer: Any, document: UsdDocument) -> None:
        self.scene, self.layer, self.document = scene, layer, document
        self.names: dict[str, str] = {}
        self._hulled: list[str] = []  # the kinds of shapes that are hulls as USD lacks them

    @property
    def notes(self) -> list[str]:
        """How the edit is written where that is not obvious."""
        return note_shapes_as_hulls(self._hulled, "USD has no such shape here")

    def spec_of(self, prim: Any) -> Any:
        """Return the spec of a prim in the layer, which is made where there is none."""
        return pxr.Sdf.CreatePrimInLayer(self.layer, prim.GetPath())

    def free_name(self, holder: Any, name: str) -> str:
        """Return the name of a new prim: the last part of a hull's, free in the layer and in the stage."""
        return prims.free_prim_name(holder, name.rsplit("/", 1)[-1], self.scene.stage)

    def add_geom(self, holder: Any, geom: Geom, space: prims.PrimSpace) -> tuple[Any, str | None]:
        """Add the prim of a hull; return it, and the approximation by which it collides where it is a mesh."""
        spec, approximation = prims.add_shape(holder, self.free_name(holder, geom.name), geom.shape, space)
        prims.set_labels(spec, [geom.label])
        self._hulled += [geom.shape.kind] if approximation and geom.shape.is_primitive else []
        return spec, approximation

    def make_instances_editable(self, prim: Any) -> None:
        """Make the instances around a prim their own, so that it can be edited alone."""
        above = prim.GetParent()
        while above and not above.IsPseudoRoot():
            if above.IsInstance():
                self.spec_of(above).SetInfo("instanceable", False)
            above = above.GetParent()


class HullEdit(LayerEdit):
    """Takes the place of the collision of a stage; changed: the bodies whose colliders are not what they were."""

    def __init__(self, scene: UsdStage, layer: Any, document: UsdDocument, bodies: colliders.StageBodies) -> None:
        super().__init__(scene, layer, document)
        self.bodies = bodies
        self.changed: set[str] = set()
        self._how: Counter[str] = Counter()

    def run(self, asset: Asset, sources: Sequence[PrimCollision]) -> None:
        """Bring the layer to hold just the geoms and non-convex pieces of an asset. Raises AssetError."""
        kept = names_to_keep(asset)
        for element, source in zip(self.document.authored, sources, strict=True):
            staying = [k for k, name in enumerate(element.names) if name in kept]
            if len(staying) < len(element.names):
                self._how[self._remove_collision(source.prim)] += 1
                self.changed.add(element.body)
                for k in staying:
                    self._keep_piece(element, k, source, source.parts[k])
            elif not self.document.physics:  # else only new prims would collide
                self._mark(source)
        known = {name: k for k, element in enumerate(self.document.authored) for name in element.names}
        for geom in new_hulls(asset, known):
            parent = sources[known[geom.parent]] if geom.parent in known else None
            holder, space = self._find_holder(parent, geom.body)
            spec, approximation = self.add_geom(holder, geom, space)
            self._finish(spec, geom.name, geom.body, parent, approximation)
            self.changed.add(geom.body)

    @property
    def notes(self) -> list[str]:
        found = super().notes
        if number := self._how["deactivated"]:
            verb = "is" if number == 1 else "are"
            others = f"{pluralize(number, 'prim')} of other layers"
            found.append(f"{others} {verb} switched off (active = false), not removed")
        if number := self._how["stripped"]:
            verb = "stays" if number == 1 else "stay"
            found.append(f"{pluralize(number, 'prim')} {verb}, to be seen, and no longer collide")
        return found

    def _keep_piece(self, element: PrimRecord, k: int, source: PrimCollision, part: CollisionPiece) -> None:
        shape, name = part.shape or part.surface, element.names[k]
        if shape is None:
            raise AssetError(f"{name!r} cannot stay without the rest of its mesh", where=str(self.scene.path))
        holder, space = self._find_holder(source, element.body)
        spec = prims.add_mesh(holder, self.free_name(holder, name), np.asarray(shape.vertices), shape.faces, space)
        self._finish(spec, name, element.body, source, "convexHull" if part.shape else "none")

    def _finish(self, spec: Any, name: str, body: str, parent: PrimCollision | None, approximation: str | None) -> None:
        """Mark a new prim as collision, with what it inherits, and see what it will be called."""
        marked = self.document.physics
        drawn = not marked or (parent is not None and colliders.is_drawn(parent.prim))
        prims.mark_collider(spec, approximation, drawn=drawn)
        if marked and parent is not None:
            colliders.inherit_contact(spec, parent.prim)
            self._join_groups(parent.path, spec.path)
        read = self.bodies.hull_name(str(spec.path), body)
        if read != name:
            self.names[name] = read

    def _mark(self, source: PrimCollision) -> None:
        """Say of a prim that was taken for collision that it collides, as the pieces that it has; it is still seen."""
        whole = len(source.parts) == 1 and source.parts[0].shape is not None
        self.make_instances_editable(source.prim)
        is_mesh = source.prim.GetTypeName() == "Mesh"
        prims.add_collision(self.spec_of(source.prim), ("convexHull" if whole else "none") if is_mesh else None)

    def _find_holder(self, parent: PrimCollision | None, body: str) -> tuple[Any, prims.PrimSpace]:
        """The spec below which a new prim goes, and the space that it is put in."""
        prim = self._find_holding_prim(parent, body)
        while not (space := prims.PrimSpace.of(self.scene, prim)).holds_volume():
            prim = prim.GetParent()
        self.make_instances_editable(prim)
        if prim.IsInstance():
            self.spec_of(prim).SetInfo("instanceable", False)
        return self.spec_of(prim), space

    def _find_holding_prim(self, parent: PrimCollision | None, body: str) -> Any:
        own = next((path for path, name in self.bodies.names.items() if name == body), None)
        if own is None and body != BODY:
            raise AssetError(f"there is no body {body!r} in the file", where=str(self.scene.path))
        if parent is not None and parent.body == body:
            below = parent.path in (own, self.scene.base)
            return parent.prim if below else parent.prim.GetParent()
        if own is not None:
            return self.bodies.prims[own]
        return self.scene.stage.GetDefaultPrim() or self.scene.stage.GetPseudoRoot()

    def _join_groups(self, parent: str, made: Any) -> None:
        for group in self.scene.stage.Traverse():
            if group.GetTypeName() == "PhysicsCollisionGroup":
                targets = [str(target) for target in group.GetRelationship(_GROUP_MEMBERS).GetTargets()]
                if parent in targets:
                    spec = self.spec_of(group)
                    own = spec.relationships.get(_GROUP_MEMBERS)
                    own = own or pxr.Sdf.RelationshipSpec(spec, _GROUP_MEMBERS, False)
                    own.targetPathList.Append(made)

    def _remove_collision(self, prim: Any) -> str:
        """Take the collision from a prim, and the prim where it was nothing else; how, for people.

        Raises AssetError: something else refers to the prim that would go.
        """
        self.make_instances_editable(prim)
        others = [child for child in prim.GetAllChildren() if child.GetTypeName() != "GeomSubset"]
        is_more = colliders.is_seen(self.scene, prim) or prim.HasAPI(pxr.UsdPhysics.RigidBodyAPI) or others
        if self.document.physics and is_more:
            self._remove_schemas(prim)
            return "stripped"
        self._refuse_referenced(prim)
        path, stack = prim.GetPath(), prim.GetPrimStack()
        if len(stack) == 1 and stack[0].layer == self.scene.stage.GetRootLayer() and stack[0].path == path:
            spec = self.layer.GetPrimAtPath(path)
            del spec.nameParent.nameChildren[spec.name]
            return "removed"
        self.spec_of(prim).SetInfo("active", False)
        return "deactivated"

    def _remove_schemas(self, prim: Any) -> None:
        gone = [
            name
            for name in prim.GetPrimTypeInfo().GetAppliedAPISchemas()
            if name in (colliders.COLLISION, colliders.MESH_COLLISION)
            or (name.startswith("Physx") and "Collision" in name)
        ]
        spec = self.spec_of(prim)
        schemas = spec.GetInfo("apiSchemas") if spec.HasInfo("apiSchemas") else pxr.Sdf.TokenListOp()
        lists = ("prependedItems", "appendedItems", "addedItems")
        for name in ("explicitItems",) if schemas.isExplicit else lists:
            setattr(schemas, name, [item for item in getattr(schemas, name) if item not in gone])
        if not schemas.isExplicit:
            schemas.deletedItems = list(dict.fromkeys([*schemas.deletedItems, *gone]))
        spec.SetInfo("apiSchemas", schemas)
        for name in [p.name for p in spec.properties]:
            if name in _OWN or (name.startswith("physx") and "Collision:" in name):
                spec.RemoveProperty(spec.properties[name])

    def _refuse_referenced(self, prim: Any) -> None:
        path = prim.GetPath()
        for other in self.scene.stage.Traverse():
            for relationship in other.GetAuthoredRelationships():
                if relationship.GetName().startswith(_GROUP_PREFIX) or other.GetPath().HasPrefix(path):
                    continue
                if any(target.GetPrimPath() == path for target in relationship.GetTargets()):
                    problem = f"{path} cannot be removed: {relationship.GetPath()} refers to it"
                    remedy = "Take that reference out first, or leave the hull."
                    raise AssetError(problem, where=str(self.scene.path), remedy=remedy)


class ColliderEdit(LayerEdit):
    """Adds hulls beside an unmarked stage, in a scope below its default prim, or at the root; count: how many."""

    def __init__(self, scene: UsdStage, layer: Any, document: UsdDocument) -> None:
        super().__init__(scene, layer, document)
        self.count = 0
        default = scene.stage.GetDefaultPrim()
        can_hold = default and not default.IsInstance() and prims.PrimSpace.of(scene, default).holds_volume()
        carrier = default if can_hold else scene.stage.GetPseudoRoot()
        self._space = prims.PrimSpace.of(scene, carrier)
        holder = self.spec_of(carrier)
        self._scope = prims.add_prim(holder, self.free_name(holder, _SCOPE), "Scope")

    @property
    def notes(self) -> list[str]:
        moving = [element.path for element in self.document.authored if self._is_animated(element.path)]
        still = f"an animation moves {join_names(moving, 3)}: hulls stay where that is at the first moment"
        return [*super().notes, *([still] if moving else [])]

    def add(self, piece: Geom | NonConvexPiece) -> None:
        """Add a piece; one that is neither triangles nor a plane is left out."""
        holder, space, approximation = self._scope, self._space, None
        if isinstance(piece, Geom):
            spec, approximation = self.add_geom(holder, piece, space)
        elif piece.plane is not None and (place := space.split_pose(piece.plane)) is not None:
            spec = prims.add_plane(holder, self.free_name(holder, piece.name), *place[:2])
        elif piece.surface is not None and len(piece.surface.faces):
            approximation = "none"
            points, faces = np.asarray(piece.surface.vertices), piece.surface.faces
            spec = prims.add_mesh(holder, self.free_name(holder, piece.name), points, faces, space)
        else:
            return
        prims.mark_collider(spec, approximation)
        spec.SetInfoDictionaryValue("customData", colliders.HULL_NAME, piece.name)
        self.count += 1

    def _is_animated(self, path: str) -> bool:
        prim = self.scene.stage.GetPrimAtPath(path)
        while prim and not prim.IsPseudoRoot():
            if pxr.UsdGeom.Xformable(prim).TransformMightBeTimeVarying():
                return True
            prim = prim.GetParent()
        return False
