"""An edit of a stage, authored into a copy of its root layer: collision taken from prims, new prims put beside them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from meshforge.common import AssetError, pluralize
from meshforge.formats.base import note_shapes_as_hulls
from meshforge.formats.collision_pieces import CollisionPiece, names_to_keep, new_hulls
from meshforge.formats.libraries import pxr
from meshforge.formats.usd import colliders
from meshforge.formats.usd.prims import PrimSpace, add_collision, add_mesh, add_shape, free_prim_name, mark_collider
from meshforge.formats.usd.read import PrimCollision
from meshforge.formats.usd.stage import BODY, PrimRecord, UsdDocument, UsdStage
from meshforge.symbolic import Asset, Geom

NO_SHAPE = "USD has no such shape here"
_GROUP_PREFIX = "collection:colliders:"
_GROUP_MEMBERS = f"{_GROUP_PREFIX}includes"
_OWN = ("physics:collisionEnabled", "physics:simulationOwner", "physics:approximation")


@dataclass(eq=False)
class UsdEdit:
    """Edits a copy of a root layer; names: what hulls read back as that cannot have their own names; notes for people.

    changed: the bodies whose colliders are not what they were.
    """

    scene: UsdStage
    bodies: colliders.StageBodies
    document: UsdDocument
    layer: Any
    names: dict[str, str] = field(default_factory=dict)
    changed: set[str] = field(default_factory=set)
    _how: Counter[str] = field(default_factory=Counter)
    _hulled: list[str] = field(default_factory=list)

    def run(self, asset: Asset, sources: Sequence[PrimCollision]) -> None:
        """Bring the layer to hold just the geoms and non-convex pieces of an asset. Raises AssetError."""
        kept = names_to_keep(asset)
        for element, source in zip(self.document.authored, sources, strict=True):
            staying = [k for k, name in enumerate(element.names) if name in kept]
            if len(staying) < len(element.names):
                self._remove(element, source, staying)
            elif not self.document.physics:  # else only new prims would collide
                self._mark(source)
        known = {name: k for k, element in enumerate(self.document.authored) for name in element.names}
        for geom in new_hulls(asset, known):
            parent = known.get(geom.parent or "")
            self._add_hull(geom, None if parent is None else sources[parent])

    @property
    def notes(self) -> list[str]:
        """How the edit is written where that is not obvious."""
        found = note_shapes_as_hulls(self._hulled, NO_SHAPE)
        if number := self._how["deactivated"]:
            verb = "is" if number == 1 else "are"
            prims = f"{pluralize(number, 'prim')} of other layers"
            found.append(f"{prims} {verb} switched off (active = false), not removed")
        if number := self._how["stripped"]:
            verb = "stays" if number == 1 else "stay"
            found.append(f"{pluralize(number, 'prim')} {verb}, to be seen, and no longer collide")
        return found

    def _remove(self, element: PrimRecord, source: PrimCollision, staying: Sequence[int]) -> None:
        self._how[remove_collision(self.scene, self.layer, source.prim, self.document.physics)] += 1
        self.changed.add(element.body)
        for k in staying:
            self._keep_piece(element.names[k], element.body, source, source.parts[k])

    def _keep_piece(self, name: str, body: str, source: PrimCollision, part: CollisionPiece) -> None:
        shape = part.shape or part.surface
        if shape is None:
            raise AssetError(f"{name!r} cannot stay without the rest of its mesh", where=self._where)
        holder, space = self._find_holder(source, body)
        spec = add_mesh(holder, self._free_name(holder, name), np.asarray(shape.vertices), shape.faces, space)
        self._finish(spec, name, body, source, "convexHull" if part.shape else "none")

    def _add_hull(self, geom: Geom, parent: PrimCollision | None) -> None:
        holder, space = self._find_holder(parent, geom.body)
        spec, approximation = add_shape(holder, self._free_name(holder, geom.name), geom.shape, space)
        if approximation and geom.shape.is_primitive:
            self._hulled.append(geom.shape.kind)
        self._finish(spec, geom.name, geom.body, parent, approximation)
        self.changed.add(geom.body)

    def _finish(self, spec: Any, name: str, body: str, parent: PrimCollision | None, approximation: str | None) -> None:
        """Mark a new prim as collision, with what it inherits, and see what it will be called."""
        marked = self.document.physics
        drawn = not marked or (parent is not None and colliders.is_drawn(parent.prim))
        mark_collider(spec, approximation, drawn=drawn)
        if marked and parent is not None:
            colliders.inherit_contact(spec, parent.prim)
            self._join_groups(parent.path, spec.path)
        read = self.bodies.hull_name(str(spec.path), body)
        if read != name:
            self.names[name] = read

    def _mark(self, source: PrimCollision) -> None:
        """Say of a prim that was taken for collision that it collides, as the pieces that it has; it is still seen."""
        whole = len(source.parts) == 1 and source.parts[0].shape is not None
        make_instances_editable(self.layer, source.prim)
        spec = pxr.Sdf.CreatePrimInLayer(self.layer, source.prim.GetPath())
        is_mesh = source.prim.GetTypeName() == "Mesh"
        add_collision(spec, ("convexHull" if whole else "none") if is_mesh else None)

    def _find_holder(self, parent: PrimCollision | None, body: str) -> tuple[Any, PrimSpace]:
        """The spec below which a new prim goes, and the space that it is put in."""
        prim = self._find_holding_prim(parent, body)
        while not prim.IsPseudoRoot() and not holds_volume(self.scene, prim):
            prim = prim.GetParent()
        if prim.IsPseudoRoot():
            return self.layer.pseudoRoot, PrimSpace(self.scene.metres * np.eye(3), np.zeros(3))
        if prim.IsInstanceProxy() or prim.IsInstance():
            make_instances_editable(self.layer, prim)
            if prim.IsInstance():
                pxr.Sdf.CreatePrimInLayer(self.layer, prim.GetPath()).SetInfo("instanceable", False)
        return pxr.Sdf.CreatePrimInLayer(self.layer, prim.GetPath()), PrimSpace(*self.scene.placement(prim))

    def _find_holding_prim(self, parent: PrimCollision | None, body: str) -> Any:
        own = next((path for path, name in self.bodies.names.items() if name == body), None)
        if own is None and body != BODY:
            raise AssetError(f"there is no body {body!r} in the file", where=self._where)
        if parent is not None and parent.body == body:
            below = parent.path in (own, self.scene.base)
            return parent.prim if below else parent.prim.GetParent()
        if own is not None:
            return self.bodies.prims[own]
        return self.scene.stage.GetDefaultPrim() or self.scene.stage.GetPseudoRoot()

    def _free_name(self, holder: Any, name: str) -> str:
        """The name of a new prim: the last part of a hull's, free in the layer and in the stage."""
        prim = self.scene.stage.GetPrimAtPath(holder.path)
        taken = [child.GetName() for child in prim.GetAllChildren()] if prim else []
        return free_prim_name(name.rsplit("/", 1)[-1], [*taken, *(child.name for child in holder.nameChildren)])

    def _join_groups(self, parent: str, made: Any) -> None:
        for group in self.scene.stage.Traverse():
            if group.GetTypeName() == "PhysicsCollisionGroup":
                targets = [str(target) for target in group.GetRelationship(_GROUP_MEMBERS).GetTargets()]
                if parent in targets:
                    spec = pxr.Sdf.CreatePrimInLayer(self.layer, group.GetPath())
                    own = spec.relationships.get(_GROUP_MEMBERS) or pxr.Sdf.RelationshipSpec(
                        spec, _GROUP_MEMBERS, False
                    )
                    own.targetPathList.Append(made)

    @property
    def _where(self) -> str:
        return str(self.scene.path)


def holds_volume(scene: UsdStage, prim: Any) -> bool:
    """Whether what is put below a prim keeps its volume."""
    linear, offset = scene.placement(prim)
    if not (np.isfinite(linear).all() and np.isfinite(offset).all()):
        return False
    stretch = np.linalg.svd(linear, compute_uv=False)
    return bool(stretch[-1] > 1e-9 * stretch[0])


def remove_collision(scene: UsdStage, layer: Any, prim: Any, physics: bool) -> str:
    """Take the collision from a prim, and the prim where it was nothing else; how, for people.

    Raises AssetError: something else refers to the prim that would go.
    """
    make_instances_editable(layer, prim)
    if physics and (colliders.is_seen(scene, prim) or has_other_content(prim)):
        _remove_schemas(layer, prim)
        return "stripped"
    _refuse_referenced(scene, prim)
    path = prim.GetPath()
    stack = prim.GetPrimStack()
    if len(stack) == 1 and stack[0].layer == scene.stage.GetRootLayer() and stack[0].path == path:
        spec = layer.GetPrimAtPath(path)
        del spec.nameParent.nameChildren[spec.name]
        return "removed"
    pxr.Sdf.CreatePrimInLayer(layer, path).SetInfo("active", False)
    return "deactivated"


def make_instances_editable(layer: Any, prim: Any) -> None:
    """Make the instances around a prim their own, so that it can be edited alone."""
    for instance in colliders.instances_around(prim):
        pxr.Sdf.CreatePrimInLayer(layer, instance.GetPath()).SetInfo("instanceable", False)


def has_other_content(prim: Any) -> bool:
    """Whether a prim is a body, or has others below it besides parts of its own surface."""
    children = [child.GetTypeName() for child in prim.GetAllChildren()]
    return prim.HasAPI(pxr.UsdPhysics.RigidBodyAPI) or any(kind != "GeomSubset" for kind in children)


def _remove_schemas(layer: Any, prim: Any) -> None:
    applied = prim.GetPrimTypeInfo().GetAppliedAPISchemas()
    gone = [
        n
        for n in applied
        if n in (colliders.COLLISION, colliders.MESH_COLLISION) or (n.startswith("Physx") and "Collision" in n)
    ]
    path = prim.GetPath()
    spec = pxr.Sdf.CreatePrimInLayer(layer, path)
    old = spec.GetInfo("apiSchemas") if spec.HasInfo("apiSchemas") else pxr.Sdf.TokenListOp()
    others = prim.GetPrimStack()[_count_own_specs(prim, layer) :]
    lists = [other.GetInfo("apiSchemas") for other in others if other.HasInfo("apiSchemas")]
    elsewhere = {name for listed in lists for name in listed.GetAddedOrExplicitItems()}
    for name in ("explicitItems", "prependedItems", "appendedItems", "addedItems"):
        left = [item for item in getattr(old, name) if item not in gone]
        if left != list(getattr(old, name)):
            setattr(old, name, left)
    if not old.isExplicit:
        old.deletedItems = [*old.deletedItems, *(n for n in gone if n in elsewhere and n not in old.deletedItems)]
    if old == pxr.Sdf.TokenListOp():
        spec.ClearInfo("apiSchemas")
    else:
        spec.SetInfo("apiSchemas", old)
    for name in [p.name for p in spec.properties]:
        if name in _OWN or (name.startswith("physx") and "Collision:" in name):
            spec.RemoveProperty(spec.properties[name])


def _count_own_specs(prim: Any, layer: Any) -> int:
    """How many of the opinions on a prim are those of the layer that is edited: one where it has any."""
    stack = prim.GetPrimStack()
    own = layer.GetPrimAtPath(prim.GetPath())
    return int(bool(stack) and own is not None and stack[0].path == prim.GetPath())


def _refuse_referenced(scene: UsdStage, prim: Any) -> None:
    path = prim.GetPath()
    for other in scene.stage.Traverse():
        for relationship in other.GetAuthoredRelationships():
            if relationship.GetName().startswith(_GROUP_PREFIX) or other.GetPath().HasPrefix(path):
                continue
            if any(target.GetPrimPath() == path for target in relationship.GetTargets()):
                raise AssetError(
                    f"{path} cannot be removed: {relationship.GetPath()} refers to it",
                    where=str(scene.path),
                    remedy="Take that reference out first, or leave the hull.",
                )
