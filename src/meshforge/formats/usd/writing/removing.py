"""Taking collision from a stage: prims taken out or switched off, and those that are seen left to be seen only."""

from __future__ import annotations

from typing import Any

from meshforge.errors import AssetError
from meshforge.formats.usd.reading.colliders import COLLISION, MESH_COLLISION, instances_around, is_seen
from meshforge.formats.usd.reading.stage import Scene

_GROUP = "collection:colliders:"
_OWN = ("physics:collisionEnabled", "physics:simulationOwner", "physics:approximation")


def take_collision(scene: Scene, layer: Any, prim: Any, physics: bool) -> str:
    """Take the collision from a prim, and the prim where it was nothing else; how, for people.

    Raises AssetError: something else refers to the prim that would go.
    """
    from pxr import Sdf

    free(layer, prim)
    if physics and (is_seen(scene, prim) or is_more(prim)):
        _strip(layer, prim)
        return "stripped"
    _refuse_mentioned(scene, prim)
    path = prim.GetPath()
    stack = prim.GetPrimStack()
    if len(stack) == 1 and stack[0].layer == scene.stage.GetRootLayer() and stack[0].path == path:
        spec = layer.GetPrimAtPath(path)
        del spec.nameParent.nameChildren[spec.name]
        return "removed"
    Sdf.CreatePrimInLayer(layer, path).SetInfo("active", False)
    return "deactivated"


def free(layer: Any, prim: Any) -> None:
    """Make the instances around a prim their own, so that it can be edited alone."""
    from pxr import Sdf

    for instance in instances_around(prim):
        Sdf.CreatePrimInLayer(layer, instance.GetPath()).SetInfo("instanceable", False)


def is_more(prim: Any) -> bool:
    """Whether a prim is a body, or has others below it besides parts of its own surface."""
    from pxr import UsdPhysics

    children = [child.GetTypeName() for child in prim.GetAllChildren()]
    return prim.HasAPI(UsdPhysics.RigidBodyAPI) or any(kind != "GeomSubset" for kind in children)


def _strip(layer: Any, prim: Any) -> None:
    """Take the collision schemas from a prim, and what they say."""
    from pxr import Sdf

    applied = prim.GetPrimTypeInfo().GetAppliedAPISchemas()
    gone = [n for n in applied if n in (COLLISION, MESH_COLLISION) or (n.startswith("Physx") and "Collision" in n)]
    path = prim.GetPath()
    spec = Sdf.CreatePrimInLayer(layer, path)
    old = spec.GetInfo("apiSchemas") if spec.HasInfo("apiSchemas") else Sdf.TokenListOp()
    elsewhere = {name for other in prim.GetPrimStack()[_own_specs(prim, layer) :] for name in _added(other)}
    for name in ("explicitItems", "prependedItems", "appendedItems", "addedItems"):
        left = [item for item in getattr(old, name) if item not in gone]
        if left != list(getattr(old, name)):
            setattr(old, name, left)
    if not old.isExplicit:
        old.deletedItems = [*old.deletedItems, *(n for n in gone if n in elsewhere and n not in old.deletedItems)]
    if old == Sdf.TokenListOp():
        spec.ClearInfo("apiSchemas")
    else:
        spec.SetInfo("apiSchemas", old)
    for name in [p.name for p in spec.properties]:
        if name in _OWN or (name.startswith("physx") and "Collision:" in name):
            spec.RemoveProperty(spec.properties[name])


def _own_specs(prim: Any, layer: Any) -> int:
    """How many of the opinions on a prim are those of the layer that is edited: one where it has any."""
    stack = prim.GetPrimStack()
    own = layer.GetPrimAtPath(prim.GetPath())
    return int(bool(stack) and own is not None and stack[0].path == prim.GetPath())


def _added(spec: Any) -> list[str]:
    if not spec.HasInfo("apiSchemas"):
        return []
    return list(spec.GetInfo("apiSchemas").GetAddedOrExplicitItems())


def _refuse_mentioned(scene: Scene, prim: Any) -> None:
    """Raise AssetError where a relationship, but for a membership in a group, leads to a prim that is to go."""
    path = prim.GetPath()
    for other in scene.stage.Traverse():
        for relationship in other.GetAuthoredRelationships():
            if relationship.GetName().startswith(_GROUP) or other.GetPath().HasPrefix(path):
                continue
            if any(target.GetPrimPath() == path for target in relationship.GetTargets()):
                raise AssetError(
                    f"{path} cannot be removed: {relationship.GetPath()} refers to it",
                    where=str(scene.path),
                    remedy="Take that reference out first, or leave the hull.",
                )
